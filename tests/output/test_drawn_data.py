"""What is written and drawn: every column with its unit, every field the right way round, every line and image by the
numbers that its artists hold."""

import csv
import io
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scene_text import paper_scene

import lubfric
from lubfric._base import field_image, new_figure
from lubfric.output.fields import fields_bytes, grid_bytes
from lubfric.output.pictures import plot_contact, plot_history, plot_stribeck, plot_traction
from lubfric.studies import csv_bytes, plot_map

UNITS = {  # of the columns of results, typed by hand
    **dict.fromkeys(
        ("contact_load", "film_load", "shear_force", "couette_force", "rolling_force", "boundary_force"), "N"
    ),
    **dict.fromkeys(("min_film", "central_film", "mean_gap"), "m"),
    **dict.fromkeys(("flash_temperature_rise", "film_temperature_rise"), "K"),
    **{"speed": "m/s", "real_contact_area": "m2", "seconds": "s", "line_length": "m"},
}
SCENE = paper_scene(
    contact={"shape": (48, 32), "spacing": (1.1e-6, 1.7e-6)},
    surface={"correlation_length": (4e-6, 6e-6), "acf": "gaussian"},
    numerics={"sampling": "patch"},
)


@pytest.fixture
def figures(monkeypatch):
    """The figures that are saved, in place of files."""
    saved = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: saved.append(figure))
    return saved


@pytest.fixture(scope="module")
def solved():
    prepared = lubfric.prepare(SCENE)
    return prepared, lubfric.friction(prepared, 0.01, fields=True)


def data(axes, label):
    (line,) = (line for line in axes.lines if line.get_label() == label)
    return np.array(line.get_data())


def edges(axes, label):
    """Lower and upper edge of a filled band at each x."""
    (band,) = (each for each in axes.collections if each.get_label() == label)
    corners = band.get_paths()[0].vertices
    places = np.unique(corners[:, 0])
    return np.array([(corners[corners[:, 0] == x, 1].min(), corners[corners[:, 0] == x, 1].max()) for x in places]).T


COLUMNS = {
    "speed": np.array([0.1, 0.01, np.nan, 1.0]),
    "coefficient": np.array([0.05, 0.09, np.nan, 0.02]),
    "contact_load": np.array([2.0, 4.0, np.nan, 0.0]),
    "film_load": np.array([3.0, 1.0, np.nan, 5.0]),
    "boundary_force": np.array([0.2, 0.4, np.nan, 0.0]),
    "shear_force": np.array([0.05, 0.05, np.nan, 0.1]),
    "film_to_roughness_ratio": np.array([1.0, 0.3, np.nan, 4.5]),
    "interval_low": np.array([0.04, 0.08, np.nan, 0.019]),
    "interval_high": np.array([0.06, 0.10, np.nan, 0.022]),
    "flash_temperature_rise": np.array([7.0, 3.0, np.nan, 21.0]),
    "film_temperature_rise": np.array([1.0, 0.5, np.nan, 30.0]),
}


def test_a_curve_is_drawn_by_its_table(figures):
    cautious = [(), (), (), (SimpleNamespace(severe=False, what="starved"),)]
    plot_stribeck("x.png", COLUMNS, "title", cautious)
    top, middle, bottom = figures[0].axes
    for label, expected in (
        ("friction coefficient", [0.09, 0.05, 0.02]),
        ("from the contact spots", [0.4 / 5, 0.2 / 5, 0.0]),
        ("from the film", [0.05 / 5, 0.05 / 5, 0.1 / 5]),
    ):
        np.testing.assert_allclose(data(top, label), [[0.01, 0.1, 1.0], expected], rtol=1e-12)
    np.testing.assert_allclose(
        edges(top, "95 %: solvers, grids, surface, model"), [[0.08, 0.04, 0.019], [0.1, 0.06, 0.022]]
    )
    np.testing.assert_allclose(data(top, "with cautions"), [[1.0], [0.02]])
    np.testing.assert_allclose(edges(middle, "contact $F_C$"), [[0, 0, 0], [0.8, 0.4, 0.0]], atol=1e-12)
    np.testing.assert_allclose(edges(middle, "film $F_H$"), [[0.8, 0.4, 0.0], [1, 1, 1]], atol=1e-12)
    np.testing.assert_allclose(bottom.lines[0].get_data(), [[0.01, 0.1, 1.0], [0.3, 1.0, 4.5]])
    assert "(m/s)" in bottom.get_xlabel() and "Sq (-)" in bottom.get_ylabel() and "(-)" in middle.get_ylabel()


