"""Results for eyes: one line each, tables, axes that hold the numbers; scenes as dicts and as text."""

import json
import tomllib
from dataclasses import MISSING, fields, replace
from html import unescape

import numpy as np
import pytest
from matplotlib.figure import Figure
from small_study import SCENE

import lubfric
from lubfric._base import figures
from lubfric.output import main
from lubfric.quantities import NUMBERS
from lubfric.scene import Harmonic, Ramp, Table, builtin_scenes
from lubfric.studies import columns_of_curve, draw_curve
from lubfric.time import friction_over_time

MODEL = lubfric.prepare(SCENE)
HISTORY = lubfric.Transient(0.01, outputs=20, speed=Harmonic(mean=0.05, amplitude=0.04, frequency=100.0))


@pytest.fixture(scope="module")
def point():
    return lubfric.friction(MODEL, 0.01, fields=True)


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(MODEL, [0.003, 0.03, 0.3])


@pytest.fixture(scope="module")
def history():
    return lubfric.transient(replace(MODEL, scene=replace(SCENE, transient=HISTORY)))


EHL = {"load_per_width": 5e3, "radius": 2e-3, "e_prime": 231e9, "entrainment_speed": 0.1}
EHL |= {"viscosity": 0.1, "pressure_viscosity_coefficient": 2e-8}


def axes():
    return Figure().add_subplot()


def lines(ax):
    return {line.get_label(): line.get_xydata() for line in ax.lines}


def test_every_result_is_one_line(point, curve, history):
    results = {
        "f 0.07": point,
        "3 speeds": curve,
        "21 times": history,
        "48 x 48 points": MODEL.surface,
        "48 x 48 cells": point.balance.contact_state.fields,
        "nodes, M": lubfric.solve_ehl(**EHL),
        "paper, map": MODEL,
    }
    for words, result in results.items():
        assert words in repr(result) and "\n" not in repr(result) and len(repr(result)) < 250, repr(result)
    assert f"{point.coefficient:.5g}" in repr(point) and "converged" in repr(point)


def test_fields_are_where_a_user_looks_for_them(point):
    cell = (point.x[1] - point.x[0]) * (point.y[1] - point.y[0])
    width = point.y[-1] + point.y[1]
    load = point.pressure.sum() * cell * SCENE.bodies.width / width
    assert load == pytest.approx(point.contact_load, rel=1e-3)
    assert point.gap.shape == (point.x.size, point.y.size) and abs(point.x.mean()) < 1.1e-6
    with pytest.raises(lubfric.InputError, match="fields=True"):
        lubfric.stribeck(MODEL, [0.01]).points[0].pressure
    apart = lubfric.friction(MODEL, 1.0)
    assert not apart.pressure.any() and apart.gap.min() > 0  # the undeformed surface below the film
    assert apart.gap.mean() == pytest.approx(apart.mean_gap, rel=0.2)


def test_a_curve_is_drawn_on_given_axes(curve):
    ax = axes()
    assert curve.plot(ax, label="mine", color="k") is ax
    result = lines(ax)
    np.testing.assert_array_equal(result["mine"], np.stack([curve.speed, curve.coefficient], axis=1))
    parts = result["asperity friction"][:, 1] + result["fluid friction"][:, 1]
    np.testing.assert_allclose(parts, curve.coefficient, rtol=1e-12)
    assert ax.get_xscale() == "log" and "m/s" in ax.get_xlabel()


def test_curves_on_the_same_axes_differ_and_are_named_once(curve):
    """In a journal's column: the key leaves most of the figure, and the label of f is whole."""
    narrow = figures.new_figure(figsize=(84 / 25.4, 65 / 25.4))
    ax = narrow.subplots()
    curve.plot(ax)
    curve.plot(ax=ax, label="superfinished")
    curve.plot(ax)
    named = [line for line in ax.lines if line.get_label() in ("superfinished", SCENE.name, f"{SCENE.name} (2)")]
    assert len({line.get_color() for line in named}) == len(named) == 3
    for part in ("asperity friction", "fluid friction"):
        of_part = [line.get_color() for line in ax.lines if line.get_label() == part]
        assert of_part == [line.get_color() for line in named]
    key = [text.get_text() for text in ax.get_legend().get_texts()]
    assert len(set(key)) == len(key) and {"superfinished", f"{SCENE.name} (2)"} <= set(key)
    narrow.canvas.draw()
    assert ax.get_legend().get_window_extent().height < 0.3 * narrow.bbox.height
    box = ax.yaxis.label.get_window_extent()
    assert narrow.bbox.y0 <= box.y0 and box.y1 <= narrow.bbox.y1
    assert curve.coefficient.max() < ax.get_ylim()[1] and ax.get_ylim()[0] == 0.0


