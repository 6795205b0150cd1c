"""Text files as programs of instruments export them: what their headers say is read, what contradicts it is refused."""

import numpy as np
import pytest
from instrument_files import metres_after

from lubfric import InputError, generate_surface, read_surface

RAW = {"level": False, "fill": False}
DX, DY = 0.5e-6, 1.25e-6


def rough(nx=24, ny=10):
    """Heights [m] with a lay, not symmetric in x and y."""
    made = generate_surface((96, 64), (DX, DY), sq=80e-9, correlation_length=(1.5e-6, 4e-6), acf="gaussian", seed=3)
    return made.cropped((nx, ny)).heights.copy()


def rows(values, form="%.9g", separator="\t", missing="nan"):
    """Lines of numbers; NaN as the mark ``missing``."""
    cells = [[missing if np.isnan(value) else form % value for value in row] for row in values]
    return "\n".join(separator.join(row) for row in cells) + "\n"


def gwyddion(z, width="12.000 µm", height="12.500 µm", unit="m", scale=1.0, words=("Width", "Height", "Value units")):
    """Gwyddion's 'ASCII data matrix' with its header: x runs along the lines."""
    head = f"# Channel: Height\n# {words[0]}: {width}\n# {words[1]}: {height}\n# {words[2]}: {unit}\n"
    return head + rows(z.T * scale, "%.8e")


def spip(z):
    """SPIP's ASCII export: lengths in nm where no unit stands."""
    nx, ny = z.shape
    head = "# File Format = ASCII\n# Created by SPIP 6.2\n# Original file: a.spm\n"
    head += f"# x-pixels = {nx}\n# y-pixels = {ny}\n# x-length = {nx * DX * 1e9}\n# y-length = {ny * DY * 1e9}\n"
    head += "# x-offset = 0\n# y-offset = 0\n# z-unit = nm\n# voidpixels =0\n# Start of Data:\n"
    return head + rows(z.T * 1e9)


def wyko(z, real=0, more=""):
    """Wyko's ASCII: one line of the file is one x; waves of 632.8 nm over Mult."""
    nx, ny = z.shape
    unit = 1e-9 if real else 632.8e-9 / 2
    head = f"Wyko ASCII Data File Format 0\t{real}\t1\nX Size\t{nx}\nY Size\t{ny}\nBlock Name\tType\tLength\tValue\n"
    head += f"Wavelength\t7\t4\t632.8\nTitle\t5\t20\tRing 3, side A\nPixel_size\t7\t4\t{DX * 1e3}\nMult\t6\t2\t2\n"
    head += f"Aspect\t7\t4\t{DY / DX}\nRAW_DATA\t3\t{8 * nx * ny}\t\n"
    return head + rows(z / unit, "%.8e", missing="Bad") + more


def mountains(z):
    """Statements of an axis in one line, as MountainsMap's report of a studiable has them; decimal commas, tabs."""
    nx, ny = z.shape
    head = "MountainsMap text export\n"
    head += f"X Axis: Length = {nx * DX * 1e6:.6f} µm; Size = {nx} points; Spacing = {DX * 1e6:.6f} µm\n"
    head += f"Y Axis: Length = {ny * DY * 1e6:.6f} µm; Size = {ny} lines; Spacing = {DY * 1e6:.6f} µm\n"
    head += "Z-unit: nm\n"
    return (head + rows(z.T * 1e9, "%.6f")).replace(".", ",")


def esri(z):
    """The grid of ESRI: only for square cells, so the map is taken at dx = dy."""
    nx, ny = z.shape
    head = f"ncols {nx}\nnrows {ny}\ncellsize 0.5 um\nNODATA_value -9999\nz unit: nm\n"
    return head + rows(z.T * 1e9, separator=" ", missing="-9999")


FORMATS = {
    "Gwyddion": gwyddion,
    "Gwyddion, German": lambda z: gwyddion(z, words=("Breite", "Höhe", "Einheiten")),
    "Gwyddion, nm": lambda z: gwyddion(z, unit="nm", scale=1e9),
    "SPIP": spip,
    "Wyko, waves": wyko,
    "Wyko, nm": lambda z: wyko(z, 1),
    "MountainsMap": mountains,
}


