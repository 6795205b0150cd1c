"""Height maps from files: every format and number type, and files made to mislead."""

import re
import sys
import zipfile

import numpy as np
import pytest
from instrument_files import write_sdf, write_sur, write_x3p

import lubfric
from lubfric import InputError, Surface, read_surface
from lubfric.surface import INSTRUMENTS, SUFFIXES

STEP = (1e-6, 2.5e-6)
GROUND = (0.5e-6, 2e-6)
RAW = {"level": False, "fill": False}


def heights(shape=(7, 5)):
    return 1e-7 * np.random.default_rng(0).standard_normal(shape)


# --- X3P ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind, increment, tolerance", [("D", None, 0), ("F", None, 2e-14), ("I", 1e-11, 5.1e-12), ("L", 1e-15, 5.1e-16)]
)
def test_x3p_every_number_type(tmp_path, kind, increment, tolerance):
    """Negative heights included: 16 and 32 bit integers are signed."""
    z = heights()
    z *= 3e-7 / np.abs(z).max()
    surface = read_surface(write_x3p(tmp_path / "a.x3p", z, kind, increment=increment), **RAW)
    assert surface.shape == z.shape and surface.spacing == STEP
    assert np.abs(surface.heights - z).max() <= tolerance and surface.mask is None


def test_x3p_axis_order_offset_and_preparation(tmp_path):
    """x runs fastest in the file and is axis 0 here; level() then removes offset and slope."""
    z = 1e-9 * np.add.outer(10 * np.arange(6.0), np.arange(4.0))
    x_fastest = np.array([z[i, j] for j in range(4) for i in range(6)])
    stored = write_x3p(tmp_path / "a.x3p", z, data=x_fastest.tobytes(), offset=5e-6)
    surface = read_surface(stored, **RAW)
    assert np.allclose(surface.heights, z + 5e-6, atol=1e-18)
    assert read_surface(stored).sq < 1e-20
    assert surface.source == "a.x3p"


@pytest.mark.parametrize("kind, increment", [("D", None), ("L", 1e-15)])
def test_x3p_masks(tmp_path, kind, increment):
    """Bits are packed lowest first in the order of the heights; NaN heights are unmeasured too."""
    z = heights((7, 5))
    mask = np.ones((7, 5), bool)
    mask[2, 3] = mask[0, 1] = False
    surface = read_surface(write_x3p(tmp_path / "a.x3p", z, kind, mask=mask, increment=increment), **RAW)
    assert np.array_equal(surface.mask, mask) and np.isnan(surface.heights[2, 3])
    filled = read_surface(tmp_path / "a.x3p")
    assert np.isfinite(filled.heights).all() and np.array_equal(filled.mask, mask)
    if kind == "D":
        z[4, 4] = np.nan
        both = read_surface(write_x3p(tmp_path / "b.x3p", z, mask=mask), **RAW)
        assert not both.mask[4, 4] and np.count_nonzero(~both.mask) == 3


def swap(old, new):
    return lambda text: text.replace(old, new).encode()