def test_bars_of_curves_on_the_same_axes_do_not_hide_each_other():
    """On the screen: those of the first curve at its points, and the others beside them, nearer than the next speed."""
    speeds = np.array([0.01, 0.1])
    columns = {name: np.ones(2) for name in (*NUMBERS, "model_error")}
    columns |= {"speed": speeds, "coefficient": np.array([0.1, 0.1]), "contact_load": np.ones(2)}
    columns |= {"interval_low": np.array([0.08, 0.08]), "interval_high": np.array([0.12, 0.12])}
    ax = axes()
    for name in ("one", "two", "three"):
        draw_curve(ax, columns, name, interval="bars")
    at_points = ax.transData.transform(np.stack([speeds, [0.1, 0.1]], axis=1))[:, 0]
    assert len(ax.containers) == 3
    for place, bars in enumerate(ax.containers):
        (upper, *_) = bars.lines[1]
        on_screen = upper.get_transform().transform(upper.get_xydata())[:, 0]
        np.testing.assert_allclose(on_screen - at_points, 0.012 * place * np.ptp(at_points), atol=1e-6)


def test_only_the_uncertain_pieces_of_a_curve_are_dashed(curve, monkeypatch):
    """In the colour of the curve, whose sample in the key is solid."""
    monkeypatch.setattr("lubfric.studies.tables.errors_of_gaps", lambda curve: np.array([0.01, 0.2]))
    ax = curve.plot(axes(), label="mine", parts=False, interval="none")
    middle = curve.speed[1]
    (solid, dashed) = (line for line in ax.lines if line.get_xdata().size > 3)
    assert solid.get_label() == "mine" and (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    assert solid.get_color() == dashed.get_color()
    x = solid.get_xdata()
    np.testing.assert_array_equal(np.isfinite(solid.get_ydata()), x < middle)
    is_dashed = np.isfinite(dashed.get_ydata())
    np.testing.assert_array_equal(is_dashed, np.append(is_dashed[1:], True) & (np.append(x[1:], np.inf) >= middle))
    (sample,) = (line for line in ax.lines if line.get_label() == "interpolated")
    assert sample.get_linestyle() == "--"


def test_points_of_a_simpler_model_are_hollow(curve):
    columns = columns_of_curve(curve) | {"model": np.array(["quick", "deterministic", "quick"])}
    ax = axes()
    draw_curve(ax, columns, "one")
    np.testing.assert_allclose(lines(ax)["quick model"][:, 0], curve.speed[[0, 2]])
    (hollow,) = (line for line in ax.lines if line.get_label() == "quick model")
    assert hollow.get_markerfacecolor() == "w" and "deterministic model" not in lines(ax)
    ax = axes()
    draw_curve(ax, columns | {"model": np.full(3, "quick")}, "all alike")
    assert "quick model" not in lines(ax)
    ax = axes()
    draw_curve(ax, columns | {"model": np.full(3, "quick")}, "beside others", models={"deterministic"})
    assert lines(ax)["quick model"].shape == (3, 2)


def test_what_a_drawn_curve_has_is_chosen_by_its_keywords(curve):
    ax = curve.plot(axes(), parts=False, interval="none", ls="--")
    assert not ax.collections and not {"asperity friction", "fluid friction"} & set(lines(ax))
    assert curve.plot(axes(), interval="bars").containers
    for plot in (curve.plot, lubfric.study(SCENE, {"bodies.load": [2.0]}, [0.03]).plot):
        with pytest.raises(lubfric.InputError, match="plot has no keyword 'partz'; allowed: ax.* of the line: color,"):
            plot(partz=False)
    with pytest.raises(lubfric.InputError, match="'band', 'bars', 'none'"):
        curve.plot(interval="lines")


@pytest.mark.parametrize("word", ["ls", "linestyle"])
@pytest.mark.parametrize("error", [0.01, 0.2, 0.6])
def test_a_line_has_the_requested_style_however_well_f_is_known_between_points(curve, monkeypatch, word, error):
    monkeypatch.setattr("lubfric.studies.tables.errors_of_gaps", lambda curve: np.full(2, error))
    ax = curve.plot(axes(), label="mine", parts=False, interval="none", **{word: "-.", "linewidth": 3.0})
    (line,) = (each for each in ax.lines if each.get_linestyle() != "None")
    assert line.get_linestyle() == "-."
    assert error > 0.5 or line.get_linewidth() == 3.0


@pytest.mark.parametrize("width, ticks", [(85, [0, 200, 400]), (170, [0, 100, 200, 300, 400])])
def test_numbers_of_three_digits_stay_apart_beside_a_narrow_map(width, ticks):
    figure = Figure(figsize=(width / 25.4, 2.0))
    x = np.array([0.0, 1e-6])
    figures.field_image(figure.subplots(), x, x, np.array([[0.0, 383.0], [1.0, 2.0]]), "cividis", "shear", place="top")
    (_, bar) = figure.axes
    assert bar.get_xticks().tolist() == ticks


def test_curves_of_several_runs_are_drawn_in_one_picture(curve, tmp_path, monkeypatch, capsys):
    saved = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: (saved.append(figure), path.write_bytes(b"")))
    for name, solved in (("a", curve), ("b", replace(curve, points=curve.points[:2], speed=curve.speed[:2]))):
        (tmp_path / name).mkdir()
        solved.to_csv(tmp_path / name / "stribeck.csv")
        points = [{"validity": []} for _ in solved.speed]
        words = dict.fromkeys(("what", "consequence", "recommendation"), "film") | {"unit": "-"}
        points[1] = {"validity": [words | {"value": 2.0, "limit": 1.0, "severe": False}]}
        bodies = {"width": SCENE.bodies.width, "load": SCENE.bodies.load}
        scene = {"name": "roller", "bodies": bodies, "lubricant": {"viscosity": SCENE.lubricant.viscosity}}
        record = {"scene": scene, "points": points}
        (tmp_path / name / "result.json").write_text(json.dumps(record))
    both = ["plot", str(tmp_path / "a"), str(tmp_path / "b")]
    assert main([*both, "--without", "asperity-friction"]) == 0
    assert (tmp_path / "a" / "stribeck_together.png").is_file()
    (drawn,) = saved[0].axes
    solved = lines(drawn)
    np.testing.assert_allclose(solved["a"], np.stack([curve.speed, curve.coefficient], axis=1))
    np.testing.assert_allclose(solved["b"], solved["a"][:2])
    assert "asperity friction" not in solved
    rings = [line.get_xydata() for line in drawn.lines if line.get_label() == "with warnings"]
    np.testing.assert_allclose(rings, np.tile([[curve.speed[1], curve.coefficient[1]]], (2, 1, 1)))
    assert main([*both, "--labels", "ground, honed", "--width", "84 mm"]) == 0
    assert {"ground", "honed"} <= set(lines(saved[1].axes[0]))
    assert main([*both, "--y-scale", "log"]) == 0
    (low, high) = saved[2].axes[0].get_ylim()
    assert 0 < low < curve.coefficient.min() and curve.coefficient.max() < high < 10 * curve.coefficient.max()
    hersey = SCENE.lubricant.viscosity * curve.speed * SCENE.bodies.width / SCENE.bodies.load
    for kind, x, label in (("hersey", hersey, "Hersey number"), ("lambda", curve.lambda_ratio, "lambda ratio")):
        assert main([*both, "--x", kind, "--parts-of", "a"]) == 0
        ax = saved[-1].axes[0]
        np.testing.assert_allclose(lines(ax)["a"], np.stack([x, curve.coefficient], axis=1))
        assert ax.get_xlabel().startswith(label)
        parts = [line.get_color() for line in ax.lines if line.get_label() in ("asperity friction", "fluid friction")]
        assert len(parts) == 2 and len(set(parts)) == 1  # of the one curve, in its colour
    wrong = (["--x", "time"], ["--parts-of", "c"], ["--x", "lambda", "--measured", "m.csv"])
    assert [main([*both, *options]) for options in wrong] == [2, 2, 2]
    assert main(["plot", str(tmp_path / "a"), "--parts-of", "a"]) == 2
    for more, words in (
        (["--labels", "one"], "1 names for 2 folders"),
        (["--panels", "film"], "--panels is for the picture of one run"),
    ):
        assert main([*both, *more]) == 2 and words in " ".join(capsys.readouterr().err.split())
    (tmp_path / "b" / "stribeck.csv").unlink()
    assert main(both) == 2 and "b: no curve" in " ".join(capsys.readouterr().err.split())


