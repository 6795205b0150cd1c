"""Ten layouts as metrologists export them, written here: each is read as it is, or refused; nothing wrongly in
silence."""

import numpy as np
import pytest
from instrument_files import metres_after

import lubfric

NX, NY = 48, 36
STEPS = (1e-6, 2e-6)


@pytest.fixture(scope="module")
def heights():
    """A rough map [m], (NX, NY), without a plane."""
    made = lubfric.generate_surface((NX, NY), STEPS, sq=1e-7, correlation_length=5e-6, acf="gaussian", seed=3)
    return made.level().heights


def rows(z, unit, mark="\t", form="{:.6f}"):
    """Lines of a file in which x runs along the line."""
    return [mark.join(form.format(value / unit) for value in z[:, j]) for j in range(NY)]


def triplets(z, units, mark="\t"):
    x, y, h = units
    return [
        f"{i * STEPS[0] / x:.6f}{mark}{j * STEPS[1] / y:.6f}{mark}{z[i, j] / h:.7f}"
        for j in range(NY)
        for i in range(NX)
    ]


def smd(z):
    """A profile as Taylor Hobson writes .prf: records of ISO 5436-2, the heights in whole increments of 1 nm."""
    head = ["1 2", "sample PRF 0 0 0 0", f"CX M {NX:e} MM 1.0e+000 D", f"CZ M {NX:e} MM 1.0e-006 L", "EOR"]
    head += ["STYLUS_RADIUS 2.0e-003 MM", "SPACING CX 1.0e-003", "MAP 1.0 CZ CZ 1.0 1.0", "COMMENT", "EOR"]
    return [*head, *(str(round(value * 1e9)) for value in z[:, 0]), "EOR", "EOF"]


