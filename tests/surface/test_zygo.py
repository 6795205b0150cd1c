"""Text files of Zygo's programs, written here as they write them, and a profile of a Dektak with its results."""

import numpy as np
import pytest

import lubfric

WAVE = 632.8e-9
PITCH = 1.2e-6
SHAPE = (24, 18)


@pytest.fixture(scope="module")
def heights():
    z = lubfric.generate_surface((24, 18), PITCH, sq=80e-9, correlation_length=4e-6, acf="gaussian", seed=5).heights
    return np.where(np.arange(18) == 3, np.where(np.arange(24)[:, None] < 2, np.nan, z), z)


def header(kind, pitch=PITCH, resolution=1, intensity=(0, 0), origin=(10, 20), shape=SHAPE):
    return [
        kind,
        '1 8 3 5 "Tue Aug 25 16:59:23 2009"',
        f"0 0 {intensity[0]} {intensity[1]} {int(intensity[0] > 0)} 255",
        f"{origin[0]} {origin[1]} {shape[0]} {shape[1]}",
        '"a disc # 3"',
        '""',
        '""',
        f"0 0.5 {WAVE:g} 0 1 0 {pitch:.9g} 1251212363",
        '640 480 5 0 0 0 "10X Mirau"',
        "0 0 1 33 0 0 0.1 60.4 2 50",
        f"{resolution} 1 20 2 0 0 0 0 0",
        '0 ""',
        "1 0",
        "#",
    ]


def points(z, origin=(10, 20), **keys):
    lines = header("Zygo XYZ Data File - Format 1", origin=origin, **keys)
    for j in range(z.shape[1]):
        for i in range(z.shape[0]):
            value = "No Data" if np.isnan(z[i, j]) else f"{z[i, j] * 1e6:.7f}"
            lines.append(f"{i + origin[0]} {j + origin[1]} {value}")
    return [*lines, "#"]


def phases(z, resolution=1, intensity=(0, 0)):
    counts = {0: 4096, 1: 32768, 2: 131072}[resolution]
    whole = np.where(np.isnan(z), 2147483640, np.round(np.nan_to_num(z) / (0.5 * WAVE / counts))).astype(np.int64).T
    rows = whole.ravel().tolist()
    lines = header("Zygo ASCII Data File - Format 2", resolution=resolution, intensity=intensity)
    if intensity[0]:
        lines += [*(" ".join(["100"] * intensity[0]) for _ in range(intensity[1])), "#"]
    lines += [" ".join(map(str, rows[k : k + 10])) for k in range(0, len(rows), 10)]
    return [*lines, "#"]


def read(tmp_path, name, lines, **keys):
    (tmp_path / name).write_text("\r\n".join(lines) + "\r\n")
    return lubfric.read_surface(tmp_path / name, level=False, fill=False, **keys)


@pytest.mark.parametrize("name", ["mx.xyz", "metropro.txt"])
@pytest.mark.parametrize("origin", [(10, 20), (0, 0)])
def test_points_are_read_with_the_pixel_of_the_header(name, origin, heights, tmp_path):
    surface = read(tmp_path, name, points(heights, origin), unit="um")
    assert surface.spacing == pytest.approx((PITCH, PITCH)) and surface.shape == SHAPE
    assert np.allclose(surface.heights, heights, atol=1e-12, equal_nan=True)
    assert (surface.mask == ~np.isnan(heights)).all() and "Zygo" in " ".join(surface.notes)


@pytest.mark.parametrize("resolution", [0, 1, 2])
@pytest.mark.parametrize("intensity", [(0, 0), (30, 20)])
def test_phases_are_read_with_the_wave_of_the_header(resolution, intensity, heights, tmp_path):
    surface = read(tmp_path, "zygo.asc", phases(heights, resolution, intensity))
    assert surface.spacing == pytest.approx((PITCH, PITCH))
    assert np.allclose(surface.heights, heights, atol=0.5 * WAVE / 4096, equal_nan=True)


def test_what_a_file_does_not_state_is_requested(heights, tmp_path):
    lines = points(heights)
    with pytest.raises(lubfric.InputError, match="does not state the unit of its heights.*give unit"):
        read(tmp_path, "a.xyz", lines)
    uncalibrated = points(heights, pitch=0.0)
    with pytest.raises(lubfric.InputError, match="spacing of a.xyz is missing"):
        read(tmp_path, "a.xyz", uncalibrated, unit="um")
    assert read(tmp_path, "a.xyz", uncalibrated, unit="um", spacing=2e-6).spacing == (2e-6, 2e-6)
    with pytest.raises(lubfric.InputError, match="states its own"):
        read(tmp_path, "a.asc", phases(heights), unit="nm")
    with pytest.raises(lubfric.InputError, match="states 1.2e-06"):
        read(tmp_path, "a.xyz", lines, unit="um", spacing=1e-6)


def test_damaged_files_are_refused(heights, tmp_path):
    whole = points(heights)
    twice = [*whole[:-1], whole[20], "#"]
    outside = [*whole[:-1], "999 20 0.1", "#"]
    word = [*whole[:-1], "11 20 x", "#"]
    for lines, why in (
        (whole[:200], "cut off"),
        (whole[:-1], "cut off"),
        (twice, "points twice, or outside"),
        (outside, "points twice, or outside"),
        (word, "lines that are not"),
        ([*whole[:7], *whole[8:]], "another layout"),
        (whole[:5], "another layout"),
        ([whole[0]], "another layout"),
    ):
        with pytest.raises(lubfric.InputError, match=why):
            read(tmp_path, "a.xyz", lines, unit="um")
    for lines, why in (
        (phases(heights)[:-2] + ["#"], "phases, and states"),
        (phases(heights)[:-1], "cut off"),
        ([line.replace("1 1 20 2", "7 1 20 2") for line in phases(heights)], "phase resolution 7"),
    ):
        with pytest.raises(lubfric.InputError, match=why):
            read(tmp_path, "a.asc", lines)


def test_a_dektak_profile_with_its_results_is_refused_as_a_profile(tmp_path):
    z = 80e-9 * np.sin(np.arange(64) / 3)
    rows = [f"{i},{v * 1e10:.3f}" for i, v in enumerate(z)]
    head = ["Meta Data,", "DataFileName,C:\\a.csv", "Scan Length,64,um", "R.Cursor,Pos: 0 um,Width: 5 um"]
    results = ["Analytic Results,", "Ra,812.3,A", "Rq,1003.2,A"]
    title = "Lateral um,Total Profile A"
    for lines in ([*head, *results, title, *rows], [*head, title, *rows, "", *results]):
        with pytest.raises(lubfric.InputError, match="profile of 64 points, not a map of heights"):
            read(tmp_path, "dektak.csv", lines)