BOMB = '<!DOCTYPE a [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]>'
HOSTILE = {
    "no main.xml": {"skip": ("main.xml",)},
    "no data": {"skip": ("bindata/data.bin",)},
    "no mask member": {"skip": ("bindata/valid.bin",), "mask": np.eye(7, 5, dtype=bool)},
    "short data": {"data": b"\0" * 100},
    "long data": {"data": b"\0" * (7 * 5 * 8 + 1)},
    "wrong size": {"size": (7, 6)},
    "huge size": {"size": (999_999_999, 999_999_999)},
    "huge but plausible size": {"size": (100_000, 1_000)},
    "size with 30 digits": {"size": ("9" * 30, 5)},
    "negative size": {"size": (-7, -5)},
    "linked elsewhere": {"stored_name": "bindata/other.bin"},
    "entity expansion": {"xml": swap("<p:ISO5436_2", BOMB + "<p:ISO5436_2")},
    "entity expansion in UTF-16": {
        "xml": lambda t: t.replace("UTF-8", "UTF-16").replace("<p:ISO5436_2", BOMB + "<p:ISO5436_2", 1).encode("utf-16")
    },
    "broken XML": {"xml": swap("</Record1>", "")},
    "unknown encoding": {"xml": swap("UTF-8", "klingon")},
    "profile": {"xml": swap("SUR", "PRF")},
    "point cloud": {"xml": swap("<SizeZ>1", "<SizeZ>2")},
    "absolute x axis": {"xml": swap("<CX><AxisType>I", "<CX><AxisType>A")},
    "negative increment": {"xml": swap("<Increment>1e-06", "<Increment>-1e-06")},
    "increment missing": {"xml": swap("<Increment>1e-06</Increment>", "")},
    "unknown type": {"xml": swap("<DataType>D", "<DataType>Q")},
    "integers without increment": {"kind": "L"},
    "scaled floats": {"xml": swap("<DataType>D</DataType>", "<DataType>D</DataType><Increment>1e-9</Increment>")},
    "nothing measured": {"mask": np.zeros((7, 5), bool)},
    "infinite heights": {"data": np.full((7, 5), np.inf).tobytes()},
    "wrong checksum of the data": {"xml": lambda t: re.sub("(?<=PointData>)[0-9A-F]{32}", "0" * 32, t).encode()},
    "datum list and link": {"xml": swap("<DataLink>", "<DataList><Datum>1</Datum></DataList><DataLink>")},
    "checksum of main.xml": {"skip": ("md5checksum.hex",), "extra": (("md5checksum.hex", "0" * 32 + " *main.xml"),)},
    "huge XML": {"xml": lambda t: t.encode() + b" " * 2**23},
    "two documents": {"extra": (("main.xml", b"<a/>"),)},
}


@pytest.mark.parametrize("case", HOSTILE)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_x3p_refuses(tmp_path, case):
    path = write_x3p(tmp_path / "a.x3p", heights(), **HOSTILE[case])
    with pytest.raises(InputError) as error:
        read_surface(path)
    assert "allowed" in str(error.value) or "not a complete" in str(error.value)


@pytest.mark.parametrize(
    "link", ["bindata\\data.bin", "./bindata/data.bin", ".\\bindata\\data.bin", "/bindata/data.bin"]
)
def test_x3p_links_in_the_spellings_of_windows(tmp_path, link):
    z = heights()
    path = write_x3p(tmp_path / "a.x3p", z, data_name=link, stored_name="bindata/data.bin")
    assert np.array_equal(read_surface(path, **RAW).heights, z)
    with pytest.raises(InputError, match="members named"):
        read_surface(write_x3p(tmp_path / "b.x3p", z, data_name="../" + link, stored_name="bindata/data.bin"))


@pytest.mark.parametrize("kind, increment", [("D", None), ("L", 1e-12)])
def test_x3p_with_its_heights_in_the_xml(tmp_path, kind, increment):
    """A DataList: one Datum a point, x fastest, empty where unmeasured."""
    z = heights()
    raw = z if increment is None else np.rint(z / increment)
    data = [f"{value!r}" if increment is None else f"{value:.0f}" for value in raw.T.ravel().tolist()]
    data[3] = ""

    def listed(text):
        body = "".join(f"<Datum>{value}</Datum>" for value in data)
        return re.sub("<DataLink>.*</DataLink>", f"<DataList>{body}</DataList>", text, flags=re.S).encode()

    surface = read_surface(write_x3p(tmp_path / "a.x3p", z, kind, increment=increment, xml=listed), **RAW)
    measured = np.ones(z.shape, bool)
    measured[3, 0] = False
    assert np.array_equal(surface.mask, measured)
    np.testing.assert_allclose(surface.heights[measured], z[measured], rtol=0, atol=1e-12)
    for wrong in ("one", "1.5", "inf"):
        data[5] = wrong
        if kind == "L" or wrong != "1.5":
            with pytest.raises(InputError):
                read_surface(write_x3p(tmp_path / "b.x3p", z, kind, increment=increment, xml=listed))
    data.pop()
    with pytest.raises(InputError, match="number of Datum = 34"):
        read_surface(write_x3p(tmp_path / "c.x3p", z, kind, increment=increment, xml=listed))


