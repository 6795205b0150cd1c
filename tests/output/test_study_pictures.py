"""study.png and the pictures of curves in a journal's column and across a page: no text is cut or meets another, none
is smaller than 6 pt, and lines tell apart what is varied."""

import itertools
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.text import Text
from scene_text import paper_scene
from small_study import made_study

import lubfric
from lubfric.output import curve_picture, pictures, study_pictures
from lubfric.output.picture_options import PictureOptions
from lubfric.studies import main_effects

SCENE = paper_scene(numerics={"sampling": "patch", "model": "paper"}).with_(
    name="cam follower of a diesel engine, line A",
    lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70.0},
)
GEAR = {
    "position [mm]": [-3, -2, -1, 0, 1, 2, 3],
    "load [N]": [3, 4, 5, 5, 5, 4, 3],
    "u1 [m/s]": [0.5, 0.45, 0.4, 0.35, 0.3, 0.25, 0.2],
    "u2 [m/s]": [0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5],
}
LOADS = [2.0, 3.0, 4.0, 5.0, 6.0]
SQ = [5e-8, 1e-7, 2e-7]
RANDOM = np.random.default_rng(1)
FOUR = ("bodies.load", "surface.sq", "lubricant.temperature", "bodies.boundary_friction_coefficient")
SAMPLE = [tuple(row) for row in RANDOM.uniform([2, 5e-8, 313, 0.08], [6, 4e-7, 373, 0.15], (200, 4)).tolist()]
STUDIES = {
    "one key": ({"bodies.load": LOADS}, [0.1]),
    "two keys": ({"bodies.load": LOADS, "surface.sq": SQ}, [0.1]),
    "three keys": ({"bodies.load": LOADS, "surface.sq": SQ, "lubricant.temperature_celsius": [40, 70, 100]}, [0.1]),
    "four keys": (
        {"bodies.load": LOADS, "surface.sq": SQ, "lubricant.temperature": [313.0, 373.0], FOUR[-1]: [0.1, 0.12]},
        [0.1],
    ),
    "five keys": (
        {
            "bodies.load": LOADS,
            "surface.sq": SQ,
            "lubricant.temperature": [313.0, 343.0, 373.0],
            FOUR[-1]: [0.1, 0.12, 0.14],
        },
        [0.1, 0.3],
    ),
    "five keys of one speed": (
        {
            "bodies.load": LOADS,
            "surface.sq": SQ,
            "lubricant.temperature": [313.0, 343.0, 373.0],
            FOUR[-1]: [0.1, 0.12, 0.14],
        },
        [0.1],
    ),
    "sections": (
        {"surface": [{"sq": sq, "correlation_length": 8e-6, "acf": "gaussian"} for sq in SQ], "bodies.load": LOADS},
        [0.1],
    ),
    "seeds": ({"surface.seed": [1, 2, 3], "bodies.load": LOADS[:2]}, [0.1]),
    "many values": (
        {"bodies.load": np.linspace(2, 6, 9).tolist(), "surface.sq": np.linspace(5e-8, 2e-7, 9).tolist()},
        [0.1],
    ),
    "close values": ({"bodies.load": [3.0, 3.001, 3.002, 6.0], "surface.sq": SQ}, [0.1]),
    "speeds": ({"bodies.load": LOADS, "surface.sq": SQ}, [0.03, 0.1, 0.3, 1.0]),
    "one key over speeds": ({"surface.sq": SQ}, [0.03, 0.1, 0.3, 1.0]),
    "200 random points": ({FOUR: SAMPLE}, [0.1]),
    "four keys over two speeds": (
        {
            "lubricant.grade": ["ISO VG 32", "ISO VG 68", "ISO VG 150", "ISO VG 320"],
            "surface.sq": [5e-8, 1e-7, 2e-7, 4e-7],
            "bodies.load": LOADS[:3],
            "lubricant.temperature_celsius": [40, 80],
        },
        [0.1, 1.0],
    ),
    "four keys over many speeds": (
        {
            "lubricant.grade": ["ISO VG 32", "ISO VG 68", "ISO VG 150", "ISO VG 320"],
            "surface.sq": [5e-8, 1e-7, 2e-7, 4e-7],
            "bodies.load": LOADS,
            "lubricant.temperature_celsius": [40, 80],
        },
        [0.01, 0.03, 0.1, 0.3, 1.0],
    ),
    "random scenes over two speeds": ({FOUR: SAMPLE[:100]}, [0.1, 1.0]),
    "random scenes over many speeds": ({FOUR: SAMPLE[:60]}, [0.01, 0.03, 0.1, 0.3, 1.0]),
    "random points with speeds": ({}, {**dict(zip(FOUR, zip(*SAMPLE[:60]))), "speed [m/s]": np.linspace(0.1, 2.0, 60)}),
    "random curves": ({FOUR: SAMPLE[:16]}, [0.03, 0.1, 0.3]),
    "materials": ({"bodies.material": ["100Cr6", "42CrMo4", "silicon nitride"], "bodies.load": LOADS}, [0.1]),
    "names alone": (
        {"bodies.material": ["100Cr6", "silicon nitride"], "lubricant.grade": ["ISO VG 32", "ISO VG 68"]},
        [0.1],
    ),
    "names together": (
        {
            ("bodies.material", "bodies.load"): [
                ("100Cr6", 3.0),
                ("42CrMo4", 3.5),
                ("silicon nitride", 4.0),
                ("steel", 5.0),
            ]
        },
        [0.1],
    ),
    "gear": ({}, GEAR),
    "gear and names": ({"lubricant.grade": ["ISO VG 32", "ISO VG 68", "ISO VG 150"]}, GEAR),
}
WIDTHS = {"column": 0.085, "page": 0.17, "usual": None}  # m; the usual one is 5 % wider than a page
TALL = ("five keys", "four keys over many speeds", "gear")  # of the pictures at the usual width, a kind each
WIDE = (*TALL, "two keys", "200 random points", "random points with speeds", "gear and names")  # those across a page
LEAST_LETTERS = 6.0  # pt
TEMPERATURE = {"three keys": "lubricant.temperature_celsius"}
PRINTED = 300  # points per inch, in which letters have the widths of print
COLUMN_HEIGHT = 7.0  # inch: a picture of this height leaves room for its caption on a page


