"""Titles and labels of the pictures of a run lie inside the picture."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread

import lubfric
from lubfric.estimate import FrictionResult
from lubfric.output import curve_answer, curve_picture
from lubfric.output.pictures import plot_surface

PAPER = lubfric.load_scene("paper")
NARROW = {"shape": (40, 400), "spacing": 1e-6}
WIDE = {"shape": (500, 300), "spacing": 1e-6}


def cut_texts(figure: Figure) -> list[str]:
    """The texts of ``figure`` that reach out of it."""
    figure.canvas.draw()
    whole = figure.bbox
    cut = []
    for axes in figure.axes:
        for text in (axes.title, axes.xaxis.label, axes.yaxis.label):
            box = text.get_window_extent()
            if text.get_text() and not (whole.x0 <= box.x0 and box.x1 <= whole.x1 and box.y1 <= whole.y1):
                cut.append(text.get_text())
    return cut


@pytest.mark.parametrize("shape", [NARROW, WIDE], ids=["narrow", "wide"])
def test_titles_of_the_surface_are_complete(tmp_path, monkeypatch, shape):
    figures: list[Figure] = []
    save = Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda self, *a, **k: figures.append(self) or save(self, *a, **k))
    scene = PAPER.with_(contact=shape, surface={"sq": 433.6e-9}, numerics={"sampling": "patch"})
    plot_surface(tmp_path / "surface.png", lubfric.prepare(scene))
    assert [cut_texts(figure) for figure in figures] == [[]]


@pytest.mark.parametrize("shape, lines", [((256, 128), 3), ((200, 150), 3), ((256, 100), 1)])
def test_no_empty_band_is_above_a_wide_map(tmp_path, shape, lines):
    """White rows above it in the picture, in lines of text: beside a bearing curve, whose title has two, and above
    one."""
    scene = PAPER.with_(contact={"shape": shape, "spacing": 1e-6}, numerics={"sampling": "patch"})
    plot_surface(tmp_path / "surface.png", lubfric.prepare(scene))
    pixels = imread(tmp_path / "surface.png")[:, :, :3]
    above = pixels[:, : pixels.shape[1] // 2 - 100].min(axis=(1, 2))
    assert np.argmax(above < 0.5) < lines * 25


@pytest.mark.parametrize(
    "shape, drawn, title",
    [((400, 40), (159, 40), "159 of 400 µm of the map along x"), ((400, 120), (400, 120), "Sq")]
    + [((400, 16), (400, 16), "Sq"), ((40, 400), (40, 79), "79 of 400 µm of the map")],
)
def test_a_part_of_a_long_map_is_drawn_to_scale(tmp_path, monkeypatch, shape, drawn, title):
    """Four times as long along the motion as along the line, at most; a map of few lines is drawn whole."""
    figures: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda self, *a, **k: figures.append(self))
    surface = {"correlation_length": 3e-6}
    scene = PAPER.with_(contact={"shape": shape, "spacing": 1e-6}, surface=surface, numerics={"sampling": "patch"})
    plot_surface(tmp_path / "surface.png", lubfric.prepare(scene))
    above = figures[0].axes[0]
    assert above.images[0].get_array().shape == drawn[::-1]
    assert above.get_title().splitlines()[-1].startswith(title)
    assert (above.get_aspect() == 1) == ("to scale" not in above.get_ylabel()) == (shape[1] != 16)


def test_the_title_of_a_contact_lies_in_a_figure_of_one_column():
    x = np.linspace(-50e-6, 50e-6, 8)
    numbers = {"speed": 0.0123456, "contact_load": 381.0, "film_load": 419.0}
    fields = SimpleNamespace(x=x, y=x, pressure=np.ones((8, 8)), half_width=30e-6, pressure_label="contact pressure")
    point = SimpleNamespace(_fields_with=lambda name: fields, **numbers)
    figure = Figure(figsize=(85 / 25.4, 70 / 25.4))
    axes = FrictionResult.plot_contact(point, figure.subplots())
    assert axes.title.get_text() not in cut_texts(figure) and "0.476" in axes.title.get_text()


def test_a_curve_by_two_models_says_which_points_are_by_which(monkeypatch):
    """Of a picture in its title, of a report in a sentence."""
    names = {"long cells": [0.0, 0.5], "load-sharing model": [0.1, 0.2, 0.3]}
    ratios = sorted((ratio, basis) for basis, values in names.items() for ratio in values)
    title = curve_picture.title_of_curve("rig", [{"basis": basis} for _, basis in ratios])
    assert title.splitlines() == ["rig", "load-sharing model (3 of 5 points)", "long cells (2 of 5 points)"]
    others = [{"basis": "", "model": "deterministic"}] * 4
    both = curve_picture.title_of_curve("rig", [*others, {"basis": "long cells", "model": "quick"}])
    assert both.splitlines() == ["rig", "deterministic model (4 of 5 points)", "long cells (1 of 5 points)"]
    titles: list[str] = []
    monkeypatch.setattr(curve_picture, "plot_traction", lambda path, columns, title, *_, **__: titles.append(title))
    columns = {name: np.ones(5) for name in ("ratio", "speed", "coefficient")}
    curve_picture.draw_curve(SimpleNamespace(), columns, title, [])
    assert titles[0].splitlines() == ["rig, U = 1 m/s", *title.splitlines()[1:]]
    points = [SimpleNamespace(decision=SimpleNamespace(basis=basis, model="quick")) for _, basis in ratios]
    curve = SimpleNamespace(
        SWEPT=("ratio", "S", "", "slide-roll ratios"), ratio=np.array([ratio for ratio, _ in ratios]), points=points
    )
    (sentence,) = curve_answer.change_of_model(curve)
    assert "at 2 slide-roll ratios, 0 and 0.5 by the long cells" in sentence
    assert "at 3 slide-roll ratios, 0.1 to 0.3 by the load-sharing model" in sentence and "jump" in sentence
    curve.points = points[1:4]
    curve.ratio = curve.ratio[1:4]
    assert curve_answer.change_of_model(curve) == []