def test_x3p_packed_in_a_way_that_breaks_off(tmp_path):
    """LZMA, cut short: its errors are no zip errors."""
    good = write_x3p(tmp_path / "a.x3p", heights())
    with zipfile.ZipFile(good) as old, zipfile.ZipFile(tmp_path / "b.x3p", "w", zipfile.ZIP_LZMA) as new:
        for info in old.infolist():
            new.writestr(info.filename, old.read(info))
    assert read_surface(tmp_path / "b.x3p", **RAW).shape == (7, 5)
    content = bytearray((tmp_path / "b.x3p").read_bytes())
    place = content.find(b"data.bin") + 8
    content[place : place + 60] = bytes(60)
    (tmp_path / "b.x3p").write_bytes(content)
    with pytest.raises(InputError, match="not a complete"):
        read_surface(tmp_path / "b.x3p")


@pytest.mark.parametrize("name", ["main.xml", "bindata/data.bin"])
def test_x3p_refuses_what_was_damaged_on_its_way(tmp_path, name):
    """A byte that changed: by the checksum that the archive has of every member."""
    path = write_x3p(tmp_path / "a.x3p", heights())
    content = bytearray(path.read_bytes())
    content[content.find(name.encode()) + len(name) + 40] ^= 1
    path.write_bytes(content)
    with pytest.raises(InputError, match="not a complete"):
        read_surface(path)


def test_x3p_refuses_a_bomb_before_unpacking_it(tmp_path):
    """100 MB of zeros in 100 kB, declared as a 7 x 5 map: the declared size is read, not the data."""
    import tracemalloc

    path = write_x3p(tmp_path / "a.x3p", heights(), skip=("bindata/data.bin",))
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bindata/data.bin", bytes(100 * 2**20))
    tracemalloc.start()
    with pytest.raises(InputError, match="at most 280 bytes"):
        read_surface(path)
    assert tracemalloc.get_traced_memory()[1] < 2**22
    tracemalloc.stop()


# --- text, npy, xyz ---------------------------------------------------------------------------


def test_npy(tmp_path):
    z = heights()
    np.save(tmp_path / "a.npy", z)
    surface = read_surface(tmp_path / "a.npy", spacing=STEP, **RAW)
    assert np.array_equal(surface.heights, z) and surface.spacing == STEP
    np.save(tmp_path / "b.npy", (z * 1e12).astype(np.int32))
    whole = read_surface(tmp_path / "b.npy", spacing=1e-3, unit="nm", **RAW)
    assert np.allclose(whole.heights, z * 1e3, atol=2e-9)


@pytest.mark.parametrize("suffix, separator", [(".txt", " "), (".csv", ","), (".asc", "\t"), (".dat", ";")])
def test_text_matrix(tmp_path, suffix, separator):
    z = heights()
    path = tmp_path / f"a{suffix}"
    np.savetxt(path, z, delimiter=separator, header="spacing = 1e-6 2.5e-6")
    assert np.allclose(read_surface(path, **RAW).heights, z, rtol=1e-12)
    assert read_surface(path).spacing == STEP
    np.savetxt(path, z * 1e9, delimiter=separator)
    assert np.allclose(read_surface(path, spacing=STEP, unit="nm", **RAW).heights, z, rtol=1e-12)


def test_text_nan_is_unmeasured(tmp_path):
    z = heights()
    z[3, 3] = np.nan
    np.savetxt(tmp_path / "a.txt", z)
    surface = read_surface(tmp_path / "a.txt", spacing=1e-6)
    assert not surface.mask[3, 3] and np.isfinite(surface.heights).all()
    assert surface.notes[0].startswith("levelled") and surface.notes[-1].startswith("filled")


def points(z):
    i, j = (a.ravel() for a in np.indices(z.shape))
    return np.stack([1.0 + STEP[0] * i, STEP[1] * j, z.ravel()], axis=1)


