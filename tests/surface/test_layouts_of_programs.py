"""Layouts of further programs, written here as these programs write them: each is read as what it is, or refused."""

import numpy as np
import pytest

from lubfric import InputError, generate_surface, read_surface

NX, NY = 48, 36
STEPS = (1e-6, 2e-6)
SQUARE = (1e-6, 1e-6)
RAW = {"level": False, "fill": False}


@pytest.fixture(scope="module")
def heights():
    """A rough map [m], (NX, NY), not symmetric in x and y, with three points that were not measured."""
    made = generate_surface((96, 72), STEPS, sq=1e-7, correlation_length=(5e-6, 8e-6), acf="gaussian", seed=3)
    z = made.cropped((NX, NY)).heights.copy()
    z[3, 5] = np.nan
    z[20:22, 7] = np.nan
    return z


def rows(z, unit, mark="\t", missing="nan", form="%.6f"):
    """Lines of a file in which x runs along the line."""
    return [mark.join(missing if np.isnan(value) else form % value for value in row) for row in z.T / unit]


def points(z, lateral, unit, mark="\t", missing=None):
    """Lines x y z; points that were not measured are left out, or marked."""
    lines = []
    for (i, j), value in np.ndenumerate(z):
        if missing is None and np.isnan(value):
            continue
        height = missing if np.isnan(value) else f"{value / unit:.7f}"
        lines.append(mark.join([f"{i * STEPS[0] / lateral:.7f}", f"{j * STEPS[1] / lateral:.7f}", height]))
    return lines


def iso(z, magic, heights, **changed):
    """A file of ISO 25178-71 as text; ``changed`` fields of its header."""
    fields = {"ManufacID": "lab 3", "CreateDate": "010120261200", "ModDate": "010120261200"}
    fields |= {"NumPoints": NX, "NumProfiles": NY, "Xscale": "1E-06", "Yscale": "2E-06", "Zscale": "1E-06"}
    fields |= {"Zresolution": -1, "Compression": 0, "DataType": 7, "CheckType": 0} | changed
    head = [f"{name:11} = {value}" for name, value in fields.items() if value is not None]
    return [magic, *head, "*", *heights, "*", "<Operator> J. Doe </Operator>", "*"]


def surfer(z, /, **changed):
    """A text grid of Surfer: rows of constant y from the lowest, ten numbers a line, blank lines between the rows."""
    low, high = np.nanmin(z) * 1e6, np.nanmax(z) * 1e6
    head = {"size": f"{NX} {NY}", "x": f"0 {NX - 1}", "y": f"0 {2 * (NY - 1)}", "z": f"{low:.6g} {high:.6g}"} | changed
    lines = ["DSAA", *head.values()]
    for row in np.where(np.isnan(z), 1.70141e38, z / 1e-6).T:
        words = [f"{value:.7g}" for value in row]
        lines += [" ".join(words[k : k + 10]) for k in range(0, NX, 10)] + [""]
    return lines


def esri(z):
    """The grid of ESRI, which has no units."""
    head = [f"ncols {NX}", f"nrows {NY}", "xllcorner 0.0", "yllcorner 0.0", "cellsize 1.0", "NODATA_value -9999"]
    return [*head, *rows(z, 1e-6, " ", "-9999")]


def keyence(z, language, calibration):
    """The .csv of a VK or VR microscope: quoted cells, the unit of the calibration in a cell of its own."""
    words = {
        "English": ("Measured date", "XY Calibration", "Output image data", "Horizontal", "Vertical", "Unit", "Height"),
        "German": ("Gemessenes Datum", "XY-Justierung", "Bilddatenausg.", "Horizont.", "Vertikal", "Einheit", "Höhe"),
        "Korean": ("측정 일시", "XY캘리브레이션", "출력 이미지 데이터", "가로", "세로", "단위", "높이"),
    }[language]
    date, step, data, across, down, unit, height = (f'"{word}"' for word in words)
    head = [f'{date},"2025-12-10 12:00:00"', '"Model","VK-X3000 Series"', f"{step},{calibration}", f"{data},{height}"]
    head += [f'{across},"{NX}"', f'{down},"{NY}"', '"Minimum value","-0.4"', f'{unit},"um"', "", height]
    return [*head, *(",".join(f'"{value:.6f}"' for value in row) for row in z.T / 1e-6)]