@pytest.mark.parametrize("name", FORMATS)
def test_a_header_gives_the_spacing_the_unit_and_the_direction(tmp_path, name):
    """Nothing is given but the file; what it says may be given again, and not contradicted."""
    z = rough()
    path = tmp_path / "map.txt"
    path.write_text(FORMATS[name](z), encoding="utf-8")
    surface = read_surface(path, **RAW)
    assert surface.shape == z.shape
    np.testing.assert_allclose(surface.heights, z, rtol=0, atol=2e-15)
    assert surface.spacing == pytest.approx((DX, DY), rel=1e-6)
    assert read_surface(path, spacing=(DX, DY), **RAW).spacing == pytest.approx((DX, DY), rel=1e-6)
    with pytest.raises(InputError, match="spacing = .* is given, and"):
        read_surface(path, spacing=(10 * DX, 10 * DY))
    with pytest.raises(InputError, match="unit = 'mm' is given"):
        read_surface(path, unit="mm", **RAW)


def test_a_note_says_the_form_of_a_header_and_not_its_program(tmp_path):
    """Other programs write the lines of Gwyddion's header as well."""
    path = tmp_path / "map.txt"
    path.write_text(gwyddion(rough()), encoding="utf-8")
    assert "header in the form of Gwyddion" in read_surface(path, **RAW).notes


def test_missing_points_are_marked_in_many_ways(tmp_path):
    z = rough()
    z[3, 4] = z[10, 0] = z[0, 2] = z[23, 9] = np.nan
    for mark in (
        "No Data",
        "NoData",
        "BAD",
        "Bad",
        "---",
        "--",
        "-",
        "*",
        "***",
        "n/a",
        "#N/A",
        "NaN",
        "null",
        "1.#QNAN",
    ):
        for separator in ("\t", ";", ",", " "):
            path = tmp_path / "map.csv"
            path.write_text(rows(z * 1e9, separator=separator, missing=mark))
            surface = read_surface(path, spacing=(DX, DY), unit="nm", **RAW)
            np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0, equal_nan=True)
    path.write_text(rows(z * 1e9, separator=";", missing=""))
    assert np.array_equal(read_surface(path, spacing=(DX, DY), unit="nm", **RAW).mask, ~np.isnan(z))
    path.write_text(wyko(z))
    np.testing.assert_allclose(read_surface(path, **RAW).heights, z, atol=1e-15, rtol=0, equal_nan=True)


def test_a_value_that_a_header_names_is_missing(tmp_path):
    z = rough()
    z[5, 5] = np.nan
    path = tmp_path / "map.asc"
    path.write_text(esri(z))
    surface = read_surface(path, **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0, equal_nan=True)
    assert surface.spacing == pytest.approx((0.5e-6, 0.5e-6))


def test_the_first_of_several_blocks_is_read(tmp_path):
    z = rough()
    path = tmp_path / "map.txt"
    path.write_text(gwyddion(z) + gwyddion(2 * z).replace("Height\n#", "Phase\n#", 1), encoding="utf-8")
    surface = read_surface(path, **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0)
    assert any("first of several blocks" in note for note in surface.notes)
    path.write_text(wyko(z, more=f"Intensity\t3\t{8 * z.size}\t\n" + rows(np.full(z.shape, 100.0))))
    surface = read_surface(path, **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0)
    assert "first block of 2" in surface.notes


@pytest.mark.parametrize(
    "change, words",
    [
        (("# Width: 12.000 µm", "# Width: 12.000 µm\n# Width: 120.000 µm"), "contradicts itself about width"),
        (("# Value units: m", "# Value units: m\n# z-unit: nm"), "contradicts itself about z unit"),
        (("# Width: 12.000 µm", "# Width: 12.000 µm\n# x-pixels = 512"), "header line 3 '# x-pixels = 512'"),
        (("# Width: 12.000 µm", "# Width: 12.000 µm\n# Step X: 5 µm"), "do not agree with"),
        (("# Value units: m", "# Value units: V"), "values are in 'V'"),
        (("# Value units: m", "# Value units: deg"), "values are in 'deg'"),
    ],
)
def test_a_header_that_contradicts_itself_or_the_table_is_refused(tmp_path, change, words):
    path = tmp_path / "map.txt"
    text = gwyddion(rough())
    assert change[0] in text
    path.write_text(text.replace(*change), encoding="utf-8")
    with pytest.raises(InputError, match=words):
        read_surface(path)