def test_xyz_in_any_order_and_unit(tmp_path):
    z = heights()
    path = tmp_path / "a.xyz"
    table = np.random.default_rng(2).permutation(points(z))
    np.savetxt(path, table, fmt="%.12e")
    surface = read_surface(path, **RAW)
    assert np.allclose(surface.heights, z) and surface.spacing == pytest.approx(STEP, rel=1e-5)
    np.savetxt(path, table * [1e6, 1e6, 1e6], fmt="%.12e")
    assert read_surface(path, unit="um").spacing == pytest.approx(STEP, rel=1e-5)
    np.savetxt(path, table[3:], fmt="%.12e")
    assert np.count_nonzero(~read_surface(path).mask) == 3


def test_xyz_without_a_whole_line_of_points(tmp_path):
    """Points left out are unmeasured, also when all of one grid line are; the grid keeps its spacing."""
    z = heights((9, 6))
    path = tmp_path / "a.xyz"
    keep = np.ones(z.shape, bool)
    keep[3:5] = False
    keep[:, 2] = False
    keep[7, 4] = False
    np.savetxt(path, points(z)[keep.ravel()], fmt="%.12e")
    surface = read_surface(path, **RAW)
    assert np.array_equal(surface.mask, keep) and surface.spacing == pytest.approx(STEP, rel=1e-5)
    assert np.allclose(surface.heights[keep], z[keep])
    np.savetxt(
        path, np.where(np.arange(3) == 2, np.where(keep.reshape(-1, 1), points(z), np.nan), points(z)), fmt="%.12e"
    )
    assert np.array_equal(read_surface(path, **RAW).mask, keep)


def test_xyz_refuses_what_is_no_uniform_grid(tmp_path):
    path = tmp_path / "a.xyz"
    good = points(heights()) * 1e6
    uneven = good.copy()
    uneven[good[:, 0] > good[:, 0].max() - 0.5, 0] += 0.3
    scattered = good.copy()
    scattered[:, :2] = np.random.default_rng(0).random((35, 2))
    stretched = good.copy()
    stretched[:, 1] = stretched[:, 1] ** 1.5
    for table, words in (
        (uneven, "not uniform"),
        (scattered, "uniform"),
        (stretched, "not uniform"),
        (np.vstack([good, good[:1]]), "more than once"),
        (good[:, :2], "columns"),
        (good[:1], "one value"),
        (np.where(good == good[3], np.nan, good), "NaN"),
    ):
        np.savetxt(path, table, fmt="%.9e")
        with pytest.raises(InputError, match=words):
            read_surface(path, unit="um")


# --- text: decimal commas, titles, units ------------------------------------------------------


@pytest.mark.parametrize("separator", [";", "\t", " ", "   ", "; ", ";\t"])
@pytest.mark.parametrize("number", ["%.9f", "%.9e", "%.9g"])
def test_decimal_commas_are_read_where_something_else_separates(tmp_path, separator, number):
    z = np.round(heights() * 1e9, 6)
    path = tmp_path / "a.csv"
    # a line without any comma under %g
    z[0] = [3, 1, 4, 1, 5]
    z[2, 3] = np.nan
    text = "\n".join(separator.join(number % v for v in row) for row in z)
    path.write_text(text.replace(".", ","))
    surface = read_surface(path, spacing=STEP, unit="nm", **RAW)
    assert np.allclose(surface.heights, z * 1e-9, rtol=1e-8, atol=0, equal_nan=True)
    assert "decimal comma" in surface.notes
    path.write_text(text)
    pointed = read_surface(path, spacing=STEP, unit="nm", **RAW)
    assert np.array_equal(pointed.heights, surface.heights, equal_nan=True) and pointed.notes == ()


def test_xyz_with_decimal_commas_and_titles(tmp_path):
    z = heights()
    path = tmp_path / "a.xyz"
    np.savetxt(path, points(z) * 1e6, fmt="%.9f", delimiter=";")
    path.write_text("X;Y;Z\n\u00b5m;\u00b5m;\u00b5m\n" + path.read_text().replace(".", ","), encoding="utf-8")
    surface = read_surface(path, unit="um", **RAW)
    assert np.allclose(surface.heights, z, atol=1e-15) and surface.spacing == pytest.approx(STEP)
    assert surface.notes == (
        "line 1 skipped as a title: 'X;Y;Z'",
        "line 2 read as a title: '\u00b5m;\u00b5m;\u00b5m'",
        "decimal comma",
        "columns in um, um, um by '\u00b5m;\u00b5m;\u00b5m'",
    )
    assert np.array_equal(read_surface(path, **RAW).heights, surface.heights)
    with pytest.raises(InputError, match="unit = nm, nm, nm is given, and file a.xyz says um, um, um"):
        read_surface(path, unit="nm")