def test_traction_curves_of_several_runs_are_drawn_in_one_picture(tmp_path, monkeypatch, capsys):
    """Each with its colour, in the order of its ratios, and no Stribeck curve among them."""
    saved = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: (saved.append(figure), path.write_bytes(b"")))
    heads = "ratio [-],speed [m/s],coefficient [-],interval_low [-],interval_high [-]"
    heads += ",contact_load [N],film_load [N],boundary_force [N],shear_force [N]"
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        record = {"scene": {"name": name}, "points": [{"validity": []}] * 3}
        (tmp_path / name / "result.json").write_text(json.dumps(record))
        rows = [f"{s},1,{f},{0.9 * f},{1.1 * f},1,1,1,1" for s, f in ((0.2, 0.05), (0.1, 0.045), (0.3, 0.055))]
        (tmp_path / name / "traction.csv").write_text("\n".join([heads, *rows]) + "\n")
    both = ["plot", str(tmp_path / "a"), str(tmp_path / "b")]
    assert main(both) == 0 and (tmp_path / "a" / "traction_together.png").is_file()
    (drawn,) = saved[0].axes
    for name in ("a", "b"):
        np.testing.assert_allclose(lines(drawn)[name], [[0.1, 0.045], [0.2, 0.05], [0.3, 0.055]])
    colours = {line.get_color() for line in drawn.lines if line.get_label() in ("a", "b")}
    assert len(colours) == 2 and drawn.get_xlabel() == "slide-roll ratio (-)"
    (tmp_path / "b" / "traction.csv").rename(tmp_path / "b" / "stribeck.csv")
    assert main(both) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "a: a traction curve; " in said and "b: a Stribeck curve" in said


