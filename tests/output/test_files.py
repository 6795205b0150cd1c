"""Files for eyes: a report that stands alone, a file for ParaView read by another reader, measured points drawn."""

import json
import math
import re
import tempfile
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pictures import put_back
from scene_text import BODIES_AND_OIL, paper_scene

import lubfric
from lubfric.output import main

SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.01\nspeeds = [0.01, 0.3]\n"
SCENE += "[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\n[contact]\nshape = [48, 40]\nspacing = [1.1e-6, 0.9e-6]\n"
SCENE += "[numerics]\nsampling = 'patch'\nmodel = 'quick'\n"


class Balanced(HTMLParser):
    """Fails where a tag is not closed."""

    def __init__(self):
        super().__init__()
        self.open = []
        self.seen = []
        self.text = []

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    (folder / "s.toml").write_text(SCENE.replace("[bodies]", "name = 'a < b & c'\n[bodies]"))
    with pytest.MonkeyPatch.context() as patched:
        put_back(patched.setattr)
        assert main(["run", str(folder / "s.toml"), "--out", str(folder / "out"), "--vtk", "--report"]) == 0
    return folder / "out"


def test_the_report_stands_alone_and_holds_the_numbers(run):
    page = Balanced()
    page.feed((run / "report.html").read_text(encoding="utf-8"))
    assert page.open == [] and not any("http" in str(value) for _, attrs in page.seen for value in attrs.values())
    images = [attrs["src"] for tag, attrs in page.seen if tag == "img"]
    assert len(images) == 3 and all(src.startswith("data:image/png;base64,iVBOR") for src in images)
    text = " ".join(page.text)
    curve = lubfric.stribeck(lubfric.load_scene(run.parent / "s.toml"), fields=[0.01])
    rows = text.partition("Operating points")[2].partition("F_C/F_T")[2]
    for speed, f, point in zip(curve.speed, curve.coefficient, curve.points):
        shown = re.search(rf" {speed:.4g}\s+(?:\(operating point\)\s+)?(\S+)\s", rows)[1]
        low, high = point.uncertainty.interval  # f has as many digits as its error leaves, three if that is not known
        assert abs(float(shown) - f) <= (0.005 * f if np.isnan(high) else 0.05 * (high - low)), (speed, shown, f)
    for words in ("a < b & c", "360 mPa s", "231 GPa", lubfric.__version__):
        assert words in text, words
    assert "at 95 %" in text and "Uncertainty budget" in text


@pytest.mark.parametrize("speed, touches", [(0.001, True), (0.3, False)])
def test_the_page_says_what_a_smallest_film_of_1_nm_is(tmp_path, speed, touches):
    (tmp_path / "s.toml").write_text(SCENE)
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", str(speed), "--out", str(tmp_path / "o")]) == 0
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    assert ("A smallest film of 1 nm is the gap that the deterministic model assumes" in page) == touches


def test_the_page_states_lift_off_the_formula_and_what_is_omitted(tmp_path):
    (tmp_path / "s.toml").write_text(SCENE.replace("'quick'", "'paper'"))
    out = tmp_path / "o"
    scene = lubfric.load_scene(tmp_path / "s.toml")
    for speeds in (np.geomspace(0.01, 1.0, 9).tolist(), [0.01, 0.02, 0.03], [0.01, 0.3]):
        given = ",".join(map(str, speeds))
        assert main(["run", str(tmp_path / "s.toml"), "--speeds", given, "--out", str(out)]) == 0
        curve = lubfric.stribeck(scene, speeds)
        page = Balanced()
        page.feed((out / "report.html").read_text(encoding="utf-8"))
        text = " ".join(page.text)
        effects = re.sub(r"\s+", " ", text.partition("Effects not modelled")[2].partition("Inputs")[0]).lower()
        assert curve.points[0].unmodelled_effects
        for effect in curve.points[0].unmodelled_effects:
            changes = " to ".join(f"{100 * each:+.2g}" for each in effect.changes)
            change = "not estimated" if math.isnan(effect.change) else f"{changes} %"
            assert f"{effect.what}. {change} {effect.recommendation}".lower() in effects
        assert "Method and sources" in text and f"for {len(speeds)} speeds" in text
        assert ("lift-off speed is above the speeds solved" in text) == (len(speeds) == 3)
        assert (out / "law.json").exists() == (out / "law.c").exists() == (len(speeds) > 2)
        if len(speeds) == 2:
            assert "No formula was fitted: 2 speeds are solved" in text
            continue
        law = json.loads((out / "law.json").read_text())
        largest = law["largest"]
        assert f"deviates by {f'at most {100 * largest:.2g}' if largest > 1e-4 else 'less than 0.01'} %" in text
        names = vars(math) | law["numbers"] | {"T": math.nan, "p": law["ranges"]["pressure"][0]}
        for names["U"], f in zip(speeds, curve.coefficient):
            for name, expression in law["formula"].items():
                names[name] = eval(expression, {}, names)
            assert abs(names["f"] / f - 1) <= law["largest"] * 1.001 < 0.05
        assert f"f = {names['f']:.4g} at U = {speeds[-1]:.4g} m/s" in text
        shown = re.search(r"separates the surfaces, is (\S+) m/s \((\S+) to (\S+) m/s by the solved", text)
        assert (shown is not None) == (curve.lift_off is not None) == (len(speeds) == 9)
        if shown:
            low, high = curve.lift_off_range
            values = [float(value) for value in shown.groups()]
            np.testing.assert_allclose(values, [curve.lift_off, low, high], rtol=0, atol=0.05 * (high - low))