@cache
def made(name):
    """The study of `STUDIES`, which no picture changes."""
    return made_study_over(*STUDIES[name])


def made_study_over(vary, speeds):
    """A study with made-up numbers: nothing is solved."""
    along = {"points": speeds} if isinstance(speeds, dict) else {"speeds": speeds}
    plan = lubfric.plan_study(SCENE, vary, **along)
    f = np.linspace(0.03, 0.12, int(np.prod(plan.shape))).reshape(plan.shape)
    columns = {"coefficient": f, "interval_low": 0.8 * f, "interval_high": 1.3 * f}
    columns |= {"power_loss": 10 * f, "power_loss_low": 8 * f, "power_loss_high": 13 * f}
    errors = ("numerical", "sampling", "model", "input", "not_given")
    columns |= {f"{name}_error": 0.0 * f for name in errors} | {"sampling_freedom": 0.0 * f + 4.0}
    return made_study(plan, columns)


@pytest.fixture
def drawn(monkeypatch):
    """The figures that are written; none of them is."""
    kept: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda self, *_, **__: kept.append(self))
    return kept


def texts_of(figure):
    """The texts that a drawn ``figure`` shows, with their boxes [pixel]; two names of tick labels that are on one place
    are one."""
    figure.set_dpi(PRINTED)
    figure.draw_without_rendering()
    hidden = {id(text) for axes in figure.axes if not axes.get_visible() for text in axes.findobj(Text)}
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            room = 1e-9 * (high - low)
            hidden |= {
                id(label)
                for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())
                if not low - room <= tick.get_loc() <= high + room
                for label in (tick.label1, tick.label2)
            }
    shown = [
        text
        for text in figure.findobj(Text)
        if text.get_visible() and text.get_text().strip() and id(text) not in hidden
    ]
    return [(text, text.get_window_extent()) for text in shown if text.get_window_extent().width > 0]


