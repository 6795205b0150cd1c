"""What a file of heights says of itself: empty cells, steps in headings, the form that is left in it, and units that
cannot be meant."""

import re

import numpy as np
import pytest

import lubfric
from lubfric import InputError, read_surface

RAW = {"level": False, "fill": False}
NAN = np.nan


@pytest.mark.parametrize(
    "text, found",
    [
        ("1;;3\n4;5;6\n", [[1, NAN, 3], [4, 5, 6]]),
        ("1,,3\n4,5,6\n", [[1, NAN, 3], [4, 5, 6]]),
        ("1\t\t3\n4\t5\t6\n", [[1, NAN, 3], [4, 5, 6]]),
        ("\t2\t3\n4\t5\t\n", [[NAN, 2, 3], [4, 5, NAN]]),  # not shifted to the left
        ("1;2;\n4;;6\n", [[1, 2, NAN], [4, NAN, 6]]),
        ("1;;\n4;5;\n", [[1, NAN], [4, 5]]),  # a separator behind every line
        (";2;3\n;;\n4;5;6\n", [[NAN, 2, 3], [NAN, NAN, NAN], [4, 5, 6]]),
        ("1,5;;2,5\n3;4;\n", [[1.5, NAN, 2.5], [3, 4, NAN]]),
    ],
)
def test_an_empty_cell_is_unmeasured(tmp_path, text, found):
    (tmp_path / "a.csv").write_text(text)
    surface = read_surface(tmp_path / "a.csv", spacing=0.01, unit="mm", **RAW)
    np.testing.assert_allclose(surface.heights * 1e3, found, rtol=1e-14)
    np.testing.assert_array_equal(surface.mask, np.isfinite(found))
    count = int(np.isnan(found).sum())
    assert f"{count} empty cell{'s' * (count > 1)} treated as unmeasured" in surface.notes


@pytest.mark.parametrize(
    "heading",
    [
        "Step X [um];1.5\nStep Y [um];1.5",
        "Step X;1,5;\u00b5m\nStep Y;1,5;\u00b5m",
        "Width;3\nStep Y (mm):\t0.0015\nStep X (mm):\t0.0015\nHeights",
        "dx [nm] = 1500\ndy [nm] = 1500",
    ],
)
def test_steps_in_headings_are_read(tmp_path, heading):
    (tmp_path / "a.csv").write_text(heading + "\n1;2;3\n4;5;7\n", encoding="utf-8")
    surface = read_surface(tmp_path / "a.csv", unit="nm", **RAW)
    stated = *surface.spacing, surface.heights.max()
    assert stated == pytest.approx((1.5e-6, 1.5e-6, 7e-9), rel=1e-6)
    assert surface.notes[0].startswith("line 1") and heading.split("\n")[0] in surface.notes[0]
    with pytest.raises(InputError, match="spacing = 1e-06, 1e-06 m is given, and file a.csv states 1.5e-06"):
        read_surface(tmp_path / "a.csv", unit="nm", spacing=1e-6)


@pytest.mark.parametrize("heading", ["Step X [um];1.5\nStep Y [um];2.5", "Step X;1.5\nStep Y;1.5", "Step [um];1.5"])
def test_steps_that_do_not_tell_the_grid_leave_it_to_the_user(tmp_path, heading):
    """Different along X and Y (along which does a line run?), without a unit, without an axis."""
    given = (1.5e-6, 1.5e-6) if heading == "Step X;1.5\nStep Y;1.5" else (2.5e-6, 1.5e-6)
    path = tmp_path / "a.csv"
    path.write_text(heading + "\n1;2;3\n4;5;7\n")
    with pytest.raises(InputError, match="spacing of a.csv is missing"):
        read_surface(path, unit="nm")
    assert read_surface(path, unit="nm", spacing=given, **RAW).spacing == given
    if "um" not in heading:
        with pytest.raises(InputError, match="is given, and file a.csv states line 1 'Step X;1.5'; allowed: that in m"):
            read_surface(path, unit="nm", spacing=(2.5e-6, 1.5e-6))