def test_a_lone_point_shows_the_shares_of_its_load():
    """An area over one value of x would be invisible."""
    figures.load_shares(drawn := axes(), np.array([2.0]), np.array([0.25]))
    boxes = [area.get_paths()[0].get_extents() for area in drawn.collections]
    assert [(box.y0, box.y1) for box in boxes] == [(0.0, 0.25), (0.25, 1.0)]
    assert all(box.x0 < 2.0 < box.x1 for box in boxes)


def test_a_history_and_its_loop_are_drawn(history):
    result = lines(history.plot(axes()))
    np.testing.assert_allclose(result["friction coefficient"][:, 0], history.time * 1e3)
    parts = result["asperity friction"][:, 1] + result["fluid friction"][:, 1]
    np.testing.assert_allclose(parts, result["friction coefficient"][:, 1], rtol=1e-9)
    loop = history.plot_loop(axes()).lines[0].get_xydata()
    np.testing.assert_array_equal(loop, np.stack([history.entrainment_speed, history.coefficient], axis=1))


def test_a_loop_omits_a_standstill_and_a_history_names_no_band_it_has_not(history):
    """At rest f is 0 by convention; on one patch the error of the surface is not known."""
    names = {"entrainment_speed": 0.0, "sliding_speed": 0.0, "coefficient": 0.0}
    columns = {name: np.concatenate([[at_rest], history.columns[name][1:]]) for name, at_rest in names.items()}
    loop, begin = replace(history, columns=history.columns | columns).plot_loop(axes()).lines
    np.testing.assert_array_equal(loop.get_ydata()[1:], history.coefficient[1:])
    assert np.isnan(loop.get_ydata()[0]) and begin.get_ydata() == history.coefficient[1]
    rolling = history.columns | {"sliding_speed": np.zeros(21)}
    assert np.isfinite(replace(history, columns=rolling).plot_loop(axes()).lines[0].get_ydata()).all()

    def legend(sampling):
        known = replace(history, columns=history.columns | {"sampling_error": np.full(21, sampling)})
        return [text.get_text() for text in known.plot(axes()).get_legend().get_texts()]

    assert "95 % interval" in " ".join(legend(0.02))
    assert not any("95 %" in text for text in legend(np.nan))