def faults(figure):
    """What a referee would not accept of the texts of a ``figure``."""
    shown = texts_of(figure)
    whole = figure.bbox
    found = [f"small: {text.get_text()}" for text, _ in shown if text.get_fontsize() < LEAST_LETTERS - 1e-9]
    for text, box in shown:
        if box.x0 < whole.x0 or box.x1 > whole.x1 or box.y0 < whole.y0 or box.y1 > whole.y1:
            found.append(f"cut: {text.get_text()}")
    for (text, box), (other, beside) in itertools.combinations(shown, 2):
        wide = min(box.x1, beside.x1) - max(box.x0, beside.x0)
        high = min(box.y1, beside.y1) - max(box.y0, beside.y0)
        if wide > 0.5 and high > 0.5:
            found.append(f"overlap: {text.get_text()!r} and {other.get_text()!r}")
    return found


@pytest.mark.parametrize(
    "name, width",
    [
        pytest.param(name, width, marks=[pytest.mark.slow] * (width == "page" and name not in WIDE))
        for name in STUDIES
        for width in WIDTHS
        if width != "usual" or name in TALL
    ],
)
def test_texts_of_a_study_are_complete_and_apart(tmp_path, drawn, name, width):
    options = PictureOptions(width=WIDTHS[width])
    study_pictures.plot_study(tmp_path / "study.png", made(name), options)
    (figure,) = drawn
    assert faults(figure) == []
    panels = [axes for axes in figure.axes if axes.get_visible()]
    for axes in panels:
        legend = axes.get_legend()
        assert legend is None or legend.get_window_extent().y0 >= axes.bbox.y1 - 1  # outside the data
    right = max(axes.get_tightbbox().x1 for axes in panels)
    assert right > 0.93 * figure.bbox.width  # no blank beside them
    assert min(axes.bbox.height for axes in panels) > 1.2 * figure.dpi
    assert figure.get_figheight() <= 9.0


def test_two_keys_are_lines_over_one_with_a_colour_for_each_value_of_the_other(tmp_path, drawn):
    result = made_study_over(*STUDIES["two keys"])
    study_pictures.plot_study(tmp_path / "study.png", result)
    (axes,) = drawn[0].axes
    handles = dict(zip(*reversed(axes.get_legend_handles_labels())))
    names = [f"Sq = {sq}" for sq in ("50 nm", "100 nm", "200 nm")]
    assert [name for name in handles if "Sq" in name] == names
    assert len({to_hex(handles[name].get_color()) for name in names}) == 3
    for place, name in enumerate(names):
        line = handles[name]
        np.testing.assert_array_equal(line.get_xdata(), LOADS)
        np.testing.assert_array_equal(line.get_ydata(), result["coefficient"][:, place, 0])
    assert axes.get_xlabel() == "total load (N)"
    assert [tick.get_text() for tick in axes.get_xticklabels()] == ["2", "3", "4", "5", "6"]


@pytest.mark.parametrize("name, count", [("three keys", 9), ("four keys", 12)])
def test_keys_are_told_apart_by_colours_and_markers(tmp_path, drawn, name, count):
    """The line of each combination is that of its numbers, and the key of lines names its temperature."""
    result = made_study_over(*STUDIES[name])
    study_pictures.plot_study(tmp_path / "study.png", result)
    (axes,) = drawn[0].axes
    lines = [line for line in axes.lines if len(line.get_xdata()) == len(LOADS) and line.get_marker() != "None"]
    assert len({(to_hex(line.get_color()), line.get_marker()) for line in lines}) == len(lines) == count
    f = result["coefficient"][..., 0]
    assert [line.get_ydata().tolist() for line in lines] == f.reshape(len(LOADS), -1).T.tolist()
    handles = dict(zip(*reversed(axes.get_legend_handles_labels())))
    warmest = max(result.coords[TEMPERATURE.get(name, "lubricant.temperature")][1])
    shown = f"temperature of the oil {warmest - (273.15 if warmest > 200 else 0):.4g} °C"
    (of_warmest, *_) = [handle for label, handle in handles.items() if shown in label]
    places = np.unravel_index([line.get_marker() for line in lines].index(of_warmest.get_marker()), f.shape[1:])
    assert result.place((0, *map(int, places), 0)).count(shown) == 1