@pytest.mark.parametrize(
    "text, found",
    [
        ("1,2,3\n4,5,7\n", [[1, 2, 3], [4, 5, 7]]),
        ("1.5,2\n3,5\n", [[1.5, 2], [3, 5]]),
        ("1, 2\n3, 5\n", [[1, 2], [3, 5]]),
        ("1,2\n3,-5\n", [[1, 2], [3, -5]]),
        ("1,2\n3,nan\n", [[1, 2], [3, np.nan]]),
        ("1,2,4,\n3,5,6,\n", [[1, 2, 4], [3, 5, 6]]),
        ("1;2;\n3;5;\n", [[1, 2], [3, 5]]),
        ("0,12 0,13\n1 2,5E-1\n", [[0.12, 0.13], [1, 0.25]]),
        ("1\t2,5\n3\t4\n", [[1, 2.5], [3, 4]]),
        ("height\n\n# none\n1 2\n# between\n3 5\n", [[1, 2], [3, 5]]),
        ("Scan 17, roller A 2\nPixel 0.01 x 0.01\n1 2 3 4 5\n4 5 6 7 8\n", [[1, 2, 3, 4, 5], [4, 5, 6, 7, 8]]),
    ],
)
def test_text_that_can_be_read_in_one_way(tmp_path, text, found):
    (tmp_path / "a.txt").write_text(text)
    surface = read_surface(tmp_path / "a.txt", spacing=0.01, unit="mm", **RAW)
    assert np.allclose(surface.heights * 1e3, found, rtol=1e-14, equal_nan=True)


@pytest.mark.parametrize(
    "text", ["1,2\n3,5\n", "1,5,2,5\n3,5,4,5\n", "-1,5E-07, 2,5E-07\n3,5E-07, 4,5E-07\n", "6, -9,8\n7, 1,5\n"]
)
def test_commas_that_can_be_either_need_a_word(tmp_path, text):
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=r"line 1 .*decimal = '\.'.*','"):
        read_surface(path, spacing=0.01)
    separated = read_surface(path, spacing=0.01, unit="mm", decimal=".", **RAW).heights
    assert separated.shape == (2, text.split("\n")[0].count(",") + 1)
    marks = {"1,2": [[1.2], [3.5]], "-1,": [[-1.5e-7, 2.5e-7], [3.5e-7, 4.5e-7]], "6, ": [[6, -9.8], [7, 1.5]]}
    if text[:3] in marks:
        z = read_surface(path, spacing=0.01, unit="mm", decimal=",", **RAW).heights
        assert np.allclose(z * 1e3, marks[text[:3]], rtol=1e-12)
    else:
        with pytest.raises(InputError, match="line 1"):
            read_surface(path, spacing=0.01, decimal=",")


@pytest.mark.parametrize(
    "text, options, words",
    [
        ("1 2\n3 4\nfoo\n5 6\n", {}, "line 3 has 'foo'"),
        ("# c\n\n1;2\n3;4;5\n", {}, "line 4 has 3 values, the first one 2"),
        ("1 2\n3 BUT\n", {}, "line 2 has 'BUT'.*'nan' where unmeasured"),
        ("1,5;2.5\n3;4\n", {}, "line 1 .*point where commas"),
        ("1.000,5;2\n3;4\n", {}, "thousands"),
        ("1;2,5\n3;4\n", {"decimal": "."}, "line 1 .*decimal = ','"),
        ("1,5,2,5,\n3,5,4,5,\n", {}, "decimal = '.'"),
        ("1.5 2\n3 4\n", {"decimal": ","}, "line 1 .*point"),
        ("1 2\n3 4\n", {"decimal": ";"}, "decimal = ';'"),
        ("Scan 5\n1 2\n3 4\n", {}, "line 1 'Scan 5'"),
        ("1 2 3 left\n3 4 5 6\n", {}, "line 1 .*unmeasured"),
        ("only words\n", {}, "no numbers"),
        ("seen with blue light, nm\n3 4\n1 2\n", {}, "line 1 .*unit = 'nm'"),
        ("x/mm z/um\n3 4\n1 2\n", {}, "mm and um"),
        ("1\t\t2\n3\t4\n", {}, "line 2 has 2 values, the first one 3"),
    ],
)
def test_text_errors_name_the_line(tmp_path, text, options, words):
    (tmp_path / "a.txt").write_text(text)
    with pytest.raises(InputError, match=words):
        read_surface(tmp_path / "a.txt", spacing=0.01, **options)