def test_the_file_for_paraview_is_read_back_by_another_reader(run):
    meshio = pytest.importorskip("meshio")
    mesh = meshio.read(run / "contact_0.vtk")
    point = lubfric.friction(lubfric.load_scene(run.parent / "s.toml"), 0.01, fields="fine")
    shape = (point.y.size, point.x.size)
    grid = mesh.points.reshape(*shape, 3)
    np.testing.assert_allclose(grid[:, :, 0], np.broadcast_to(point.x, shape))
    np.testing.assert_allclose(grid[:, :, 1], np.broadcast_to(point.y[:, None], shape))
    for name, values in (("pressure", point.pressure), ("gap", point.gap)):
        np.testing.assert_array_equal(mesh.point_data[name].reshape(shape), values.T)
    film = mesh.point_data["film_thickness"].reshape(shape)
    np.testing.assert_array_equal(film, point.fields.film.T)
    assert (
        np.std(mesh.point_data["height"]) == pytest.approx(1e-7, rel=0.05) and mesh.point_data["pressure"].max() > 1e5
    )


def test_measured_points_are_drawn_among_the_curve(run, tmp_path, capsys, monkeypatch):
    (tmp_path / "m.csv").write_text("U [mm/s],mu\n10,0.08\n100,0.03\n")
    from matplotlib.axes import Axes

    drawn = []
    real = Axes.errorbar

    def errorbar(self, x, y, *arguments, **options):
        drawn.append((np.array(x), np.array(y)))
        return real(self, x, y, *arguments, **options)

    monkeypatch.setattr(Axes, "errorbar", errorbar)
    command = ["plot", str(run), "--measured", str(tmp_path / "m.csv")]
    assert main([*command, "--speed", "U [mm/s]", "--coefficient", "mu"]) == 0
    ((x, y),) = drawn
    assert x.tolist() == [0.01, 0.1] and y.tolist() == [0.08, 0.03]
    assert main(command) == 2
    assert main([*command, "--speed", "V", "--coefficient", "mu"]) == 2
    assert "has no column 'V'; it has: U [mm/s], mu" in capsys.readouterr().err
    assert main([*command, "--ratio", "U [mm/s]", "--coefficient", "mu"]) == 2
    assert "--ratio is not for a Stribeck curve; give --speed" in capsys.readouterr().err


@pytest.mark.parametrize("ratios, x", [("0.1,0.4", [0.1, 0.2]), ("-0.2,0.2", [-0.1, 0.2])])
def test_measured_points_are_drawn_among_a_traction_curve(tmp_path, capsys, monkeypatch, draws, ratios, x):
    """By `lubfric run` and by `lubfric plot`: over the ratios as they are, or over their magnitudes if the curve has no
    negative ones. A line says which columns are read."""
    from matplotlib.axes import Axes

    points = []
    real = Axes.errorbar

    def errorbar(self, place, f, *arguments, **options):
        points.append((np.array(place).tolist(), np.array(f).tolist()))
        return real(self, place, f, *arguments, **options)

    monkeypatch.setattr(Axes, "errorbar", errorbar)
    draws("traction.png")
    motion = {"entrainment_speed": 1.0}
    scene = paper_scene(contact=SMALL, numerics={"sampling": "patch", "accept": True}, motion=motion)
    (tmp_path / "s.toml").write_text(scene.to_toml())
    (tmp_path / "m.csv").write_text("SRR [%],mu\n-10,0.08\n20,0.03\n")
    columns = ["--measured", str(tmp_path / "m.csv"), "--ratio", "SRR [%]", "--coefficient", "mu"]
    folder = str(tmp_path / "o")
    assert main(["run", str(tmp_path / "s.toml"), f"--ratios={ratios}", "--out", folder, *columns]) == 0
    assert main(["plot", folder, *columns]) == 0
    assert points == 2 * [(x, [0.08, 0.03])]
    error = " ".join(capsys.readouterr().err.split())
    assert error.count("the slide-roll ratio is its column 'SRR [%]', f its column 'mu'") == 2
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    for note in re.findall(r"note: (between .*? Solve more ratios between them, such as [0-9., ]+\d)", error):
        assert f"<li>B{note[1:]}.</li>" in page  # the ranges in which f is not known
    assert ("note: between" in error) == (min(x) > 0)
    assert "f is the force on surface 2 ([counterface]," in page and "contains no error of the inputs" in page
    wrong = ["plot", folder, "--measured", str(tmp_path / "m.csv"), "--speed", "SRR [%]", "--coefficient", "mu"]
    assert main(wrong) == 2
    assert "--speed is not for a traction curve; give --ratio" in " ".join(capsys.readouterr().err.split())