MAPS = {
    "Talysurf CCI, matrix": (
        "cci.txt",
        lambda z: ["# Taylor Hobson Talysurf CCI", "# Number of points X: 48", "# Number of points Y: 36",
                   "# Spacing X: 1.000 um", "# Spacing Y: 2.000 um", "# Units Z: nm", *rows(z, 1e-9)],
    ),
    "Talysurf, points": ("points.txt", lambda z: ["X (mm)\tY (mm)\tZ (um)", *triplets(z, (1e-3, 1e-3, 1e-6))]),
    "Mitutoyo, three-dimensional": (
        "mitutoyo.csv",
        lambda z: ["Mitutoyo MCubeMap;CS-3200", "Points X;48", "Points Y;36", "Pitch X;1.000;um", "Pitch Y;2.000;um",
                   "Unit Z;um", *rows(z, 1e-6, ";")],
    ),
    "Gwyddion": (
        "gwyddion.txt",
        lambda z: ["# Channel: Height", "# Width: 48.00 µm", "# Height: 72.00 µm", "# Value units: m",
                   *rows(z, 1.0, "\t", "{:.7e}")],
    ),
    "Olympus LEXT": (
        "lext.csv",
        lambda z: ["DataName,part", "Resolution X[um/pixel],1.0", "Resolution Y[um/pixel],2.0", "ImageSizeX,48",
                   "ImageSizeY,36", "Z unit,um", *rows(z, 1e-6, ",")],
    ),
    "NanoFocus, decimal comma": (
        "nanofocus.txt",
        lambda z: ["X-Size: 48 pixels", "Y-Size: 36 pixels", "X-Pitch: 1,0 µm", "Y-Pitch: 2,0 µm", "Z-Unit: µm",
                   *(line.replace(".", ",") for line in rows(z, 1e-6))],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MAPS)
def test_a_map_is_read_as_its_header_says(name, heights, tmp_path):
    file, lines = MAPS[name]
    (tmp_path / file).write_text("\n".join(lines(heights)) + "\n", encoding="utf-8")
    surface = lubfric.read_surface(tmp_path / file)
    assert surface.shape == (NX, NY) and surface.spacing == pytest.approx(STEPS, rel=1e-6)
    assert np.allclose(surface.heights, heights, atol=1e-12)


def test_quoted_cells_and_one_calibration_for_x_and_y(heights, tmp_path):
    """As Keyence writes them: "270","nm/pixel"; Horizontal and Vertical are numbers of points."""
    head = ['"XY calibration","1000","nm/pixel"', '"Output image data","Height"', f'"Horizontal","{NX}"']
    head += [f'"Vertical","{NY}"', '"Unit","um"', '""', '"Height"']
    cells = [",".join(f'"{cell}"' for cell in line.split(",")) for line in rows(heights, 1e-6, ",")]
    path = tmp_path / "keyence.csv"
    path.write_text("\n".join([*head, *cells]))
    surface = lubfric.read_surface(path)
    assert surface.shape == (NX, NY) and surface.spacing == pytest.approx((1e-6, 1e-6))
    assert np.allclose(surface.heights, heights, atol=1e-11)
    path.write_text("\n".join([*head, *(cell.replace(".", ",") for cell in cells)]))
    assert np.allclose(lubfric.read_surface(path).heights, surface.heights)  # a comma in quotes is a decimal mark


@pytest.mark.parametrize("suffix", [".prf", ".smd", ".txt"])
def test_a_profile_of_taylor_hobson_is_refused_with_its_statistics(suffix, heights, tmp_path):
    path = tmp_path / f"trace{suffix}"
    path.write_text("\n".join(smd(heights)))
    z = heights[:, 0]
    x = np.arange(NX)
    sq = (z - np.polyval(np.polyfit(x, z, 1), x)).std()
    with pytest.raises(lubfric.InputError, match=f"profile of {NX} points, not a map of heights") as caught:
        lubfric.read_surface(path)
    stated = metres_after("(Sq ", str(caught.value))
    assert stated == pytest.approx(sq, rel=1e-3)
    path.write_text("\n".join(smd(heights)).replace("EOR", "END"))
    with pytest.raises(lubfric.InputError, match="records are not those of ISO 5436-2"):
        lubfric.read_surface(path)


PROFILES = {
    "Mitutoyo, one column": (
        "mitutoyo.csv",
        lambda z: [
            "Mitutoyo SJ-410",
            "Pitch;1.0000;um",
            "Points;48",
            "Data [um]",
            *(f"{v * 1e6:.5f}" for v in z[:, 0]),
        ],
    ),
    "Mitutoyo, two columns": (
        "formtracepak.csv",
        lambda z: ["X [mm],Z [um]", *(f"{i * 1e-3:.5f},{v * 1e6:.5f}" for i, v in enumerate(z[:, 0]))],
    ),
    "Dektak": (
        "dektak.csv",
        lambda z: [
            "Scan Length,48,um",
            "Lateral um,Total Profile um",
            *(f"{i},{v * 1e6:.5f}," for i, v in enumerate(z[:, 0])),
        ],
    ),
}


@pytest.mark.parametrize("name", PROFILES)
def test_a_profile_is_refused(name, heights, tmp_path):
    file, lines = PROFILES[name]
    (tmp_path / file).write_text("\n".join(lines(heights)))
    with pytest.raises(lubfric.InputError, match="profile of 48 points, not a map of heights"):
        lubfric.read_surface(tmp_path / file)


def test_points_in_a_unit_that_nobody_states_are_refused(heights, tmp_path):
    """In µm they would be a map of 48 x 72 m; with the unit they are read."""
    path = tmp_path / "sensofar.dat"
    path.write_text("\n".join(triplets(heights, (1e-6, 1e-6, 1e-6), " ")))
    with pytest.raises(lubfric.InputError, match="spacing = 1 x 2 m; allowed: .*give it: unit = 'um'"):
        lubfric.read_surface(path)
    surface = lubfric.read_surface(path, unit="um")
    assert surface.spacing == pytest.approx(STEPS) and np.allclose(surface.heights, heights, atol=1e-11)


def test_isolated_points_are_noted_where_a_map_is_read_and_what_masking_does_to_sq(tmp_path):
    rough = np.random.default_rng(3).normal(scale=1e-8, size=(40, 50))
    rough[7, 9] = 1e-6
    np.save(tmp_path / "spike.npy", rough)
    surface = lubfric.read_surface(tmp_path / "spike.npy", spacing=1e-6)
    assert any(note.startswith("1 isolated point stands above its neighbours") for note in surface.notes)
    masked = surface.without_outliers()
    (note,) = (note for note in masked.notes if "outliers masked" in note)
    assert f"takes Sq from {surface.sq * 1e9:.4g} to {masked.sq * 1e9:.4g} nm" in note and masked.sq < surface.sq
    np.save(tmp_path / "clean.npy", rough - rough * (rough > 1e-7))
    assert not any("isolated" in note for note in lubfric.read_surface(tmp_path / "clean.npy", spacing=1e-6).notes)