def test_options_that_do_not_apply_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", heights())
    for options in ({"decimal": ","}, {"form": "cubic"}, {"form": "quadratic", "level": False}):
        with pytest.raises(InputError, match=next(iter(options))):
            read_surface(tmp_path / "a.npy", spacing=STEP, **options)


# --- form -------------------------------------------------------------------------------------


def test_second_order_form_of_short_and_thin_maps():
    thin = Surface(np.arange(6.0)[:, None] ** 2, 1.0)
    assert not thin.level("quadratic").heights.round(12).any() and thin.level().heights.round(12).any()
    saddle = Surface(np.array([[1.0, 0.0], [0.0, 1.0]]), 1.0)  # two points an axis: only the mixed term is left
    assert not saddle.level("quadratic").heights.round(12).any() and np.allclose(np.abs(saddle.level().heights), 0.5)
    mask = np.zeros((6, 6), bool)
    mask[[1, 4]] = True  # two lines: no curvature across them
    with pytest.raises(InputError, match="'quadratic'"):
        Surface(np.zeros((6, 6)), 1.0, mask=mask).level("quadratic")


HUGE_NPY = (
    b"\x93NUMPY\x01\x00v\x00"
    + b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999, 99999999), }".ljust(117)
    + b"\n"
)


@pytest.mark.parametrize(
    "name, content, options",
    [("missing.npy", None, {"spacing": 1e-6}), ("a.npy", HUGE_NPY, {"spacing": 1e-6})]
    + [("a.txt", b"\xff\xfe\x00\x81", {"spacing": 1e-6}), ("a.txt", b"1 2\n3 inf\n", {"spacing": 1e-6})]
    + [("a.txt", b"nan nan\nnan nan\n", {"spacing": 1e-6}), ("a.txt", b"1 2\n3 4\n", {})]
    + [("a.txt", b"1 2\n3 4\n", {"spacing": 1e-6, "unit": "inch"})]
    + [("a.txt", b"# spacing = 1e-6 1e-6\n1 2\n3 4\n", {"spacing": 2e-6})]
    + [("a.xyz", b"0 0 1\n0 1 1\n1 0 1\n1 1 1\n", {"spacing": 1e-6}), ("a.x3p", b"PK", {"spacing": 1e-6})],
)
def test_reader_refuses(tmp_path, name, content, options):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError):
        read_surface(tmp_path / name, **options)


# --- files of instruments ---------------------------------------------------------------------


def tilted(path):
    """Roughness on a steep tilt, and the roughness by a fit of its own."""
    z = heights((40, 30))
    write_sdf(path, z + 1e-2 * STEP[0] * np.arange(40)[:, None], STEP)
    terms = np.stack([np.ones(z.size), *np.indices(z.shape).reshape(2, -1)], axis=1)
    return z - (terms @ np.linalg.lstsq(terms, z.ravel(), rcond=None)[0]).reshape(z.shape)


def with_holes(path):
    """Points unmeasured, and spikes beside them."""
    rough = lubfric.generate_surface((60, 50), STEP, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=4)
    z = rough.heights.copy()
    z[[20, 40], 31] = 4e-6
    z[10:13, 8:10] = np.nan
    return write_sur(path, z, STEP)