def test_a_traction_curve_is_drawn_by_its_table(figures):
    columns = COLUMNS | {"ratio": COLUMNS["speed"]}
    plot_traction("x.png", columns, "title", [()] * 4)
    top, bottom = figures[0].axes
    np.testing.assert_allclose(data(top, "friction coefficient"), [[0.01, 0.1, 1.0], [0.09, 0.05, 0.02]])
    np.testing.assert_allclose(data(bottom, "surfaces (flash)"), [[0.01, 0.1, 1.0], [3.0, 7.0, 21.0]])
    np.testing.assert_allclose(data(bottom, "film above the surfaces"), [[0.01, 0.1, 1.0], [0.5, 1.0, 30.0]])
    assert "(K)" in bottom.get_ylabel() and "slide-roll ratio (-)" == bottom.get_xlabel()


def test_a_history_is_drawn_by_its_table(figures):
    t = np.array([0.0, 0.01, 0.02])
    columns = {"time": t, "entrainment_speed": np.array([0.1, -0.2, 0.3]), "load": np.array([5.0, 6.0, 8.0])}
    columns |= {"central_film": t + 1e-7, "min_film": t + 0.5e-7, "mean_gap": t + 2e-7, "sliding_speed": 0 * t + 0.2}
    columns |= {"contact_load": np.array([1.0, 3.0, 2.0]), "coefficient": np.array([0.03, 0.05, 0.04])}
    columns |= {"boundary_force": 0 * t + 0.1, "couette_force": 0 * t + 0.04, "rolling_force": 0 * t + 0.01}
    plot_history("x.png", columns, "title")
    first, second, third, fourth, load = figures[0].axes
    np.testing.assert_allclose(first.lines[0].get_data(), [[0, 10, 20], [0.1, -0.2, 0.3]])
    np.testing.assert_allclose(load.lines[0].get_data(), [[0, 10, 20], [5, 6, 8]])
    for label, least in (("central film", 100.0), ("minimum film", 50.0), ("mean gap over A", 200.0)):
        np.testing.assert_allclose(data(second, label), [[0, 10, 20], 1e9 * t + least])
    np.testing.assert_allclose(edges(third, "contact $F_C$")[1], [0.2, 0.5, 0.25])
    np.testing.assert_allclose(data(fourth, "from the film"), [[0, 10, 20], 0.05 / columns["load"]])
    assert "(nm)" in second.get_ylabel() and fourth.get_xlabel() == "time (ms)" and "(N)" in load.get_ylabel()


def test_a_map_is_seen_from_above_in_micrometres():
    x, y = 1e-6 * np.array([-2.0, 0.0, 2.0]), 1e-6 * np.array([0.0, 5.0])
    values = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    image = field_image(new_figure().subplots(), x, y, values, "viridis", "label")
    np.testing.assert_array_equal(image.get_array(), [[1, 3, 5], [2, 4, 6]])
    assert image.origin == "lower" and image.get_extent() == pytest.approx([-3.0, 3.0, -2.5, 7.5])
    assert "x (µm), along the motion" == image.axes.get_xlabel() and "y (µm)" in image.axes.get_ylabel()


def test_the_picture_of_a_contact_holds_its_fields(figures, solved):
    prepared, point = solved
    plot_contact("x.png", prepared, point)
    above, section = figures[0].axes[:2]
    (image,) = above.images
    np.testing.assert_allclose(image.get_array(), point.pressure.T / 1e9)
    row = int(np.argmax(point.pressure.max(axis=0)))
    dotted = [line.get_ydata()[0] for line in above.lines if line.get_linestyle() == ":"]
    assert dotted == pytest.approx([1.7 * row])
    half = 1e6 * np.sqrt(8 * 5.5 / 6e-3 * 2e-3 / (np.pi * 231e9))
    assert sorted(line.get_xdata()[0] for line in above.lines if line.get_linestyle() == "--") == pytest.approx(
        [-half, half]
    )
    x, film = data(section, "film thickness h")
    np.testing.assert_allclose(film, 1e9 * point.balance.film.film_at(x * 1e-6))
    _, surface = data(section, "surface z, undeformed")
    np.testing.assert_allclose(surface, 1e9 * (prepared.surface.heights[:, row] - prepared.surface.heights.mean()))
    _, under = data(section, "separation $h_s$ = h − ε")
    _, deformed = data(section, "surface, deformed")
    np.testing.assert_allclose(under - deformed, 1e9 * point.gap[:, row], atol=1e-6)
    assert "(nm)" in section.get_ylabel()