HEADERS = {  # name: (lines above 4 lines of 6 heights, whether x runs along a line of the file)
    "German": (
        "Ger\u00e4t;A\nAnzahl Punkte X;6\nAnzahl Punkte Y;4\nSchrittweite X;0,8 \u00b5m\nSchrittweite Y;0,8 \u00b5m",
        True,
    ),
    "German, turned": (
        "Anzahl Punkte X;4\nAnzahl Punkte Y;6\nSchrittweite X;0,8 \u00b5m\nSchrittweite Y;0,8 \u00b5m",
        False,
    ),
    "German widths": ("Breite;4,8 \u00b5m\nH\u00f6he;3,2 \u00b5m", True),
    "lengths without a unit": ("width,4.8\nheight,3.2", True),
    "lengths, turned": ("width,3.2\nheight,4.8", False),
    "lengths along axes": ("X range;4.8\nY range;3.2", True),
    "one length": ("width,0.0048", True),
    "counts": ("Width;6\nHeight;4", True),
    "counts, turned": ("Width;4\nHeight;6", False),
    "points per profile": ("points per profile;6\nprofiles;4", True),
    "German profiles": ("Punkte je Profil;6\nAnzahl Profile;4", True),
    "nothing of the grid": ("Stage X;12 mm\nStep height;12 nm\n# width: 7", False),
}


@pytest.mark.parametrize("name", HEADERS)
def test_sizes_in_headings_decide_the_direction_of_x(tmp_path, name):
    """x runs along a line of the file, as the counts do, or the lengths, by the steps of 0.8 um that the caller
    gives."""
    heading, is_along = HEADERS[name]
    heights = np.sin(np.arange(24.0)).reshape(4, 6).round(4)
    rows = "\n".join(";".join(map(str, row)) for row in heights)
    (tmp_path / "a.csv").write_text(f"{heading}\n{rows}\n", encoding="latin-1")
    surface = read_surface(tmp_path / "a.csv", unit="nm", spacing=0.8e-6, decimal=".", **RAW)
    np.testing.assert_allclose(surface.heights, 1e-9 * (heights.T if is_along else heights), rtol=1e-12)


@pytest.mark.parametrize(
    "heading",
    ["width,5.6\nheight,3.2", "Width;7", "Abstand;0,9 \u00b5m", "Rasterweite X;0,9 \u00b5m", "Step X;0.9", "Pixels;25"],
)
def test_a_size_that_the_table_has_not_is_refused(tmp_path, heading):
    (tmp_path / "a.csv").write_text(f"{heading}\n" + 4 * "1;2;3;4;6;5\n", encoding="latin-1")
    with pytest.raises(InputError, match=re.escape(f"line 1 {heading.splitlines()[0]!r}")):
        read_surface(tmp_path / "a.csv", unit="nm", spacing=0.8e-6, **RAW)


def test_a_spacing_that_a_line_may_state_is_not_called_absent(tmp_path):
    (tmp_path / "a.csv").write_text("Rasterweite X;0,8 \u00b5m\n" + 4 * "1;2;3;4;6;5\n", encoding="latin-1")
    with pytest.raises(InputError, match="is missing: line 1 'Rasterweite X;0,8 µm' may state it"):
        read_surface(tmp_path / "a.csv", unit="nm", **RAW)
    (tmp_path / "a.csv").write_text("Probe A\n" + 4 * "1;2;3;4;6;5\n")
    with pytest.raises(InputError, match="is missing: the file does not state it"):
        read_surface(tmp_path / "a.csv", unit="nm", **RAW)


def barrel(step=2e-6):
    """Roughness on a barrel about y and a tilt [m]; and the Sq of what plane, cylinder and quadratic leave, by QR."""
    z = lubfric.generate_surface((90, 70), step, sq=300e-9, correlation_length=9e-6, acf="gaussian", seed=2).heights
    x, y = np.meshgrid(np.linspace(-1, 1, 90), np.linspace(-1, 1, 70), indexing="ij")
    z = z + 1e-6 * (1 - x**2) + 2e-7 * y + 1e-7 * x * y
    left = {}
    for name, terms in {"plane": [1 + 0 * x, x, y], "cylinder": [x * x], "quadratic": [x * y, y * y]}.items():
        left[name] = [*left.get({"cylinder": "plane", "quadratic": "cylinder"}.get(name), []), *terms]
    for name, terms in left.items():
        q = np.linalg.qr(np.stack([term.ravel() for term in terms], axis=1))[0]
        left[name] = (z.ravel() - q @ (q.T @ z.ravel())).std()
    return z, left