def test_instrument_files(tmp_path, instruments):
    """Heights, extent and missing points as written, in another unit each; a key that applies to none is refused."""
    flat = tilted(tmp_path / "tilted.sdf")
    surface = read_surface(tmp_path / "tilted.sdf")
    raw = read_surface(tmp_path / "tilted.sdf", **RAW)
    assert surface.shape == (40, 30) and surface.size == pytest.approx((40e-6, 75e-6))
    assert np.allclose(surface.heights, flat, atol=1e-15) and raw.sq > 1.05 * surface.sq
    holes = read_surface(with_holes(tmp_path / "holes.sur"), **RAW)
    assert holes.spacing == pytest.approx(STEP) and holes.missing_fraction == pytest.approx(6 / 3000)
    assert np.argwhere(~holes.mask).tolist() == [[x, y] for x in (10, 11, 12) for y in (8, 9)]
    assert holes.heights[20, 31] == pytest.approx(4e-6, rel=1e-6) and holes.largest_ratio > 20
    for name in ("tilted.sdf", "holes.sur"):
        for option in ({"spacing": 1e-6}, {"unit": "um"}, {"decimal": ","}, {"missing_value": 0.0}):
            with pytest.raises(InputError, match=next(iter(option))):
                read_surface(tmp_path / name, **option)


def test_every_format_of_the_optional_package_is_known():
    pytest.importorskip("SurfaceTopography", reason="optional package for instrument formats")
    from SurfaceTopography.IO import readers

    result = {f".{word}" for reader in readers for word in reader.file_extensions() or ()}
    assert result <= set(INSTRUMENTS) | set(SUFFIXES)


@pytest.mark.parametrize("name", ["map.sur", "map.al3d", "map.opd", "map.dat", "map.zip", "map.mnt", "map.xlsx"])
@pytest.mark.parametrize("content", [b"", b"\0" * 300, bytes(range(256)) * 40])
def test_instrument_files_that_are_none(tmp_path, instruments, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match="path"):
        read_surface(tmp_path / name)


def test_without_the_optional_package_the_error_names_the_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    (tmp_path / "map.sur").write_bytes(b"x")
    with pytest.raises(InputError, match=r"lubfric\[formats\]"):
        read_surface(tmp_path / "map.sur")
    (tmp_path / "map.foo").write_bytes(b"x")
    with pytest.raises(InputError, match=r"\.foo.*\.x3p.*lubfric\[formats\].*\.sur"):
        read_surface(tmp_path / "map.foo")


@pytest.mark.parametrize("suffix", [".npy", ".txt", ".xyz"])
def test_a_number_can_stand_for_not_measured(tmp_path, suffix):
    """In the unit of the file; the same map as with NaN."""
    z = heights((20, 30)) * 1e9
    z[3, 4] = z[10, 11] = -9999.0
    path = tmp_path / f"map{suffix}"
    options = {"unit": "nm", "spacing": 2e-7}
    if suffix == ".npy":
        np.save(path, z)
    elif suffix == ".txt":
        np.savetxt(path, z, fmt="%.6f")
    else:
        x, y = np.meshgrid(200.0 * np.arange(20), 200.0 * np.arange(30), indexing="ij")
        np.savetxt(path, np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1), fmt="%.6f")
        options.pop("spacing")
    surface = read_surface(path, **options, missing_value=-9999, **RAW)
    assert np.argwhere(~surface.mask).tolist() == [[3, 4], [10, 11]] and np.isnan(surface.heights[3, 4])
    assert np.nanmax(np.abs(surface.heights)) < 1e-6 and "2 points" in surface.notes[-1]
    with pytest.raises(InputError, match="none of"):
        np.save(tmp_path / "all.npy", np.full((3, 3), 7.0))
        read_surface(tmp_path / "all.npy", spacing=1e-6, missing_value=7)
    with pytest.raises(InputError, match="missing_value"):
        read_surface(path, **options, missing_value="-")


def test_a_missing_value_is_found_in_the_precision_of_the_file(tmp_path):
    heights = np.random.default_rng(1).normal(0, 1e-7, (8, 9))
    heights[2, 3] = -99.9
    for kind in ("<f4", ">f4", "<f8"):
        np.save(tmp_path / "map.npy", heights.astype(kind))
        surface = read_surface(tmp_path / "map.npy", spacing=1e-6, missing_value=-99.9, **RAW)
        assert np.argwhere(~surface.mask).tolist() == [[2, 3]] and abs(surface.measured).max() < 1e-6