@pytest.mark.parametrize("name, has_bands", [("one key over speeds", True), ("speeds", False)])
def test_the_interval_of_lines_without_bands_is_stated(tmp_path, drawn, name, has_bands):
    """The axis ends above f where no band is drawn: the made-up intervals are 30 % higher."""
    result = made(name)
    study_pictures.plot_study(tmp_path / "study.png", result)
    (axes,) = drawn[0].axes
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    stated = [text for text in names if text.startswith("95 % interval of a point (median): -20 %, +30 %")]
    assert len(stated) == (not has_bands)
    top = axes.get_ylim()[1] / result["coefficient"].max()
    assert top == pytest.approx(1.05 * (1.3 if has_bands else 1.0))


def test_names_of_an_axis_are_those_of_the_study(tmp_path, drawn):
    study_pictures.plot_study(tmp_path / "study.png", made_study_over(*STUDIES["names alone"]))
    (axes,) = drawn[0].axes
    assert [tick.get_text() for tick in axes.get_xticklabels()] == ["100Cr6", "silicon nitride"]
    assert axes.get_xlabel() == "material (marks side by side)"


RATIO = np.geomspace(1e-3, 1.0, 5)
CURVE = dict.fromkeys(("full_load_film", "central_film"), np.full(5, 2.5e-7)) | {
    "ratio": RATIO,
    "speed": np.full(5, 0.3),
    "coefficient": 0.1 * RATIO**0.2,
    "contact_load": np.full(5, 4.0),
    "film_load": np.full(5, 1.5),
    "boundary_force": np.full(5, 0.3),
    "shear_force": np.full(5, 0.1),
    "film_to_roughness_ratio": np.full(5, 1.2),
    "flash_temperature_rise": 12 * RATIO,
    "film_temperature_rise": 30 * RATIO,
    "interval_low": 0.08 * RATIO**0.2,
    "interval_high": 0.13 * RATIO**0.2,
    "model_error": np.full(5, 0.1),
    "sampling_error": np.full(5, 0.05),
    "sampling_freedom": np.full(5, 9.0),
}
STARVED = {"what": "flooded inlet", "value": 1.0, "limit": 2.0, "unit": "-", "consequence": "", "recommendation": ""}


@pytest.mark.parametrize("width", WIDTHS.values(), ids=WIDTHS)
@pytest.mark.parametrize("over", ["ratio", "speed"])
def test_a_curve_fits_a_column_and_a_page(tmp_path, drawn, width, over):
    """With all panels, a warning, a long name and a basis in several lines."""
    columns = CURVE | {"speed": 0.1 + RATIO} if over == "speed" else CURVE
    columns = {name: column for name, column in columns.items() if name != "ratio" or over == "ratio"}
    title = "\n".join(
        [SCENE.name, *(f"{basis} on 295 solved cases (3 of 5 points)" for basis in ("long cells", "model"))]
    )
    points = [{"validity": [STARVED] if i == 2 else []} for i in range(5)]
    curve_picture.draw_curve(tmp_path / "x.png", columns, title, points, options=PictureOptions(width=width))
    (figure,) = drawn
    assert faults(figure) == []
    assert figure.get_figheight() <= (COLUMN_HEIGHT if width == WIDTHS["column"] else 8.0)
    assert min(axes.bbox.height for axes in figure.axes) > 0.6 * figure.dpi
    assert len(figure.get_suptitle().splitlines()) <= (2 if width == WIDTHS["column"] else 4)


@pytest.mark.parametrize("width", WIDTHS.values(), ids=WIDTHS)
def test_a_run_in_time_fits_a_column_and_a_page(tmp_path, drawn, width):
    t = np.linspace(0.0, 0.02, 9)
    columns = dict.fromkeys(("full_load_film", "central_film", "min_film", "mean_gap"), 1e-7 * (1 + t))
    columns |= dict.fromkeys(("boundary_force", "couette_force", "rolling_force", "contact_load"), 0.1 + t)
    columns |= {"time": t, "entrainment_speed": 0.1 + t, "sliding_speed": 0.2 + t, "load": 5.0 + t}
    columns |= {"coefficient": 0.1 + t, "interval_low": 0.08 + t, "interval_high": 0.13 + t, "power_loss": 0.01 + t}
    columns |= {"power_loss_low": 0.008 + t, "power_loss_high": 0.013 + t}
    pictures.plot_history(tmp_path / "x.png", columns, SCENE.name, options=PictureOptions(width=width))
    (figure,) = drawn
    assert faults(figure) == []
    assert figure.get_figheight() <= (COLUMN_HEIGHT if width == WIDTHS["column"] else 8.5)