def test_a_reader_tells_what_each_form_would_leave(tmp_path):
    z, left = barrel()
    np.save(tmp_path / "a.npy", z)
    surface = read_surface(tmp_path / "a.npy", spacing=2e-6)
    sq = {"as measured": z.std()} | {f"without {name}": value for name, value in left.items()}
    note = next(note for note in surface.notes if note.startswith("Sq"))
    assert note.split(";")[0] == "Sq " + ", ".join(f"{value * 1e9:.4g} nm {name}" for name, value in sq.items())
    assert left["plane"] > 1.3 * left["cylinder"] and note.endswith("give form = 'cylinder'")
    for form, value in left.items():
        assert read_surface(tmp_path / "a.npy", spacing=2e-6, form=form).sq == pytest.approx(value, rel=1e-9)
    for form in ("cylinder", "quadratic"):
        notes = read_surface(tmp_path / "a.npy", spacing=2e-6, form=form).notes
        assert not any("give form" in note for note in notes)


def test_a_cylinder_lies_along_x_or_along_y():
    z, left = barrel()
    for heights in (z, z.T):
        assert lubfric.Surface(heights, 2e-6).level("cylinder").sq == pytest.approx(left["cylinder"], rel=1e-9)


def test_heights_and_spacing_that_cannot_be_in_one_unit_are_refused(tmp_path):
    """A map in um that was taken for m had Sq 4.4e+08 nm."""
    z = lubfric.generate_surface((40, 40), 2e-6, sq=440e-9, correlation_length=9e-6, acf="gaussian", seed=2).heights
    np.savetxt(tmp_path / "a.txt", z * 1e6)
    with pytest.raises(InputError, match="rms slope.*check the unit of the heights"):
        read_surface(tmp_path / "a.txt", spacing=2e-6)
    assert read_surface(tmp_path / "a.txt", spacing=2e-6, unit="um").sq == pytest.approx(440e-9, rel=0.2)
    with pytest.raises(InputError, match="rms slope"):
        read_surface(tmp_path / "a.txt", spacing=2e-6, **RAW)


@pytest.mark.parametrize(
    "spacing, unit, words",
    [
        (1, "um", r"spacing = 1 m; allowed: 1e-11 to 0.01 m in a map; .*spacing = 1e-6 is 1 µm"),
        (1e-6, "nm", r"Sq = .*e-1[6-9] m"),
        (1e-9, "m", "rms slope = .*allowed: 1e-07 to 3"),
    ],
)
@pytest.mark.parametrize("suffix", [".csv", ".npy"])
def test_a_unit_of_the_caller_that_no_map_has_is_refused(tmp_path, suffix, spacing, unit, words):
    """Heights in metres, which are called others, or a pixel of 1 µm that is written as 1."""
    heights = 1e-7 * np.random.default_rng(0).standard_normal((30, 20))
    path = tmp_path / f"a{suffix}"
    if suffix == ".npy":
        np.save(path, heights)
    else:
        np.savetxt(path, heights, delimiter=";")
    assert 5e-8 < read_surface(path, spacing=1e-6).sq < 2e-7
    with pytest.raises(InputError, match=words):
        read_surface(path, spacing=spacing, unit=unit)


def test_a_smooth_map_is_noted(tmp_path):
    """Heights in µm that are called nm: 0.1 nm, as polished mirrors have, but no machined surface."""
    np.save(tmp_path / "a.npy", 0.1 * np.random.default_rng(0).standard_normal((30, 20)))
    note = next(note for note in read_surface(tmp_path / "a.npy", spacing=1e-6, unit="nm").notes if "unusual" in note)
    assert note.startswith("Sq 0.09963 nm") and "check the unit of the heights" in note


def lines_of_points(scales, heading=""):
    z = 1e-7 * np.random.default_rng(0).standard_normal((12, 10))
    x, y = np.meshgrid(np.arange(12) * 1e-6, np.arange(10) * 1e-6, indexing="ij")
    rows = np.stack([part.ravel() / scale for part, scale in zip((x, y, z), scales)], axis=1)
    return heading + "".join(" ".join(f"{value:.9g}" for value in row) + "\n" for row in rows), z


def test_units_of_the_heading_of_points_are_read(tmp_path):
    text, z = lines_of_points((1e-3, 1e-3, 1e-6), "X_mm Y_mm Z_um\n")
    (tmp_path / "a.txt").write_text(text)
    np.testing.assert_allclose(read_surface(tmp_path / "a.txt", **RAW).heights, z, atol=1e-14)