def test_speeds_without_an_interval_for_one_reason_are_in_one_line(tmp_path, capsys):
    """The range of f_b changes f differently at each speed; the reason, a patch with too few asperities, is one."""
    scene = SCENE.replace("speeds = [0.01, 0.3]", "speeds = [0.003, 0.01, 0.03]").replace("'quick'", "'paper'")
    scene = re.sub(r"boundary_friction_coefficient = [\d.]+", "boundary_friction_coefficient = [0.08, 0.1]", scene)
    (tmp_path / "s.toml").write_text(scene)
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")]) == 0
    error = " ".join(capsys.readouterr().err.split())
    assert error.count("no 95 % interval of f at 3 speeds") == 1 == error.count("no 95 % interval of f at")
    assert error.count("too few for an interval") == 1


ODD = ["$$", r"$\unknowncmd$", r"\$ a $x_", "100 % $5", "a\nb 😀 {x} <b>&"]
SMALL = {"shape": (96, 96), "spacing": 0.9e-6}
COLUMNS = "--speed", "U", "--coefficient", "mu"


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name != ODD[1])) for name in ODD])
def test_a_name_is_drawn_as_text(tmp_path, monkeypatch, name, draws):
    """Title, legend of a measured curve and file names: as they are, whatever matplotlib takes for a formula."""
    from matplotlib.figure import Figure

    titles = []
    real = Figure.savefig

    def savefig(self, *arguments, **options):
        texts = [*(axes.title for axes in self.axes), *filter(None, [self._suptitle])]
        legends = [text for axes in self.axes if axes.get_legend() for text in axes.get_legend().get_texts()]
        titles.extend(text._preprocess_math(text.get_text()) for text in (*texts, *legends))
        return real(self, *arguments, **options)

    monkeypatch.setattr(Figure, "savefig", savefig)
    draws("stribeck.png")
    motion = {"speeds": [0.3, 1.0], "entrainment_speed": 1.0}
    scene = paper_scene(contact=SMALL, numerics={"sampling": "patch", "accept": True}, motion=motion)
    (tmp_path / "s.toml").write_text(replace(scene, name=name).to_toml(), encoding="utf-8")
    assert lubfric.load_scene(tmp_path / "s.toml").name == name
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")]) == 0
    assert (f"{name}\nload-sharing model", False) in titles
    measured = tmp_path / (name.replace("\n", "").replace("/", "") + ".csv")
    measured.write_text("U [m/s],mu\n0.3,0.05\n1,0.08\n")
    assert main(["plot", str(tmp_path / "o"), "--measured", str(measured), *COLUMNS]) == 0
    assert (measured.stem, False) in titles