def test_where_lines_meet_the_effect_of_each_input_is_drawn(tmp_path, drawn):
    """For each speed the mean over all other inputs, between the smallest and the largest f; the largest part of the
    variance first."""
    vary, speeds = STUDIES["four keys over two speeds"]
    result = made_study_over(vary, speeds)
    f = 0.01 * np.indices(f_shape := result.status.shape)[0] + 0.002 * np.indices(f_shape)[1] + 0.05
    f = f * (1 + 0.1 * np.indices(f_shape)[4])
    study_pictures.plot_study(tmp_path / "study.png", replace(result, columns=result.columns | {"coefficient": f}))
    panels = drawn[0].axes
    assert [axes.get_xlabel() for axes in panels][0] == "grade" and len(panels) == len(vary)
    names = [text.get_text() for text in drawn[0].legends[0].get_texts()]
    assert names[:2] == ["entrainment speed 0.1 m/s", "entrainment speed 1 m/s"]
    for axes, along in zip(panels[:2], (result.dims.index("lubricant.grade"), result.dims.index("surface.sq"))):
        means = [line.get_ydata() for line in axes.lines if line.get_marker() == "o" and len(line.get_xdata()) > 1]
        others = tuple(axis for axis in range(4) if axis != along)
        np.testing.assert_allclose(means, f.mean(axis=others).T)
        ends = [segment[:, 1] for segment in axes.collections[0].get_segments()]
        np.testing.assert_allclose(ends, np.transpose([f.min(axis=others)[:, 0], f.max(axis=others)[:, 0]]))
    assert all(" ".join(axes.get_title().split()).endswith("% of the variance of ln f") for axes in panels[:2])
    assert "range of the points" in names and drawn[0].get_suptitle() == f"{SCENE.name} (model: paper)"
    low = np.where(np.arange(f.size) < 9, 0.8 * f.ravel(), np.nan).reshape(f.shape)
    some = {"coefficient": f, "interval_low": low, "interval_high": low + 0.5 * f}
    options = PictureOptions(width=WIDTHS["column"])
    study_pictures.plot_study(tmp_path / "study.png", replace(result, columns=result.columns | some), options)
    (shown, why) = drawn[1].legends[0].get_title().get_text().splitlines()
    assert shown == f"95 % interval of a point (median; known at 9 of {f.size}): -20 %, +30 %"
    assert why == "at each value the colours are side by side"
    assert faults(drawn[1]) == []


def test_a_sample_at_several_speeds_has_the_effects_of_one_at_one_speed():
    """The values of a sample repeat at each speed alone: the means there hold what the other inputs do."""
    alone, twice = (made_study_over({FOUR: SAMPLE}, speeds) for speeds in ([0.1], [0.1, 1.0]))
    load, sq, *_ = np.transpose(SAMPLE)
    f = (load * sq**2)[:, None] * np.ones(2)
    (one, two) = (
        main_effects(replace(study, columns=study.columns | {"coefficient": f[:, : study.status.shape[1]]}))
        for study in (alone, twice)
    )
    assert one.keys() == two.keys() - {"speed"}
    assert all(two[key].share == pytest.approx(one[key].share, abs=1e-9) for key in one)


@pytest.mark.parametrize("count, is_told_apart", [(6, True), (7, False)])
def test_lines_of_a_sample_are_drawn_while_each_has_a_name(tmp_path, drawn, count, is_told_apart):
    study_pictures.plot_study(tmp_path / "study.png", made_study_over({FOUR: SAMPLE[:count]}, [0.03, 0.1, 0.3]))
    assert (len(drawn[0].axes) == 1) == is_told_apart