def test_the_advice_for_points_in_two_units_is_what_helps(tmp_path):
    text, z = lines_of_points((1e-3, 1e-3, 1e-6), "ring 7: mm, then um\n")
    path = tmp_path / "a.xyz"
    path.write_text(text)
    with pytest.raises(InputError, match=r"unit = \('mm', 'um'\) for x and y, and z"):
        read_surface(path)
    path.write_text(text.partition("\n")[2])
    for given in ({}, {"unit": "um"}):
        with pytest.raises(InputError, match=r"unit = \('mm', 'um'\) for x and y, and z"):
            read_surface(path, **given)
    np.testing.assert_allclose(read_surface(path, unit=("mm", "um"), **RAW).heights, z, atol=1e-14)


def test_a_profile_is_described_in_the_units_that_are_stated(tmp_path):
    x = np.arange(200) * 1e-6
    rows = "".join(f"{1e3 * a:.6g};{1e6 * b:.6g}\n" for a, b in zip(x, 1e-7 * np.sin(x / 5e-6)))
    path = tmp_path / "a.txt"
    for heading, given in (("x [mm];z [µm]\n", {}), ("", {"unit": ("mm", "um")})):
        path.write_text(heading + rows, encoding="utf-8")
        with pytest.raises(InputError, match=r"Sq [67]\d\.\d* nm about its mean line, correlation length [56]\.\d* µm"):
            read_surface(path, **given)


@pytest.mark.parametrize("head", ["x [mm];z [um]\n", "# Z-unit: um\n"])
def test_a_unit_that_contradicts_the_heights_of_a_profile_is_refused(tmp_path, head):
    """Its statistics, which a user may type in, would be wrong by the ratio of the two units; so would a contradicted
    step."""
    x = np.arange(200) * 1e-6
    path = tmp_path / "a.txt"
    rows = "".join(f"{1e3 * a:.6g};{1e6 * b:.6g}\n" for a, b in zip(x, 1e-7 * np.sin(x / 5e-6)))
    path.write_text(head + rows)
    with pytest.raises(InputError, match="unit = 'nm' is given, and the file says um") as error:
        read_surface(path, unit="nm")
    assert "Sq" not in str(error.value)
    with pytest.raises(InputError, match=r"Sq [67]\d\.\d* nm"):
        read_surface(path, unit="um")
    if "x" in head:
        with pytest.raises(
            InputError, match=r"correlation length [56]\.\d* µm with its first column in mm, .* contradict"
        ):
            read_surface(path, spacing=1e-3)


@pytest.mark.parametrize("scale, columns", [(1e3, 2), (1e6, 2), (1.0, 1)])  # of the first column, from m
def test_a_stated_spacing_sets_the_correlation_length_of_a_profile(scale, columns, tmp_path):
    """Whatever the unit of its first column, which heights in another unit do not have; one that fits in no unit is
    named."""
    x = np.arange(200) * 1e-6
    rows = np.column_stack([scale * x, 0.1 * np.sin(x / 5e-6)])[:, -columns:]
    path = tmp_path / "a.txt"
    np.savetxt(path, rows)
    with pytest.raises(InputError, match=r"correlation length [56]\.\d* µm") as caught:
        read_surface(path, spacing=1e-6, unit="um")
    assert "contradict" not in str(caught.value)
    if columns == 2:
        with pytest.raises(InputError, match="contradict in every unit"):
            read_surface(path, spacing=3e-6, unit="um")


def test_what_is_wrong_with_heights_is_said_with_its_place(tmp_path):
    path = tmp_path / "a.npy"
    z = 1e-7 * np.random.default_rng(0).standard_normal((12, 10))
    z[3, 4] = np.inf
    np.save(path, z)
    with pytest.raises(InputError, match=r"heights\[3, 4\] of a.npy = inf; allowed: finite heights, and NaN where"):
        read_surface(path, spacing=1e-6)
    z[3, 4] = 9999
    np.save(path, z)
    with pytest.raises(InputError, match="the largest = 9999 m is out of range; .*give missing_value"):
        read_surface(path, spacing=1e-6)
    (tmp_path / "a.txt").write_text("Sample 12, heights in nm, pixel 1 um\n" + "1 2 3 4 5\n" * 5)
    with pytest.raises(InputError, match="says that the heights are in nm, .*unit = 'nm'"):
        read_surface(tmp_path / "a.txt")