def nova(z):
    """The text export of NT-MDT's Nova: the unit of x and y on lines of their own."""
    head = ["File Format = ASCII", "Created by NOVA", f"NX = {NX}", f"NY = {NY}", "Scale X = 1.0", "Scale Y = 2.0"]
    return [*head, "Unit X = um", "Unit Y = um", "Unit Data = nm", "Start of Data :", *rows(z, 1e-9)]


def attocube(z, unit="um"):
    """The .asc of Daisy."""
    head = ["# Daisy frame view snapshot", "# 2026-01-01 12:00:00", f"# x-pixels: {NX}", f"# y-pixels: {NY}"]
    head += ["# x-length: 48", "# y-length: 72", "# x-offset: 0", f"# x-unit: {unit}", f"# y-unit: {unit}"]
    return [*head, "# z-unit: nm", "# Start of Data:", *rows(z, 1e-9)]


READ = {  # name: (file, lines of the heights, encoding, end of a line, what the caller gives, spacing)
    "ISO 25178-71, a value a line": (
        "a.sdf",
        lambda z: iso(z, "aISO-1.0", ["BAD" if np.isnan(v) else f"{v * 1e6:.7f}" for v in z.T.ravel()]),
        "ascii", "\r\n", {}, STEPS),
    "ISO 25178-71:2023, rows": ("a.sdf", lambda z: iso(z, "aISO-2.0", rows(z, 1e-6, " ", "BAD")), "ascii", "\n", {}, STEPS),
    "BCR": ("a.bcr", lambda z: iso(z, "aBCR-1.0", rows(z, 1e-6, " ", "BAD")), "ascii", "\r\n", {}, STEPS),
    "ISO 25178-71 as .txt": ("a.txt", lambda z: iso(z, "aISO-1.0", rows(z, 1e-6, " ", "BAD")), "utf-8-sig", "\n", {}, STEPS),
    "Surfer": ("a.grd", surfer, "ascii", "\r\n", {"unit": "um"}, STEPS),
    "Surfer, two units": (
        "a.grd", lambda z: surfer(z, x="0 0.047", y="0 0.07"), "ascii", "\n", {"unit": ("mm", "um")}, STEPS),
    "ESRI, a spacing given": ("a.asc", esri, "ascii", "\n", {"unit": "um", "spacing": 1e-6}, SQUARE),
    "Keyence, nm": ("a.csv", lambda z: keyence(z, "English", '"1000","nm"'), "utf-8", "\r\n", {}, SQUARE),
    "Keyence, nm/pixel": ("a.csv", lambda z: keyence(z, "German", '"1000","nm/pixel"'), "cp1252", "\r\n", {}, SQUARE),
    "Keyence, um": ("a.csv", lambda z: keyence(z, "German", '"1.000","um"'), "utf-16", "\r\n", {}, SQUARE),
    "Keyence, Korean": ("a.csv", lambda z: keyence(z, "Korean", '"1000","nm"'), "utf-16", "\r\n", {}, SQUARE),
    "Profilm": (
        "a.txt",
        lambda z: ["numCols\tnumRows\tpixelSize (um)", f"{NX}\t{NY}\t1.0", "Z-data (um)", *rows(z, 1e-6)],
        "ascii", "\r\n", {}, SQUARE),
    "Nova": ("a.txt", nova, "ascii", "\r\n", {}, STEPS),
    "Attocube": ("a.asc", attocube, "ascii", "\n", {}, STEPS),
    "FemtoScan": ("a.txt", lambda z: ["X,nm\tY,nm\tZ,nm", *points(z, 1e-9, 1e-9)], "ascii", "\n", {}, STEPS),
    "Gwyddion, blank lines": (
        "a.txt",
        lambda z: ["", "# Channel: Z", "", "# Width: 48.000 µm", "# Height: 72.000 µm", "# Value units: µm", "", *rows(z, 1e-6)],
        "utf-8-sig", "\r\n", {}, STEPS),
    "Gwyddion, two ends of a line": (
        "a.txt",
        lambda z: ["# Width: 48.000 µm\r", "# Height: 72.000 µm", "# Value units: nm\r", *rows(z, 1e-9)],
        "utf-8", "\n", {}, STEPS),
    "TalyMap": (
        "a.txt",
        lambda z: ["Taylor Hobson TalyMap 3D", f"Columns: {NX}  Rows: {NY}", "X Spacing: 0.001 mm", "Y Spacing: 0.002 mm",
                   "Z Unit: µm", "", *rows(z, 1e-6, missing="***")],
        "cp1252", "\r", {}, STEPS),
    "MountainsMap, points": (
        "a.xyz",
        lambda z: ["X [mm]\tY [mm]\tZ [µm]", *(line.replace(".", ",") for line in points(z, 1e-3, 1e-6))],
        "utf-16", "\r\n", {}, STEPS),
    "Sensofar, marked points": (
        "a.dat", lambda z: ["X\tY\tZ", *points(z, 1e-6, 1e-6, missing="***")], "ascii", "\n", {"unit": "um"}, STEPS),
}  # fmt: skip