@pytest.mark.parametrize(
    "name", ["X Size\t25", "Y Size\t9", "Pixel_size\t7\t4\t0", "Pixel_size\t7\t4\tbig", "Mult\t6\t2\t-1"]
)
def test_a_wyko_header_that_cannot_be_is_refused(tmp_path, name):
    path = tmp_path / "map.asc"
    lines = wyko(rough()).split("\n")
    key = name.split("\t")[0]
    path.write_text("\n".join(name if line.startswith(key) else line for line in lines))
    with pytest.raises(InputError, match="map.asc"):
        read_surface(path)
    path.write_text("\n".join(line for line in lines if not line.startswith("RAW")))
    with pytest.raises(InputError, match="no block of heights"):
        read_surface(path)


# --- points, profiles, coordinates -------------------------------------------------------------


def triplets(z):
    i, j = np.indices(z.shape).reshape(2, -1)
    return np.stack([i * DX, j * DY, z.ravel()], axis=1)


@pytest.mark.parametrize("suffix", [".xyz", ".txt", ".csv", ".dat"])
def test_a_unit_for_each_column(tmp_path, suffix):
    """x and y in mm, heights in um: by headings, by a line of units, or by the caller."""
    z = rough()
    table = rows(triplets(z) * [1e3, 1e3, 1e6], "%.9e", ";")
    for head in (
        "X [mm];Y [mm];Z [µm]\n",
        "X;Y;Z\nmm;mm;µm\n",
        "x/mm;y/mm;z/µm\n",
        "# x (mm), y (mm), z (um)\nx;y;z\n",
    ):
        path = tmp_path / f"map{suffix}"
        path.write_text(head + table, encoding="utf-8")
        options = {"unit": ("mm", "um")} if head.startswith("#") else {}
        surface = read_surface(path, **options, **RAW)
        np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0)
        assert surface.spacing == pytest.approx((DX, DY), rel=1e-6)
        if not options:
            with pytest.raises(InputError, match="unit = um, um, um is given"):
                read_surface(path, unit="um")
    path.write_text("X;Y;Z\n" + table, encoding="utf-8")
    for unit in (("mm", "um"), ["mm", "mm", "µm"]):
        np.testing.assert_allclose(read_surface(path, unit=unit, **RAW).heights, z, atol=1e-15, rtol=0)
    with pytest.raises(InputError, match="unit"):
        read_surface(path, unit=("mm", "mm", "um", "um"))