def test_a_reversal_by_rounding_is_a_standstill_in_mean_and_picture(history):
    """A frequency of nine digits leaves 1e-8 of the speed at a reversal, where f is no friction of a motion."""
    at_reversal = {
        "entrainment_speed": -1e-8 * history.entrainment_speed[10],
        "sliding_speed": -1e-8 * history.sliding_speed[10],
        "coefficient": 0.3,
    }
    columns = {name: np.array(history.columns[name]) for name in at_reversal}
    for name, value in at_reversal.items():
        columns[name][10] = value
    reversing = replace(history, columns=history.columns | columns)
    others = np.delete(history.coefficient, 10)
    mean = reversing.average()
    assert mean.in_motion == pytest.approx(1.0) and others.min() < mean.coefficient < others.max()
    assert f"f {others.min():.4g} to {others.max():.4g}" in repr(reversing)
    drawn = reversing.plot(axes())
    assert np.isnan(lines(drawn)["friction coefficient"][10, 1])
    assert "at rest: no f" not in [text.get_text() for text in drawn.get_legend().get_texts()]
    for name in ("entrainment_speed", "sliding_speed"):
        columns[name][11] = 0.0
    resting = replace(history, columns=history.columns | columns).plot(axes())
    assert "at rest: no f" in [text.get_text() for text in resting.get_legend().get_texts()]


def test_the_parts_of_a_history_add_up_to_its_friction_either_way():
    count = {"load": 2.0, "boundary_force": 0.0, "couette_force": 0.0, "rolling_force": -0.2, "coefficient": 0.1}
    columns = {name: np.full(2, value) for name, value in count.items()}
    columns |= {"time": np.array([0.0, 1.0]), "sliding_speed": np.zeros(2), "entrainment_speed": np.full(2, -0.3)}
    axes = figures.new_figure().subplots()
    friction_over_time(axes, columns)  # pure rolling, backwards
    whole, contact, film = (line.get_ydata() for line in axes.get_lines())
    np.testing.assert_allclose(contact + film, whole)


def test_a_scene_prints_in_a_line():
    from lubfric.scene import Bodies

    oil = {"grade": "VG 68", "viscosity_index": 95, "temperature": 333.15}
    scene = SCENE.with_(lubricant=oil, motion={"speeds": np.geomspace(1e-3, 1, 40)})
    assert repr(scene).startswith("<Scene: paper") and "5.5 N" in repr(scene) and len(repr(scene)) < 200
    assert repr(scene.bodies).count("=") == 6 and eval(repr(scene.bodies), {"Bodies": Bodies}) == scene.bodies
    assert repr(lubfric.Numerics(tolerance=0.02)) == "Numerics(tolerance=0.02)"


# scenes as dicts and text


@pytest.mark.parametrize("name", builtin_scenes())
def test_a_scene_comes_back_from_its_text(name):
    scene = lubfric.load_scene(name)
    table = tomllib.loads(scene.to_toml())
    assert lubfric.load_scene(table) == scene


OF_GENERATED_MAPS = {"correlation_length", "acf", "decay_level", "seed", "oversize"}  # typed by hand
OF_FILES = {"motion_axis", "form", "outliers", "extension"}