@pytest.mark.slow
def test_a_history_and_a_traction_curve_have_any_name(tmp_path, drawn):
    motion = {"entrainment_speed": 1.0}
    scene = paper_scene(contact=SMALL, numerics={"sampling": "patch", "accept": True}, motion=motion)
    scene = replace(scene, name="$$")
    (tmp_path / "s.toml").write_text(scene.to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--ratios", "0.5,1", "--out", str(tmp_path / "o")]) == 0
    (tmp_path / "s.toml").write_text(scene.to_toml() + "[transient]\nduration = 1e-4\noutputs = 2\n")
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o"), "--animation"]) == 0
    assert main(["plot", str(tmp_path / "o")]) == 0


def test_a_picture_that_fails_costs_nothing_else(tmp_path, monkeypatch, capsys, draws):
    """Whatever the failure, table, fields and record of the new run are there, and it is said."""
    draws("stribeck.png")
    (tmp_path / "s.toml").write_text(SCENE)
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out)]) == 0
    (tmp_path / "s.toml").write_text(SCENE.replace("0.36", "0.3"))

    def broken(*_, **__):
        raise ZeroDivisionError("no picture")

    with monkeypatch.context() as patched:
        patched.setattr("lubfric.output.curve_picture.plot_stribeck", broken)
        assert main(["run", str(tmp_path / "s.toml"), "--out", str(out)]) == 2
    said = capsys.readouterr().err.splitlines()[-1]
    assert said.startswith("lubfric: stribeck.png was not drawn (ZeroDivisionError") and "all else is in" in said
    record = json.loads((out / "result.json").read_text())
    assert record["scene"]["lubricant"]["viscosity"] == 0.3 and record["points"][0]["coefficient"] > 0
    assert not (out / "stribeck.png").exists() and (out / "report.html").is_file()  # none of another run
    assert (out / "unfinished").is_dir() and main(["run", str(tmp_path / "s.toml"), "--out", str(out)]) == 0
    again = json.loads((out / "result.json").read_text())  # what was solved is drawn, and not solved again
    assert again["points"] == record["points"] and (out / "stribeck.png").exists()
    assert not (out / "unfinished").exists()


def test_a_page_that_cannot_be_made_costs_no_numbers(tmp_path, monkeypatch, capsys):
    """They are written, the page of an earlier run does not stay beside them, and the end says what is missing."""
    (tmp_path / "s.toml").write_text(SCENE)
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out)]) == 0
    table = (out / "stribeck.csv").read_text()

    def broken(*_, **__):
        raise ZeroDivisionError("no page")

    monkeypatch.setattr("lubfric.output.commands.report_page", broken)
    capsys.readouterr()
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out)]) == 2
    assert "report.html was not written (ZeroDivisionError: 'no page')" in capsys.readouterr().err
    rows = [line.split(",")[:2] for line in (out / "stribeck.csv").read_text().splitlines()]
    assert rows == [line.split(",")[:2] for line in table.splitlines()]
    assert "report.html" not in json.loads((out / "result.json").read_text())["files"]
    assert not (out / "report.html").exists()


@pytest.mark.parametrize("options, table", [([], "stribeck"), (["--ratios", "0.5,2"], "traction")])
def test_a_run_without_an_answer_says_that_there_is_nothing_to_draw(tmp_path, capsys, options, table):
    heavy = SCENE.replace("load = 5.5", "load = 2000.0").replace("spacing = [1.1e-6, 0.9e-6]", "spacing = [4e-6, 4e-6]")
    heavy = heavy.replace("4e-6\n[contact]", "16e-6\n[contact]").replace("'quick'", "'paper'")
    (tmp_path / "s.toml").write_text(heavy)
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out), *options]) == 1
    points = json.loads((out / "result.json").read_text())["points"]
    assert all("error" in point for point in points) and not (out / f"{table}.png").exists()
    capsys.readouterr()
    assert main(["plot", str(out)]) == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said.startswith("lubfric: nothing to draw: none of the 2 points") and points[0]["error"] in said


def test_a_contact_at_rest_alone_has_no_curve_to_draw(tmp_path, capsys):
    """And a smooth one, which is lifted off at once, has no touching surfaces in motion."""
    (tmp_path / "s.toml").write_text(SCENE)
    (tmp_path / "smooth.toml").write_text(SCENE.replace("sq = 1e-7", "sq = 0.0"))
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out), "--speeds", "0", "--fields", "0"]) == 0
    assert not (out / "stribeck.png").exists()
    assert main(["plot", str(out)]) == 2 and "nothing to draw" in capsys.readouterr().err
    assert main(["run", str(tmp_path / "smooth.toml"), "--out", str(out), "--speeds", "0,0.5,1,2"]) == 0
    assert "The lift-off speed is below the speeds solved" in (out / "report.html").read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore:Glyph")
@given(st.text())
@settings(max_examples=20)
def test_a_scene_reads_back_whatever_its_name(name):
    scene = lubfric.load_scene("flat")
    if any("\ud800" <= mark <= "\udfff" for mark in name):
        with pytest.raises(lubfric.InputError, match="name"):
            replace(scene, name=name)
        return
    text = replace(scene, name=name).to_toml()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "s.toml"
        path.write_bytes(text.encode())
        assert lubfric.load_scene(path) == replace(scene, name=name)