def test_triplets_are_no_map(tmp_path):
    """A matrix of three columns that are coordinates and heights is read as points, or refused."""
    z = rough()
    path = tmp_path / "map.txt"
    path.write_text(rows(triplets(z), "%.9e"))
    np.testing.assert_allclose(read_surface(path, **RAW).heights, z, atol=1e-15, rtol=0)
    with pytest.raises(InputError, match="spacing = 1e-06, 1e-06 m is given"):
        read_surface(path, spacing=1e-6)
    for table in (triplets(z)[:, [0, 1, 2, 2]], np.column_stack([np.arange(z.size), triplets(z)])):
        path.write_text(rows(table, "%.9e"))
        with pytest.raises(InputError, match="4 columns, of which two are coordinates"):
            read_surface(path, spacing=1e-6)
    scattered = np.random.default_rng(1).random((60, 3)) * 1e-6
    path.write_text(rows(scattered, "%.9e"))
    with pytest.raises(InputError, match="not points x y z on a grid"):
        read_surface(path, spacing=1e-6)
    for array in (triplets(z), scattered, triplets(z).T, scattered.T):
        np.save(tmp_path / "map.npy", array)
        with pytest.raises(InputError):
            read_surface(tmp_path / "map.npy", spacing=1e-6)


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_a_profile_is_refused_with_its_statistics(tmp_path, columns):
    """x rising evenly beside z: no map of two columns. Sq and length by their definitions."""
    n = 4000
    made = generate_surface((n, 128), 0.5e-6, sq=300e-9, correlation_length=10e-6, acf="exponential", seed=1)
    z = made.heights[:, 0] - made.heights[:, 0].mean()
    x = 0.5e-6 * np.arange(n)
    table = np.column_stack([x, z, z])[:, [[1], [0, 1], [0, 1, 2]][columns - 1]]
    for suffix in (".txt", ".csv", ".npy", ".dat"):
        path = tmp_path / f"trace{suffix}"
        np.save(path, table) if suffix == ".npy" else path.write_text(rows(table, "%.9e", ";"))
        with pytest.raises(InputError, match="profile of 4000 points.*sq and correlation_length") as error:
            read_surface(path, spacing=0.5e-6, unit="m")
        sq = metres_after("Sq ", str(error.value))
        assert sq == pytest.approx(z.std(), rel=0.02)
        if columns == 2:
            length = metres_after("correlation length ", str(error.value))
            assert length == pytest.approx(10e-6, rel=0.4)
    (tmp_path / "one.txt").write_text(rows(z[None, :]))
    with pytest.raises(InputError, match="profile"):
        read_surface(tmp_path / "one.txt", spacing=1e-6)


@pytest.mark.parametrize("corner", ["0", "", "X\\Y", "nan"])
@pytest.mark.parametrize("unit", ["given", "stated"])
def test_coordinates_beside_the_heights_are_taken_off(tmp_path, corner, unit):
    z = rough()
    x = np.arange(24) * DX * 1e6
    y = np.arange(10) * DY * 1e6
    body = [f"{x[i]:.3f};" + ";".join(f"{value * 1e9:.6f}" for value in z[i]) for i in range(24)]
    text = f"{corner};" + ";".join(f"{value:.3f}" for value in y) + "\n" + "\n".join(body) + "\n"
    path = tmp_path / "map.csv"
    head = "x-unit: um\nz-unit: nm\n" if unit == "stated" else ""
    path.write_text(head + text)
    options = {} if unit == "stated" else {"spacing": (DX, DY), "unit": "nm"}
    surface = read_surface(path, **options, **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0)
    assert surface.spacing == pytest.approx((DX, DY), rel=1e-3)
    assert any("coordinates taken off" in note for note in surface.notes)
    with pytest.raises(InputError):
        read_surface(path, spacing=(2 * DX, DY), unit="nm")
    if unit == "given":
        with pytest.raises(InputError, match="no line states their unit"):
            read_surface(path, unit="nm")


@pytest.mark.parametrize(
    "mark, corner",
    [(",", "x [um] \\ y [um]"), (";", "x (µm) / y (µm)"), ("\t", "x[mm]\\y[mm]"), (",", "y [um] \\ x [um]")],
)
def test_a_label_in_the_corner_of_coordinates_names_their_unit(tmp_path, mark, corner):
    """The word on the left of a backslash is of the rows; the same map, turned, where that is y."""
    z = rough()
    scale = 1e3 if "mm" in corner else 1e6
    is_turned = corner.startswith("y")
    (first, second) = (np.arange(24) * DX * scale, np.arange(10) * DY * scale)
    table = z if not is_turned else z.T
    (down, along) = (first, second) if not is_turned else (second, first)
    head = mark.join([corner, *(f"{value:.6f}" for value in along)])
    body = [mark.join([f"{a:.6f}", *(f"{1e9 * value:.6f}" for value in row)]) for a, row in zip(down, table)]
    path = tmp_path / "map.csv"
    path.write_text("\n".join(["# a map", head, *body]) + "\n", encoding="utf-8")
    surface = read_surface(path, unit="nm", **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-14, rtol=0)
    assert surface.spacing == pytest.approx((DX, DY), rel=1e-3)
    assert any(note.startswith("line 2 read as a title") for note in surface.notes)