def write(path, lines, encoding="utf-8", end="\n"):
    path.write_bytes((end.join(lines) + end).encode(encoding))
    return path


@pytest.mark.parametrize("name", READ)
def test_a_layout_is_read_as_it_is(name, heights, tmp_path):
    file, lines, encoding, end, given, steps = READ[name]
    surface = read_surface(write(tmp_path / file, lines(heights), encoding, end), **given, **RAW)
    assert surface.shape == (NX, NY) and surface.spacing == pytest.approx(steps, rel=1e-6)
    np.testing.assert_allclose(surface.heights, heights, atol=2e-12, rtol=0)
    assert np.array_equal(surface.mask, np.isfinite(heights))


def spoilt(lines, old, new):
    return lambda z: [line.replace(old, new) for line in lines(z)]


def sdf(z, **changed):
    return iso(z, "aISO-1.0", rows(z, 1e-6, " ", "BAD"), **changed)


REFUSED = {  # name: (file, lines of the heights, what the caller gives, words of the message)
    "ISO, cut off": ("a.sdf", lambda z: sdf(z)[:20], {}, "cut off: it has 1 of the marks"),
    "ISO, a height missing": ("a.sdf", lambda z: sdf(z, NumPoints=NX + 1), {}, "has 1728 heights, and its header states 1764"),
    "ISO, compressed": ("a.sdf", lambda z: sdf(z, Compression=1), {}, "Compression = '1'; allowed: 0"),
    "ISO, a checksum": ("a.sdf", lambda z: sdf(z, CheckType=1), {}, "CheckType"),
    "ISO, no step": ("a.sdf", lambda z: sdf(z, Xscale=None), {}, "does not state Xscale"),
    "ISO, step 0": ("a.sdf", lambda z: sdf(z, Xscale=0), {}, "Xscale .*0"),
    "ISO, no number": ("a.sdf", lambda z: sdf(z, Zscale="um"), {}, "Zscale = 'um' is no number"),
    "ISO, half a point": ("a.sdf", lambda z: sdf(z, NumPoints=48.5), {}, "whole number"),
    "ISO, stated twice": ("a.sdf", lambda z: [*sdf(z)[:2], "Xscale = 3e-6", *sdf(z)[2:]], {}, "states Xscale twice"),
    "ISO, a word": ("a.sdf", spoilt(sdf, "BAD", "bat"), {}, "BAD where unmeasured"),
    "ISO, a unit given": ("a.sdf", sdf, {"unit": "um"}, "states its own"),
    "ISO, another spacing": ("a.sdf", sdf, {"spacing": 3e-6}, "states 1e-06, 2e-06 m"),
    "ISO, a profile": (
        "a.sdf",
        lambda z: iso(z, "aISO-1.0", rows(z[:, :1], 1e-6, " "), NumProfiles=1, Yscale=0), {}, "profile of 48 points"),
    "Surfer, no unit": ("a.grd", surfer, {}, "does not state the units of x, y and the heights"),
    "Surfer, cut off": ("a.grd", lambda z: surfer(z)[:-9], {"unit": "um"}, "its header states 48 x 36"),
    "Surfer, other heights": ("a.grd", lambda z: surfer(z, z="0 99"), {"unit": "um"}, "states heights from 0 to 99"),
    "Surfer, no extent": ("a.grd", lambda z: surfer(z, x="3 3"), {"unit": "um"}, "states x from 3 to 3"),
    "ESRI, no spacing": ("a.asc", esri, {"unit": "um"}, "'cellsize 1.0' have no unit"),
    "ESRI, another spacing": ("a.asc", esri, {"unit": "um", "spacing": (1e-6, 2e-6)}, "states line 5 'cellsize 1.0'"),
    "Keyence, cut off": ("a.csv", lambda z: keyence(z, "English", '"1000","nm"')[:-1], {}, "has 35 lines"),
    "Attocube, another spacing": ("a.asc", lambda z: attocube(z, "nm"), {"spacing": STEPS}, "states 1e-09, 2e-09 m"),
    "Nova, two units": ("a.txt", spoilt(nova, "Unit Y = um", "Unit Y = nm"), {}, "contradicts itself about xy unit"),
    "Polytec, validity": (
        "a.txt", lambda z: ["X [µm];Y [µm];Z [µm];Valid", *(f"{p};1" for p in points(z, 1e-6, 1e-6, ";", "0"))],
        {}, "4 columns, of which two are coordinates"),
    "Mahr, a profile": (
        "a.csv",
        lambda z: ["X;Y;valid", "[mm];[mm];[1/0]", *(f"{i * 1e-3:.6f};{v * 1e3:.8f};1" for i, v in enumerate(z[:, 0]))],
        {}, "profile of 48 points"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_layout_that_cannot_be_read_is_refused(name, heights, tmp_path):
    file, lines, given, words = REFUSED[name]
    with pytest.raises(InputError, match=words):
        read_surface(write(tmp_path / file, lines(heights)), **given)


@pytest.mark.parametrize("content", [b"DSBB\x02\0\x02\0", b"DSRB\x04\0\0\0"])
def test_a_binary_grid_of_surfer_is_refused(content, tmp_path):
    (tmp_path / "a.grd").write_bytes(content)
    with pytest.raises(InputError, match="binary grid of Surfer; save it as a Surfer 6 text grid"):
        read_surface(tmp_path / "a.grd")


@pytest.mark.parametrize("line", ["# Inverted: Yes", "# Inverted = 1", "# Replica: true", "# z positive downwards"])
def test_heights_that_may_fall_out_of_the_material_are_refused(line, heights, tmp_path):
    """Valleys for peaks carry no load: such a map has to be turned by whoever knows it."""
    head = ["# Width: 48 um", "# Height: 72 um", "# Value units: nm"]
    path = write(tmp_path / "a.txt", [*head, line, *rows(heights, 1e-9)])
    with pytest.raises(InputError, match="line 4 .* does not define the sign of the heights"):
        read_surface(path)
    write(path, [*head, "# Inverted: No", "# Depth of field: 3 um", *rows(heights, 1e-9)])
    assert np.allclose(read_surface(path, **RAW).heights, heights, atol=1e-12, equal_nan=True)
    with pytest.raises(InputError, match="'Depth .um.' does not define the sign"):
        read_surface(write(path, ["Depth [um]", *rows(heights, 1e-6)]), spacing=STEPS)


@pytest.mark.parametrize(
    "thousand", [lambda text: text, lambda text: text.replace(",", " "), lambda text: text.replace(",", "'")]
)
def test_marks_of_thousands_are_refused(thousand, heights, tmp_path):
    """4,991 nm would be read as 4.991 nm: where every comma stands before three digits it can be either."""
    z = np.nan_to_num(heights)
    lines = [";".join(thousand(f"{value * 1e9 + 5000:,.0f}") for value in row) for row in z.T]
    path = write(tmp_path / "a.csv", lines)
    with pytest.raises(InputError, match="line 1"):
        read_surface(path, spacing=STEPS, unit="nm")
    for text in (
        "4,991;5,006;4,012\n5,1;5,2;4,999\n",
        "0,991;-0,006\n0,001;0,012\n",
    ):  # decimal commas, without a doubt
        path.write_text(text)
        assert "decimal comma" in read_surface(path, spacing=0.01, unit="mm", **RAW).notes
    path.write_text("4,991;5,006\n5,001;5,012\n")
    z = read_surface(path, spacing=0.01, unit="mm", decimal=",", **RAW).heights
    assert z[0, 0] == pytest.approx(4.991e-3)
