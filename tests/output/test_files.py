"""Files for eyes: a report that stands alone, a file for ParaView read by another reader, measured points drawn."""

from html.parser import HTMLParser

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL

import lubfric
from lubfric.output import main
from lubfric.output.fields import grid_bytes, vtk_bytes

SCENE = (
    BODIES_AND_OIL
    + """[motion]
entrainment_speed = 0.01
speeds = [0.01, 0.3]
[surface]
sq = 1e-7
correlation_length = 4e-6
[contact]
shape = [48, 40]
spacing = [1.1e-6, 0.9e-6]
[numerics]
sampling = "patch"
"""
)


class Balanced(HTMLParser):
    """Fails where a tag is not closed."""

    def __init__(self):
        super().__init__()
        self.open, self.seen, self.text = [], [], []

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
    assert main(["run", str(folder / "s.toml"), "--out", str(folder / "out"), "--report", "--vtk"]) == 0
    return folder / "out"


def test_the_report_stands_alone_and_holds_the_numbers(run):
    page = Balanced()
    page.feed((run / "report.html").read_text(encoding="utf-8"))
    assert page.open == [] and not any("http" in str(value) for _, attrs in page.seen for value in attrs.values())
    images = [attrs["src"] for tag, attrs in page.seen if tag == "img"]
    assert len(images) == 2 and all(src.startswith("data:image/png;base64,iVBOR") for src in images)
    text = " ".join(page.text)
    f = lubfric.stribeck(lubfric.load_scene(run.parent / "s.toml"), fields=[0.01]).coefficient
    for words in (*(f"{value:.4g}" for value in f), "a < b & c", "0.36 Pa s", "2.31e+11 Pa", lubfric.__version__):
        assert words in text, words
    assert "(95 %)" in text and "How sure the numbers are" in text


def test_the_file_for_paraview_is_read_back_by_another_reader(run):
    meshio = pytest.importorskip("meshio")
    mesh = meshio.read(run / "contact_0.vtk")
    point = lubfric.stribeck(lubfric.load_scene(run.parent / "s.toml"), fields=[0.01]).points[0]
    grid = mesh.points.reshape(40, 48, 3)
    np.testing.assert_allclose(grid[:, :, 0], np.broadcast_to(point.x, (40, 48)))
    np.testing.assert_allclose(grid[:, :, 1], np.broadcast_to(point.y[:, None], (40, 48)))
    for name, values in (("contact_pressure", point.pressure), ("gap", point.gap)):
        np.testing.assert_array_equal(mesh.point_data[name].reshape(40, 48), values.T)
    film = mesh.point_data["film_thickness"].reshape(40, 48)
    np.testing.assert_array_equal(film[7], point.balance.film.film_at(point.x))
    assert np.std(mesh.point_data["height"]) == pytest.approx(1e-7) and mesh.point_data["film_pressure"].max() > 1e5


def test_what_a_point_has_not_is_refused():
    model = lubfric.prepare(lubfric.load_scene("paper"))
    with pytest.raises(lubfric.InputError, match="separated"):
        vtk_bytes(model, lubfric.friction(model, 1.0, fields=True))
    assert grid_bytes(np.arange(2.0), np.arange(3.0), {}, "t").startswith(b"# vtk DataFile Version 3.0\n")


def test_measured_points_are_drawn_among_the_curve(run, tmp_path, capsys, monkeypatch):
    (tmp_path / "m.csv").write_text("U [mm/s],mu\n10,0.08\n100,0.03\n")
    from matplotlib.axes import Axes

    drawn, real = [], Axes.errorbar

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


def test_the_command_takes_speeds_of_its_own_choice(tmp_path, capsys):
    (tmp_path / "s.toml").write_text(SCENE.replace("[0.01, 0.3]", "[0.001, 0.5]") + "tolerance = 0.1\n")
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(out), "--speeds", "auto"]) == 0
    rows = (out / "stribeck.csv").read_text().splitlines()[1:]
    speeds = [float(row.split(",")[0]) for row in rows]
    assert speeds == sorted(speeds) and 6 <= len(speeds) <= 12 and 0.01 in speeds