def test_an_unreadable_line_is_quoted_as_the_file_has_it(tmp_path):
    path = tmp_path / "map.csv"
    path.write_text("1,2,3,4\n5,---,7 g,8\n" + "1,2,3,5\n" * 6)
    with pytest.raises(InputError, match="line 2 has") as error:
        read_surface(path, spacing=1e-6, unit="nm")
    assert "nan'" not in str(error.value).partition("line 2 has")[2].partition(";")[0]


@pytest.mark.parametrize("side", ["column", "row"])
def test_a_row_or_a_column_of_coordinates_alone(tmp_path, side):
    z = rough()
    table = z * 1e9
    if side == "column":
        table = np.column_stack([np.arange(24) * DX * 1e3, table])
    else:
        table = np.vstack([np.arange(10) * DY * 1e3, table])
    path = tmp_path / "map.txt"
    path.write_text(rows(table))
    surface = read_surface(path, spacing=(DX, DY), unit="nm", **RAW)
    np.testing.assert_allclose(surface.heights, z, atol=1e-15, rtol=0)
    with pytest.raises(InputError, match="first .* coordinates"):
        read_surface(path, spacing=(3 * DX, 3 * DY), unit="nm")
    with pytest.raises(InputError, match="first .* coordinates"):
        read_surface(path, unit="nm")


@pytest.mark.parametrize("share", [0.04, 0.12])
def test_jitter_is_interpolated_and_reported(tmp_path, share):
    """Heights of a smooth function at points off the grid become those on the grid."""

    def wave(x, y):
        return 50e-9 * np.sin(2 * np.pi * x / 12e-6 + 0.3) * np.cos(2 * np.pi * y / 25e-6)

    i, j = np.indices((40, 30)).reshape(2, -1)
    off = np.random.default_rng(0).uniform(-share, share, (2, i.size))
    x = (i + off[0]) * DX
    y = (j + off[1]) * DY
    path = tmp_path / "map.xyz"
    np.savetxt(path, np.stack([x, y, wave(x, y)], axis=1), fmt="%.12e")
    surface = read_surface(path, **RAW)
    assert surface.shape == (40, 30) and surface.spacing == pytest.approx((DX, DY), rel=2e-3)
    exact = wave(*np.meshgrid(np.arange(40) * DX, np.arange(30) * DY, indexing="ij"))
    missed = np.abs(surface.heights - exact)[2:-2, 2:-2].max()
    moved = np.abs(wave(x, y) - wave(i * DX, j * DY)).max()
    assert missed < 0.2 * moved
    assert any("% of the spacing off a uniform grid: interpolated" in note for note in surface.notes)
    np.savetxt(path, np.stack([(i + 3 * off[0] / share * 0.1) * DX, y, wave(x, y)], axis=1), fmt="%.12e")
    with pytest.raises(InputError, match="not uniform"):
        read_surface(path)


def test_a_title_of_any_length_is_read_in_no_time(tmp_path):
    """Patterns that backtrack took 4.6 s of a title of 200 letters, growing with its fourth power."""
    import time

    path = tmp_path / "map.txt"
    for title in ("a" * 20000, "a " * 20000, "x" * 300 + "1" * 300, "step x " * 50, "# spacing" + " " * 20000 + "x"):
        path.write_text(f"{title}\n1 2 3\n4 5 7\n")
        before = time.process_time()
        try:
            read_surface(path, spacing=1e-3, unit="nm")
        except InputError:
            pass
        assert time.process_time() - before < 0.5


@pytest.mark.parametrize(
    "line", ["# nm", "nm", "# units: nm", "Units: nm", "# Heights in nm", "z [nm]", "# z/nm", "Height (nm)"]
)
def test_a_line_that_names_the_unit_of_the_heights(tmp_path, line):
    z = rough()
    path = tmp_path / "map.txt"
    path.write_text(f"{line}\n" + rows(z * 1e9))
    np.testing.assert_allclose(read_surface(path, spacing=(DX, DY), **RAW).heights, z, atol=1e-15, rtol=0)
    with pytest.raises(InputError, match="unit = 'um' is given"):
        read_surface(path, spacing=(DX, DY), unit="um")