@pytest.mark.parametrize("kind", ["numbers", "oil", "measured map"])
def test_the_text_of_a_scene_has_every_key_with_a_default(kind, tmp_path):
    """As a key, or in a comment where a key would make it another scene; a run of it is the same to the last bit."""
    scene = lubfric.load_scene("paper").with_(numerics={"model": "paper"})
    absent = OF_FILES
    if kind == "oil":
        scene = scene.with_(
            bodies={"material": ["100Cr6", "silicon nitride"]}, lubricant={"oil": "mineral-32", "temperature": 313.15}
        )
    if kind == "measured map":
        np.save(tmp_path / "map.npy", 1e-7 * np.random.default_rng(0).normal(size=(8, 8)))
        contact = {"shape": None, "spacing": None}
        scene = scene.with_(surface={"file": str(tmp_path / "map.npy"), "spacing": 1e-6, "unit": "m"}, contact=contact)
        absent = OF_GENERATED_MAPS
    (tmp_path / "resolved.toml").write_text(scene.to_toml(), encoding="utf-8")
    section = ""
    stated: dict[str, set[str]] = {}
    values = {}
    for line in scene.to_toml().splitlines():
        section = line.strip("[]") if line.startswith("[") else section
        (key, is_given, value) = line.removeprefix("# ").partition(" = ")
        stated.setdefault(section, set()).update({key} if is_given else ())
        values[key] = value.partition(" [")[0]
    for section in ("bodies", "lubricant", "motion", "surface", "contact", "numerics"):
        part = getattr(scene, section)
        with_default = {
            f.name for f in fields(part) if f.default is not MISSING and getattr(part, f.name) not in (None, ())
        }
        without_effect = absent | {"limiting_stress_offset"}
        assert with_default - stated[section] <= without_effect | {"oil"} and not absent & stated[section]
    assert float(values["boundary_film"]) == 20e-9 and float(values["film_tolerance"]) == 0.003
    assert float(values["viscosity"]) == scene.lubricant.viscosity
    assert kind != "oil" or float(values["temperature_coefficient"]) == scene.lubricant.temperature_coefficient
    assert ("those of the material 100Cr6 and silicon nitride" in scene.to_toml()) == (kind == "oil")
    assert lubfric.load_scene(tmp_path / "resolved.toml") == scene


def test_histories_come_back_from_their_text():
    table = Table(times=(0.0, 0.1, 0.1, 1.0), values=(1.0, 2.0, 3.0, 4.0))
    plan = lubfric.Transient(1.0, speed=Ramp(start=0.1, end=0.2, until=1.0), load=table, viscosity=Harmonic(mean=0.1))
    scene = SCENE.with_(transient=plan)
    assert lubfric.load_scene(tomllib.loads(scene.to_toml())) == scene


@pytest.mark.parametrize(
    "keys",
    [
        {"grade": 100, "viscosity_index": 95},
        {"nu40": 68e-6, "viscosity_index": 140, "base": "pao", "density": 850.0, "density_slope": 0.6},
        {"nu40": 68e-6, "nu100": 8.7e-6, "pressure_viscosity_coefficient": 21e-9, "conductivity": 0.14},
        {"oil": "pao-220", "temperature_coefficient": 0.04, "eyring_stress": 5e6},
        {"viscosity_table": [[300.0, 1e-4], [340.0, 3e-5], [380.0, 9e-6]], "alpha_estimate": "gold"},
        {"oil": lubfric.oil.Oil(viscosity_law=lubfric.oil.Walther(9.2479, 3.5849))},
    ],
)
def test_an_oil_is_written_as_it_was_given(keys):
    scene = SCENE.with_(lubricant=keys | {"temperature_celsius": 60.0})
    again = lubfric.load_scene(tomllib.loads(scene.to_toml()))
    if "oil" in keys and not isinstance(keys["oil"], str):  # its two constants go through viscosities and back
        assert again.lubricant.viscosity == pytest.approx(scene.lubricant.viscosity, rel=1e-12)
    else:
        assert again == scene
    warm, same = (s.with_(lubricant={"temperature": 350.0}).lubricant.viscosity for s in (scene, again))
    assert warm == pytest.approx(same, rel=1e-12) and warm < 0.9 * scene.lubricant.viscosity
    thicker, same = (s.with_(lubricant={"viscosity_index": 120}).lubricant.viscosity for s in (scene, again))
    assert thicker == pytest.approx(same, rel=1e-12)