def test_fields_are_written_the_right_way_round(solved):
    prepared, point = solved
    with np.load(io.BytesIO(fields_bytes(prepared, [point]))) as kept:
        np.testing.assert_array_equal(kept["contact_pressure_0"], point.pressure)
        np.testing.assert_array_equal(kept["gap_0"], point.gap)
        assert kept["spacing"] == pytest.approx((1.1e-6, 1.7e-6)) and kept["speed"] == [0.01]
        np.testing.assert_array_equal(kept["film_pressure_0"], point.balance.film.pressure)
    x, y, values = np.array([0.0, 1.0, 2.0]), np.array([10.0, 20.0]), np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    text = grid_bytes(x, y, {"gap": values}, "t")
    head, _, rest = text.partition(b"double\n")
    assert b"DIMENSIONS 3 2 1" in head
    places = np.frombuffer(rest, ">f8", 18).reshape(6, 3)
    field = np.frombuffer(text.partition(b"LOOKUP_TABLE default\n")[2], ">f8", 6)
    assert {(*place[:2], value) for place, value in zip(places, field)} == {
        (x[i], y[j], values[i, j]) for i in range(3) for j in range(2)
    }


def test_the_table_of_a_curve_has_the_units_of_its_numbers():
    curve = lubfric.stribeck(SCENE.with_(surface={"sq": 0.0, "correlation_length": 8e-6}), [1.0, 2.0])
    heading, *rows = list(csv.reader(io.StringIO(csv_bytes(curve).decode())))
    units = dict(name.removesuffix("]").split(" [") for name in heading if "[" in name)
    assert units == {name: UNITS.get(name, "-") for name in units} and {*UNITS} <= {*units}
    for name in ("speed", "coefficient", "film_load", "couette_force", "rolling_force", "min_film", "central_film"):
        column = heading.index(f"{name} [{units[name]}]")
        assert [float(row[column]) for row in rows] == [getattr(point, name) for point in curve.points]


def test_a_study_over_two_keys_is_drawn_and_written_along_its_axes(figures, monkeypatch, tmp_path):
    smooth = SCENE.with_(surface={"sq": 0.0, "correlation_length": 8e-6})
    study = lubfric.study(smooth, {"lubricant.viscosity": [0.2, 0.4]}, [1.0, 2.0, 4.0])
    drawn, real = [], Axes.contourf
    monkeypatch.setattr(
        Axes, "contourf", lambda axes, *given, **options: drawn.append(given) or real(axes, *given, **options)
    )
    for across, up in (("speed", "lubricant.viscosity"), ("lubricant.viscosity", "speed")):
        plot_map(tmp_path / "x.png", study, across, up)
        assert figures[-1].axes[0].get_xlabel().endswith({"speed": "(m/s)"}.get(across, "(Pa s)"))
        assert figures[-1].axes[0].get_ylabel().endswith({"speed": "(m/s)"}.get(up, "(Pa s)"))
    f = np.array(
        [
            lubfric.stribeck(smooth.with_(lubricant={"viscosity": eta}), [1.0, 2.0, 4.0]).coefficient
            for eta in (0.2, 0.4)
        ]
    )
    for (x, y, values), expected in zip(drawn, (f, f.T)):
        np.testing.assert_array_equal(values, expected)
        assert (len(y), len(x)) == expected.shape
    study.to_csv(tmp_path / "study.csv")
    with (tmp_path / "study.csv").open() as file:
        rows = [
            [float(row[name]) for name in ("lubricant.viscosity [Pa s]", "speed [m/s]", "coefficient [-]")]
            for row in csv.DictReader(file)
        ]
    assert rows == [[eta, u, f[i, j]] for i, eta in enumerate((0.2, 0.4)) for j, u in enumerate((1.0, 2.0, 4.0))]