def test_the_lambda_ratio_is_that_of_the_full_load_whatever_the_asperities_carry():
    """By the regression of Nijenbanning et al. (1994) written out again; the separation under load sharing stays above
    it where asperities carry load."""
    speed = 0.01
    point = lubfric.friction(MODEL, speed)
    bodies = SCENE.bodies
    oil = SCENE.lubricant
    viscous = 2 * oil.viscosity * speed / (bodies.e_prime * bodies.radius)
    m = bodies.load / bodies.width / (bodies.e_prime * bodies.radius * viscous**0.5)
    l = oil.pressure_viscosity_coefficient * bodies.e_prime * viscous**0.25
    rigid_iso, rigid_piezo = 3.0 / m, 1.287 * l ** (2 / 3)
    elastic_iso, elastic_piezo = 2.621 * m**-0.2, 1.311 * m ** (-1 / 8) * l ** (3 / 4)
    s = 0.2 * (7 + 8 * np.exp(-2 * elastic_iso / rigid_iso))
    low = (rigid_iso ** (7 / 3) + elastic_iso ** (7 / 3)) ** (3 / 7 * s)
    high = (rigid_piezo**-3.5 + elastic_piezo**-3.5) ** (-2 / 7 * s)
    film = (low + high) ** (1 / s) * bodies.radius * viscous**0.5
    assert point.full_load_film == pytest.approx(film, rel=1e-9)
    assert point.lambda_ratio == pytest.approx(film / MODEL.surface.sq, rel=1e-9)
    assert point.contact_load > 0 and point.central_film > point.full_load_film
    assert np.isnan(lubfric.friction(MODEL, 0.0).lambda_ratio)


def test_a_notebook_shows_a_table_and_a_picture(point, curve, history):
    """A name of a user is text there, and no tag; what has nothing to draw shows its table."""
    named = replace(SCENE, name="<b>R&D</b>")
    for shown, drawn in ((named, False), (point, False), (curve, True), (history, True), (MODEL.surface, True)):
        page = shown._repr_html_()
        assert page.startswith("<div><table>") and ("data:image/png" in page) == drawn
        assert type(shown).__name__ in page and page.count("<tr>") >= 1
    assert "&lt;b&gt;R&amp;D&lt;/b&gt;" in named._repr_html_() and "<b>" not in named._repr_html_()
    empty = replace(curve, coefficient=np.full(3, np.nan))
    assert "<table>" in empty._repr_html_()


@pytest.mark.parametrize("speed", [0.5, 5.0, 50.0])
def test_the_heat_of_the_inlet_does_not_thin_a_given_film_that_arrives(speed):
    """A flooded film grows with the speed more slowly than without heat; of a starved one what arrives is what there
    is."""
    scene = lubfric.load_scene("paper").with_(
        lubricant={"viscosity": None, "pressure_viscosity_coefficient": None, "grade": "ISO VG 460"}
        | {"viscosity_index": 95, "temperature": "40 °C"},
        numerics={"model": "paper", "sampling": "patch"},
    )
    flooded = lubfric.friction(scene, speed)
    starved_scene = scene.with_(lubricant={"inlet_film": 60e-9})
    starved = lubfric.friction(starved_scene, speed)
    assert flooded.inlet_film_factor < 1.0 and flooded.full_load_film > 60e-9
    assert starved.full_load_film == pytest.approx(60e-9, rel=1e-12)
    factor = flooded.inlet_film_factor
    assert scene.line_contact(speed).expected_film_with(factor) == pytest.approx(flooded.full_load_film, rel=1e-12)
    assert starved_scene.line_contact(speed).expected_film_with(factor) == pytest.approx(60e-9, rel=1e-12)


@pytest.mark.parametrize("alpha, is_estimate", [(None, True), (2e-8, False)])
def test_an_estimated_pressure_viscosity_coefficient_stands_beside_the_answer(tmp_path, alpha, is_estimate):
    """With the changes by measured oils of the closed forms, as the effects that are not modelled have them."""
    scene = lubfric.load_scene("paper").with_(
        lubricant={"viscosity": None, "pressure_viscosity_coefficient": alpha, "grade": "ISO VG 68"}
        | {"viscosity_index": 95, "temperature": "40 °C", "eyring_stress": 5e6},
        numerics={"model": "paper", "sampling": "patch"},
    )
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert main(["run", str(tmp_path / "scene.toml"), "--speeds", "0.5", "--out", str(tmp_path / "out")]) == 0
    page = unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    answer = page.partition("Uncertainty budget")[0]
    assert (
        "the pressure-viscosity coefficient is an estimate, and the interval does not contain the range" in answer
    ) == is_estimate
    if is_estimate:
        effects = lubfric.friction(scene, 0.5).unmodelled_effects
        changes = [effect.change for effect in effects if "measured oils" in effect.what]
        assert f"at most about {100 * max(changes):.2g} % either way" in answer
