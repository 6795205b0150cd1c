"""What is written and drawn: every column with its unit, every field the right way round, every line and image by the
numbers that its artists hold."""

import csv
import io
import json
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.image import imread
from scene_text import paper_scene
from scipy.special import stdtrit

import lubfric
from lubfric._base import read_table
from lubfric._base.figures import field_image, new_figure
from lubfric.models import ContactFields
from lubfric.output import (
    DrawnContact,
    PictureOptions,
    drawn_contact,
    fields_bytes,
    grid_bytes,
    main,
    plot_contact,
    plot_history,
    plot_stribeck,
    plot_surface,
    plot_traction,
)
from lubfric.output.commands import read_record
from lubfric.studies import csv_bytes, friction_over_speed, interval_band, plot_map

UNITS = {  # of the columns of results, typed by hand
    **dict.fromkeys(
        "contact_load film_load boundary_film_load saturated_film_load shear_force couette_force rolling_force boundary_force".split(),
        "N",
    ),
    **dict.fromkeys(("min_film", "central_film", "mean_gap", "full_load_film"), "m"),
    **dict.fromkeys(("flash_temperature_rise", "film_temperature_rise"), "K"),
    **{"speed": "m/s", "real_contact_area": "m2", "line_length": "m"},
    **{"rolling_resistance": "N", "power_loss": "W", "power_loss_low": "W", "power_loss_high": "W"},
}
SCENE = paper_scene(
    contact={"shape": (48, 32), "spacing": (1.1e-6, 1.7e-6)},
    surface={"correlation_length": (4e-6, 6e-6), "acf": "gaussian"},
    numerics={"sampling": "patch"},
)


@pytest.fixture
def laid_out(monkeypatch):
    """The figures that are saved, in place of files."""
    saved = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: saved.append(figure))
    return saved


@pytest.fixture
def figures(laid_out, monkeypatch):
    """The same for tests of what is drawn, wherever it is in the picture: nothing is laid out, which takes most of the
    time."""
    monkeypatch.setattr("lubfric._base.figures.lay_out", lambda figure: None)
    return laid_out


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
    "central_film": np.array([1e-7, 0.3e-7, np.nan, 4.5e-7]),
    "film_to_roughness_ratio": np.array([1.0, 0.3, np.nan, 4.5]),
    "full_load_film": np.array([0.9e-7, 0.2e-7, np.nan, 4.5e-7]),
    "interval_low": np.array([0.04, 0.08, np.nan, 0.019]),
    "interval_high": np.array([0.06, 0.10, np.nan, 0.022]),
    "flash_temperature_rise": np.array([7.0, 3.0, np.nan, 21.0]),
    "film_temperature_rise": np.array([1.0, 0.5, np.nan, 30.0]),
}


def test_a_curve_is_drawn_by_its_table(figures):
    cautious = [(), (), (), (SimpleNamespace(severe=False, is_note=False, assumption="", what="starved"),)]
    plot_stribeck("x.png", COLUMNS, "title", cautious)
    top, middle, bottom = figures[0].axes
    for label, expected in (
        ("friction coefficient", [0.09, 0.05, 0.02]),
        ("asperity friction", [0.4 / 5, 0.2 / 5, 0.0]),
        ("fluid friction", [0.05 / 5, 0.05 / 5, 0.1 / 5]),
    ):
        np.testing.assert_allclose(data(top, label), [[0.01, 0.1, 1.0], expected], rtol=1e-12)
    styles = {line.get_label(): line.get_linestyle() for line in top.lines}
    assert styles["friction coefficient"] == "None"  # three points a decade apart show no curve
    assert styles["not known in between"] == ":"
    key = [text.get_text() for text in top.get_legend().get_texts()]
    assert key.count("not known in between") == 1
    np.testing.assert_allclose(
        edges(top, "95 % interval, without model-form error"),
        [[0.08, 0.04, 0.019], [0.1, 0.06, 0.022]],
    )
    np.testing.assert_allclose(data(top, "with warnings"), [[1.0], [0.02]])
    np.testing.assert_allclose(edges(middle, "asperity load $F_C/F_T$"), [[0, 0, 0], [0.8, 0.4, 0.0]], atol=1e-12)
    np.testing.assert_allclose(edges(middle, "film load $F_H/F_T$"), [[0.8, 0.4, 0.0], [1, 1, 1]], atol=1e-12)
    np.testing.assert_allclose(data(bottom, "full-load film thickness"), [[0.01, 0.1, 1.0], [20, 90, 450]])
    np.testing.assert_allclose(data(bottom, "central separation"), [[0.01, 0.1, 1.0], [30, 100, 450]])
    assert [line.get_ydata()[0] for line in bottom.lines[2:]] == pytest.approx([100, 300])  # Sq, and three times that
    assert "(m/s)" in bottom.get_xlabel() and "(nm)" in bottom.get_ylabel() and "(-)" in middle.get_ylabel()


def test_the_band_between_the_points_has_no_bulges():
    """Between two points its relative width stays between theirs, and it passes through them."""
    speed = np.geomspace(0.01, 1.0, 5)
    width = np.array([0.05, 0.05, 0.3, 0.02, 0.02])
    f = np.array([0.09, 0.07, 0.04, 0.03, 0.05])
    fine = np.geomspace(0.01, 1.0, 401)
    line = np.exp(np.interp(np.log(fine), np.log(speed), np.log(f)))
    axes = new_figure().subplots()
    interval_band(
        axes, speed, {"coefficient": f, "interval_low": f * (1 - width), "interval_high": f * (1 + width)}, (fine, line)
    )
    low, high = edges(axes, "95 % interval, without model-form error")
    for band, sign in ((high, 1), (low, -1)):
        relative = sign * (band / line - 1)
        np.testing.assert_allclose(relative[::100], width, rtol=1e-9)
        piece = np.minimum(np.arange(401) // 100, 3)
        ends = np.sort([width[piece], width[piece + 1]], axis=0)
        assert (relative >= ends[0] - 1e-12).all() and (relative <= ends[1] + 1e-12).all()


def test_a_picture_is_drawn_as_the_command_says(figures, tmp_path, monkeypatch):
    """Panels, scales of the axes, and a width for the column of a journal."""
    requested = []

    def draw(path, *arguments, **_):
        requested.append(arguments[-1])
        path.write_bytes(b"a picture")

    monkeypatch.setattr("lubfric.output.curve_picture.plot_stribeck", draw)
    scene = tmp_path / "s.toml"
    scene.write_text(SCENE.with_(motion={"entrainment_speed": 0.1}, numerics={"model": "paper"}).to_toml())
    out = str(tmp_path / "out")
    main(["run", str(scene), "--speeds", "0.1,1", "--out", out])
    main(["plot", out, "--panels", "friction, film", "--x-scale", "linear", "--y-scale", "log", "--width", "85 mm"])
    plot_stribeck("x.png", COLUMNS, "title", [()] * 4, options=requested[-1])
    top, bottom = figures[-1].axes
    assert figures[-1].get_figwidth() == pytest.approx(85 / 25.4)
    assert top.get_yscale() == "log" and bottom.get_xscale() == "linear" and "film" in bottom.get_ylabel()
    low, high = top.get_ylim()
    assert 0 < low < 0.02 and high > 0.09
    assert requested[-1].has_warnings and requested[-1].has_parts
    main(["plot", out, "--without", "parts, warnings"])
    assert not requested[-1].has_warnings and not requested[-1].has_parts
    main(["plot", out, "--interval", "bars", "--name", "figure_3", "--format", "svg"])
    assert requested[-1].has_bars and (tmp_path / "out" / "figure_3.svg").is_file()
    plot_stribeck("x.png", COLUMNS, "title", [()] * 4, options=requested[-1])
    (bars,) = figures[-1].axes[0].collections
    ends = np.array([bar[:, 1] for bar in bars.get_segments()])
    order = np.argsort(COLUMNS["speed"])
    good = order[np.isfinite(COLUMNS["coefficient"][order])]
    np.testing.assert_allclose(ends, np.column_stack([COLUMNS["interval_low"], COLUMNS["interval_high"]])[good])
    wrong_words = (["--panels", "torque"], ["--y-scale", "cubic"], ["--without", "curve"], ["--interval", "box"])
    assert main(["plot", out, "--name", "../figure"]) == 2
    for wrong in (["--format", "bmp"], ["--width", "1 mm"], *wrong_words):
        assert main(["plot", out, *wrong]) == 2


def test_lines_of_a_curve_are_omitted(figures, tmp_path, monkeypatch):
    """By their names in the key, of both kinds of curve; and the speed that --fields added."""
    drawn = []
    monkeypatch.setattr("lubfric.output.plot_again.write_picture", lambda *each: drawn.append(each[-1].keywords))
    scene = tmp_path / "s.toml"
    scene.write_text(SCENE.with_(motion={"entrainment_speed": 0.1}, numerics={"model": "paper"}).to_toml())
    out = str(tmp_path / "out")
    assert main(["run", str(scene), "--speeds", "0.1", "--fields", "0.5", "--out", out]) == 0
    assert main(["plot", out]) == 0 and main(["plot", out, "--without", "asperity-friction, operating point"]) == 0
    assert main(["plot", out, "--without", "added-speeds"]) == 0
    assert [each["columns"]["speed"].tolist() for each in drawn] == [[0.1, 0.5], [0.1, 0.5], [0.1]]
    lines = {"asperity friction", "fluid friction", "operating point"}
    for plot, columns in ((plot_stribeck, COLUMNS), (plot_traction, COLUMNS | {"ratio": COLUMNS["speed"]})):
        for known, shown in zip(drawn, (lines, {"fluid friction"})):
            plot("x.png", columns, "title", [()] * 4, options=known["options"], operating_point=0.1)
            assert lines.intersection(figures[-1].axes[0].get_legend_handles_labels()[1]) == shown


@pytest.mark.parametrize("error, label", [(0.2, "interpolated"), (0.6, "not known in between")])
def test_a_line_between_points_is_interpolated_as_far_as_the_report_states_it(monkeypatch, error, label):
    """By a straight line, of an estimated error between 5 and 50 %."""
    speed = np.array([0.01, 1.0])
    curve = SimpleNamespace(
        samples=SimpleNamespace(speed=speed), boundary=lambda u: 0.1 - 0.05 * u, film=lambda u: 0 * u
    )
    monkeypatch.setattr("lubfric.studies.tables.through", lambda columns: curve)
    monkeypatch.setattr("lubfric.studies.tables.errors_of_gaps", lambda curve: np.array([error]))
    axes = new_figure().subplots()
    f = COLUMNS["coefficient"]
    friction_over_speed(axes, COLUMNS | {"interval_low": 0.99 * f, "interval_high": 1.01 * f})
    names = [line.get_label() for line in axes.lines]
    assert [name for name in names if name in ("interpolated", "not known in between")] == [label]
    (x, f) = next(line.get_data() for line in axes.lines if line.get_linestyle() in ("--", ":"))
    assert label != "interpolated" or np.allclose(f, 0.1 - 0.05 * x)
    (low, high) = edges(axes, "95 % interval, without model-form error")
    assert low.size == 3 or np.allclose([low / f, high / f], [[0.99], [1.01]])  # the band follows an interpolated line


def test_errors_of_f_are_no_assumptions_below_a_curve(figures):
    of_f = [f"{name} error within its tolerance" for name in ("numerical", "sampling", "model-form")]
    errors = [SimpleNamespace(severe=False, is_note=False, assumption=name, what="") for name in of_f]
    starved = SimpleNamespace(severe=False, is_note=False, assumption="", what="starved")
    plot_stribeck("x.png", COLUMNS, "title", [(*errors,), (), (), (*errors, starved)])
    lines_below = figures[0].get_supxlabel().splitlines()
    assert max(map(len, lines_below)) < 14 * figures[0].get_figwidth()
    text = " ".join(lines_below)
    assert text.endswith(": starved (1 of 3 points)") and "error" not in text
    assert data(figures[0].axes[0], "with warnings").shape == (2, 2)


@pytest.mark.parametrize("unknown, words", [([], ""), ([0], ", model-form error where known")])
def test_the_key_says_whether_the_model_form_error_is_known_at_all_points(figures, unknown, words):
    """Where a gap breaks the line of a traction curve, there is no point whose error could be unknown."""
    ratio = np.linspace(0.0, 0.1, 4)
    f = 0.01 * np.arcsinh(ratio / 1e-3)
    columns = {name: np.resize(column, 4) for name, column in COLUMNS.items()}
    columns |= {"ratio": ratio, "coefficient": f, "interval_low": 0.9 * f, "interval_high": 1.1 * f}
    error = np.full(4, 0.05)
    error[unknown] = np.nan
    plot_traction("x.png", columns | {"model_error": error}, "title", [()] * 4)
    labels = figures[0].axes[0].get_legend_handles_labels()[1]
    assert "not known in between" in labels and f"95 % interval{words}" in labels


def rows_of(axes):
    """The label of each row of a panel, and where its bar or line begins and ends along x."""
    ends = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in axes.patches]
    ends += [tuple(piece[:, 0]) for lines in axes.collections for piece in lines.get_segments()] if not ends else []
    return dict(zip([label.get_text() for label in axes.get_yticklabels()], ends))


def test_one_speed_is_drawn_with_its_parts_and_no_axis_of_speeds(figures):
    """f and its parts from 0, the interval and that by each error alone, by Student's t; a part is no more than the
    whole."""
    one = {name: column[:1] for name, column in COLUMNS.items()}
    errors = {"model_error": 0.9, "numerical_error": 0.02, "sampling_error": 0.01, "sampling_freedom": 4.0}
    errors |= {"input_error": 0.1, "input_error_low": 0.0, "input_error_high": 0.1}
    one |= {name: np.array([value]) for name, value in errors.items()}
    plot_stribeck("x.png", one, "title", [()])
    friction, interval, loads, films = figures[0].axes
    labels = [axes.get_xlabel() for axes in figures[0].axes]
    assert not any("speed" in label for label in labels) and figures[0].get_suptitle().endswith("U = 0.1 m/s")
    load = one["contact_load"][0] + one["film_load"][0]
    bars = rows_of(friction)
    assert bars["friction coefficient"] == pytest.approx((0.0, 0.05))
    assert bars["asperity friction"] == pytest.approx((0.0, one["boundary_force"][0] / load))
    assert bars["fluid friction"] == pytest.approx((0.0, one["shear_force"][0] / load))
    parts = rows_of(interval)
    assert parts["95 % interval of f"] == parts["model-form error"] == pytest.approx((0.04, 0.06))
    assert parts["numerical error"] == pytest.approx((0.049, 0.051))
    t = stdtrit(4, 0.975)
    assert parts["sampling error"] == pytest.approx((0.05 * (1 - 0.01 * t), 0.05 * (1 + 0.01 * t)))
    assert parts["ranges of inputs"] == pytest.approx((0.05, 0.055)) and "input not given" not in parts
    (share, rest) = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in loads.patches]
    assert share[1] == rest[0] == pytest.approx(one["contact_load"][0] / load) and rest[1] == 1
    assert "film thickness" in films.get_xlabel()


@pytest.mark.parametrize("options", [PictureOptions(has_parts=False), PictureOptions(x_scale="log"), None])
def test_what_is_chosen_of_the_picture_of_one_point(figures, options):
    """Without the parts of the interval; with a scale, or a measured curve, over the speed as other curves."""
    one = {name: column[:1] for name, column in COLUMNS.items()} | {"model_error": np.array([0.1])}
    measured = lubfric.studies.Measured(np.array([0.05, 0.2]), np.array([0.05, 0.06])) if options is None else None
    plot_stribeck("x.png", one, "title", [()], measured, options or PictureOptions())
    is_point = options is not None and options.x_scale is None
    assert ("speed" in figures[0].axes[-1].get_xlabel()) != is_point
    assert not any("each error alone" in axes.get_xlabel() for axes in figures[0].axes)


def test_a_traction_curve_is_drawn_by_its_table(figures):
    columns = COLUMNS | {"ratio": COLUMNS["speed"]}
    plot_traction("x.png", columns, "title", [()] * 4)
    top, loads, film, bottom = figures[0].axes
    np.testing.assert_allclose(data(top, "friction coefficient"), [[0.01, 0.1, 1.0], [0.09, 0.05, 0.02]])
    solved = np.argsort(COLUMNS["speed"])
    solved = solved[np.isfinite(COLUMNS["coefficient"][solved])]
    unit = {"nm": 1e9, "µm": 1e6}[film.get_ylabel().partition("(")[2].rstrip(")")]
    (ratio, separation) = data(film, "central separation")
    np.testing.assert_allclose(ratio, [0.01, 0.1, 1.0])
    np.testing.assert_allclose(separation, unit * COLUMNS["central_film"][solved])
    assert loads.get_ylabel() == "load ratio (-)"
    np.testing.assert_allclose(data(bottom, "surfaces (flash temperature)"), [[0.01, 0.1, 1.0], [3.0, 7.0, 21.0]])
    np.testing.assert_allclose(data(bottom, "film, above the surfaces"), [[0.01, 0.1, 1.0], [0.5, 1.0, 30.0]])
    assert "(K)" in bottom.get_ylabel() and "slide-roll ratio (-)" == bottom.get_xlabel()


def test_panels_of_a_traction_curve_are_chosen(figures):
    columns = COLUMNS | {"ratio": COLUMNS["speed"]}
    for panels in (("friction",), ("load", "temperature")):
        plot_traction("x.png", columns, "title", [()] * 4, options=PictureOptions(panels=panels))
    (alone, two) = figures
    (top,) = alone.axes
    assert top.get_xlabel() == "slide-roll ratio (-)" and alone.get_figheight() < 4
    labels = [" ".join(axes.get_ylabel().split()) for axes in two.axes]
    assert labels == ["load ratio (-)", "largest temperature rise (K)"]
    cold = dict.fromkeys(("flash_temperature_rise", "film_temperature_rise"), 0 * COLUMNS["speed"])
    with pytest.raises(lubfric.InputError, match="no temperatures"):
        plot_traction("x.png", columns | cold, "t", [()] * 4, options=PictureOptions(panels=("temperature",)))


def test_one_ratio_shows_its_temperatures(figures):
    plot_traction(
        "x.png", {name: column[:1] for name, column in (COLUMNS | {"ratio": COLUMNS["speed"]}).items()}, "t", [()]
    )
    assert all(line.get_marker() == "o" for line in figures[0].axes[-1].lines)


def test_the_picture_of_a_starved_film_begins_where_its_pressure_does(laid_out):
    x = np.linspace(-300e-6, 300e-6, 61)
    y = np.arange(12) * 10e-6
    pressure = np.repeat(np.where((x > -195e-6) & (x < 0), 2e6, 0.0)[:, None], 12, axis=1)
    gap = np.full((61, 12), 6e-7)
    gap[30] = 4e-7
    fields = ContactFields(
        solve="a strip",
        x=x,
        y=y,
        heights=gap,
        pressure=pressure,
        gap=gap,
        deflection=gap,
        film=gap,
        shear=pressure,
        pressure_includes_film=True,
    )
    contact = DrawnContact(speed=1.0, half_width=2e-5, fields=fields, has_film=False)
    plot_contact("x.png", contact)
    low, high = laid_out[0].axes[0].get_xlim()
    assert low == pytest.approx(-195, abs=1e-6) and high == pytest.approx(85, abs=1e-6)
    laid_out[0].canvas.draw()
    bar = next(axes for axes in laid_out[0].axes if axes.get_ylabel().startswith("gap"))
    assert not any("times" in tick.get_text() for tick in bar.get_yticklabels(which="both"))
    assert laid_out[0].axes[0].get_ylabel() == "y (µm)"  # shorter than its axis


def spotted_contact():
    """A deterministic contact of 1 GPa, one cell of which has 7.5 GPa, under a gap from 1 nm to 5 µm."""
    x = np.linspace(-40e-6, 40e-6, 41)
    pressure = np.where(np.abs(x) < 2e-5, 1e9, 0.0)[:, None] * np.ones(40)
    gap = np.geomspace(1e-9, 5e-6, 41)[:, None] * np.ones(40)
    pressure[20, 20] = 7.5e9
    names = ("heights", "deflection", "film", "gap")
    fields = ContactFields(
        solve="a strip",
        x=x,
        y=2e-6 * np.arange(40),
        **dict.fromkeys(names, gap),
        pressure=pressure,
        shear=0.1 * pressure,
        pressure_includes_film=True,
    )
    return DrawnContact(speed=1.0, half_width=2e-5, fields=fields, has_film=False)


def test_one_spot_does_not_set_the_colours_of_a_contact(figures):
    """The bar ends with an arrow; numbers of the narrow bar of the gap stay apart, and the arrow of U is in the label."""
    plot_contact("x.png", spotted_contact(), PictureOptions(width=0.085))
    maps = [axes for axes in figures[0].axes if axes.images]
    (pressure, gap, shear) = (axes.images[0] for axes in maps)
    assert pressure.get_clim() == (0.0, 1.0) and pressure.colorbar.extend == "max"
    assert shear.get_clim() == pytest.approx((0.0, 100.0)) and shear.colorbar.extend == "max"
    assert gap.colorbar.extend == "neither" and gap.colorbar.get_ticks().tolist() == pytest.approx([1e-3, 0.1])
    assert all(axes.get_xlabel() == "x (µm), U →" for axes in maps)
    (dashed, _) = [line for line in maps[1].lines if line.get_linestyle() == "--"]
    assert dashed.get_path_effects() and dashed.get_color() == "k"


def test_panels_and_the_title_of_a_contact_are_chosen(figures):
    options = PictureOptions(panels=("gap", "pressure"), has_title=False)
    plot_contact("x.png", spotted_contact(), options)
    plot_contact("x.png", spotted_contact())
    labels = [[bar.get_ylabel() for bar in figure.axes if not bar.images] for figure in figures]
    assert labels == [["pressure (GPa)", "gap (µm)"], ["pressure (GPa)", "gap (µm)", "isothermal shear stress (MPa)"]]
    assert figures[0].get_suptitle() == "" and "heat, the shear stress does not" in figures[1].get_suptitle()
    assert figures[1]._suptitle.get_wrap()  # it is longer than the picture is wide


def test_the_key_of_a_narrow_figure_has_few_rows():
    axes = new_figure(figsize=(85 / 25.4, 60 / 25.4)).subplots()
    errors = {"model_error": np.full(4, 0.1), "sampling_error": np.full(4, 0.05), "sampling_freedom": np.full(4, 9)}
    friction_over_speed(axes, COLUMNS | errors)
    axes.figure.canvas.draw()
    key = axes.get_legend()
    assert len(key.get_texts()) == 7 and key.get_window_extent().height < 0.25 * axes.figure.bbox.height


def test_a_band_ends_where_the_points_of_a_traction_curve_do_not_show_f(figures):
    """Equal steps from 0 jump over the knee: a dotted line, and no band from the first point to the second."""
    ratio = np.linspace(0.0, 0.1, 4)
    f = 0.01 * np.arcsinh(ratio / 1e-3)
    columns = {name: np.resize(column, 4) for name, column in COLUMNS.items()}
    columns |= {"ratio": ratio, "coefficient": f, "interval_low": 0.9 * f, "interval_high": 1.1 * f}
    plot_traction("x.png", columns, "title", [()] * 4)
    top = figures[0].axes[0]
    np.testing.assert_array_equal(data(top, "not known in between"), [ratio[:2], f[:2]])
    assert np.isnan(data(top, "friction coefficient")).sum(axis=1).tolist() == [1, 1]
    (band,) = (area for area in top.collections if "95 % interval" in str(area.get_label()))
    assert min(path.vertices[:, 0].min() for path in band.get_paths() if len(path.vertices)) > 0.03


def test_a_history_is_drawn_by_its_table(figures):
    t = np.array([0.0, 0.01, 0.02])
    columns = {"time": t, "entrainment_speed": np.array([0.1, -0.2, 0.3]), "load": np.array([5.0, 6.0, 8.0])}
    columns |= {
        "central_film": 1e-6 * t + 1e-7,
        "min_film": 1e-6 * t + 0.5e-7,
        "mean_gap": 1e-6 * t + 2e-7,
        "sliding_speed": 0 * t + 0.2,
    }
    columns |= {"contact_load": np.array([1.0, 3.0, 2.0]), "coefficient": np.array([0.03, 0.05, 0.04])}
    columns |= {"boundary_force": 0 * t + 0.1, "couette_force": 0 * t + 0.04, "rolling_force": 0 * t + 0.01}
    plot_history("x.png", columns, "title")
    first, second, third, fourth, load = figures[0].axes
    np.testing.assert_allclose(data(first, "entrainment speed $U$"), [[0, 10, 20], [0.1, -0.2, 0.3]])
    np.testing.assert_allclose(data(first, "sliding speed $u_2 - u_1$"), [[0, 10, 20], [0.2, 0.2, 0.2]])
    np.testing.assert_allclose(load.lines[0].get_data(), [[0, 10, 20], [5, 6, 8]])
    for label, least in (
        ("central separation", 100.0),
        ("smallest film", 50.0),
        ("mean separation over the Hertz strip", 200.0),
    ):
        np.testing.assert_allclose(data(second, label), [[0, 10, 20], 1e3 * t + least])
    np.testing.assert_allclose(edges(third, "asperity load $F_C/F_T$")[1], [0.2, 0.5, 0.25])
    np.testing.assert_allclose(data(fourth, "fluid friction"), [[0, 10, 20], 0.05 / columns["load"]])
    wide = columns | {"min_film": np.array([0.0, 1e-9, 2e-8])}  # 220 times below the thickest; a 0 counts for nothing
    plot_history("x.png", wide, "title")
    scales = [each.axes[1].get_yscale() for each in figures]
    (low, high) = figures.pop().axes[1].get_ylim()
    assert scales == ["linear", "log"] and 0.5 < low < 1.0 and high > 220
    reversing = columns | {"full_load_film": np.array([1e-7, 2e-10, 1e-7])}
    plot_history("x.png", reversing, "title")
    assert figures.pop().axes[1].get_yscale() == "linear"  # the solved films alone decide
    assert "(nm)" in second.get_ylabel() and fourth.get_xlabel() == "time (ms)" and "(N)" in load.get_ylabel()
    power = np.array([2e-3, 5e-3, 4e-3])
    ends = {"power_loss_low": 0.9 * power, "power_loss_high": 1.2 * power}
    force = {"friction_force": columns["coefficient"] * columns["load"]}
    of_f = {"interval_low": 0.9 * columns["coefficient"], "interval_high": 1.2 * columns["coefficient"]}
    plot_history("x.png", columns | ends | force | of_f | {"power_loss": power}, "title")
    (*_, above, last, _) = figures[1].axes
    newtons = np.array([0.15, 0.3, 0.32])
    np.testing.assert_allclose(data(above, "friction force on surface 2, positive along −x"), [[0, 10, 20], newtons])
    np.testing.assert_allclose(edges(above, "95 % interval, without model-form error"), [0.9 * newtons, 1.2 * newtons])
    assert above.get_ylabel() == "force (N)"
    np.testing.assert_allclose(data(last, "power loss"), [[0, 10, 20], [2, 5, 4]])
    np.testing.assert_allclose(
        edges(last, "95 % interval, without model-form error"), [[1.8, 4.5, 3.6], [2.4, 6.0, 4.8]]
    )
    assert " ".join(last.get_ylabel().split()) == "power loss $P$ (mW)"
    assert last.get_xlabel() == "time (ms)" and not above.get_xlabel()


def test_a_map_is_seen_from_above_in_micrometres():
    x = 1e-6 * np.array([-2.0, 0.0, 2.0])
    y = 1e-6 * np.array([0.0, 5.0])
    values = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    image = field_image(new_figure().subplots(), x, y, values, "viridis", "label")
    np.testing.assert_array_equal(image.get_array(), [[1, 3, 5], [2, 4, 6]])
    assert image.origin == "lower" and image.get_extent() == pytest.approx([-3.0, 3.0, -2.5, 7.5])
    assert "x (µm), along the motion" == image.axes.get_xlabel() and "y (µm)" in image.axes.get_ylabel()


def test_the_picture_of_a_contact_holds_its_fields(figures, solved):
    prepared, point = solved
    plot_contact("x.png", drawn_contact(prepared, point))
    above, section = figures[0].axes[:2]
    (image,) = above.images
    label = next(axes.get_ylabel() for axes in figures[0].axes if "pressure" in axes.get_ylabel())
    unit = {"contact pressure (GPa)": 1e9, "contact pressure (MPa)": 1e6}[label]
    np.testing.assert_allclose(image.get_array(), point.pressure.T / unit)
    assert 1 <= image.get_array().max() < 1000  # a unit that fits the data
    row = int(np.argmax(point.pressure.max(axis=0)))
    dotted = [line.get_ydata()[0] for line in above.lines if line.get_linestyle() == ":"]
    assert dotted == pytest.approx([1.7 * row])
    half = 1e6 * np.sqrt(8 * 5.5 / 6e-3 * 2e-3 / (np.pi * 231e9))
    dashed = sorted(line.get_xdata()[0] for line in above.lines if line.get_linestyle() == "--")
    assert dashed == pytest.approx([-half, half])
    x, film = data(section, "film of smooth surfaces under $F_H$")
    np.testing.assert_allclose(film, 1e9 * point.balance.film.film_at(x * 1e-6))
    _, surface = data(section, "rough surface, undeformed")
    np.testing.assert_allclose(surface, 1e9 * (prepared.surface.heights[:, row] - prepared.surface.heights.mean()))
    _, under = data(section, "counterface")
    _, deformed = data(section, "rough surface, deformed")
    np.testing.assert_allclose(under - deformed, 1e9 * point.gap[:, row], atol=1e-6)
    assert "(nm)" in section.get_ylabel()
    low, high = section.get_ylim()
    assert high < 1.6e9 * max(point.heights.max(), point.balance.film.film_thickness.min()) and low > -1e3


@pytest.mark.parametrize(("rows", "is_deterministic"), [(16, True), (30, True), (16, False), (24, False)])
def test_a_picture_of_a_wide_contact_is_not_blank(laid_out, rows, is_deterministic):
    """Panels and their labels fill the height: maps of 64 cells along x by 16, 24 and 30."""
    x = 1e-6 * (np.arange(64) - 31.5)
    field = 1e6 + np.random.default_rng(1).random((64, rows))
    names = ("heights", "pressure", "gap", "deflection", "film", "shear")
    fields = ContactFields(
        solve="a strip",
        x=x,
        y=1e-6 * np.arange(rows),
        **dict.fromkeys(names, field),
        pressure_includes_film=is_deterministic,
    )
    plot_contact(
        "x.png",
        DrawnContact(speed=1.0, half_width=2e-5, fields=fields, has_film=not is_deterministic),
    )
    (figure,) = laid_out
    figure.draw_without_rendering()
    filled = np.zeros(1000, bool)
    for axes in figure.axes:
        box = axes.get_tightbbox()
        filled[slice(*np.clip(1000 * np.array([box.y0, box.y1]) / figure.bbox.height, 0, 1000).astype(int))] = True
    maps = [axes for axes in figure.axes if axes.images]
    width = max(axes.get_window_extent().width for axes in maps)
    assert filled.mean() > 0.75 and width > 0.6 * figure.bbox.width


def test_the_picture_of_a_contact_in_python_has_the_hertz_strip_too(solved):
    axes = solved[1].plot_contact(new_figure().subplots())
    dashed = sorted(line.get_xdata()[0] for line in axes.lines if line.get_linestyle() == "--")
    half = 1e6 * np.sqrt(8 * 5.5 / 6e-3 * 2e-3 / (np.pi * 231e9))
    assert dashed == pytest.approx([-half, half])


def test_the_picture_of_a_contact_in_python_has_no_empty_sides(solved):
    """A figure of its own is as wide as the map to scale needs."""
    axes = solved[1].plot_contact()
    figure = axes.get_figure()
    figure.canvas.draw()
    box = axes.get_tightbbox()
    assert box.x0 < 0.12 * figure.bbox.width
    plt.close(figure)


@pytest.fixture
def kept(solved, tmp_path):
    """A folder with the fields of a contact, as a run writes them."""
    (prepared, point) = solved
    (tmp_path / "fields.npz").write_bytes(fields_bytes([point], prepared.scene.bodies.half_width))
    return tmp_path


@pytest.mark.parametrize("width", ["85 mm", "180 mm"])
def test_a_contact_is_drawn_again_from_its_file(laid_out, solved, kept, monkeypatch, width):
    """With the same numbers, at the width of a journal's column, and all texts within it."""
    monkeypatch.setattr("lubfric.output.plot_again.made", lambda name, draw: draw(name) or b"a picture")
    assert main(["plot", str(kept), "--contact", "0.01", "--width", width, "--format", "pdf"]) == 0
    assert (kept / "contact_at_0.01.pdf").read_bytes() == b"a picture"
    plot_contact("x.png", drawn_contact(*solved))
    (again, first) = laid_out
    pictures = [figure.axes[0].images[0].get_array() for figure in laid_out]
    np.testing.assert_array_equal(*pictures)
    for label in ("counterface", "rough surface, deformed"):
        np.testing.assert_array_equal(data(again.axes[1], label), data(first.axes[1], label))
    assert again.get_figwidth() == pytest.approx(float(width.split()[0]) / 25.4)
    again.canvas.draw()
    assert again.bbox.padded(1).contains(*again.get_tightbbox().transformed(again.dpi_scale_trans).min)
    assert again.bbox.padded(1).contains(*again.get_tightbbox().transformed(again.dpi_scale_trans).max)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--contact", "0.3"], "has the fields at 0.01 m/s"),
        (["--contact", "0.01", "--panels", "gap"], "is for a contact by the deterministic model"),
        (["--contact", "0.01", "--interval", "bars"], "omit one of them"),
        (["--contact", "0.01", "--without", "warnings"], "allowed: 'title'"),
        (["--contact", "fast"], "--contact"),
    ],
)
def test_a_contact_that_cannot_be_drawn_again_is_refused(kept, capsys, options, said):
    assert main(["plot", str(kept), *options]) == 2
    assert said in capsys.readouterr().err and not list(kept.glob("contact*"))


@pytest.mark.parametrize("content", [None, b"PK\x03\x04 and no more", b"text"])
def test_fields_that_are_damaged_or_missing_are_refused(tmp_path, capsys, content):
    if content is not None:
        (tmp_path / "fields.npz").write_bytes(content)
    assert main(["plot", str(tmp_path), "--contact", "0.01"]) == 2
    assert "run 'lubfric run' again" in capsys.readouterr().err


def test_the_picture_of_the_roughness_is_the_beginning_of_a_long_line(figures, solved):
    """Of several strips beside each other the beginning of the first, which has no seam."""
    for prepared, rows in ((solved[0], 32), (lubfric.prepare(lubfric.load_scene("paper")), 103)):
        plot_surface("x.png", prepared)
        (image,) = figures[-1].axes[0].images
        count = prepared.sample.first_strips
        drawn = prepared.sample.strip(0) if count > 1 else prepared.surface
        assert (f"the first of {count} strips" in image.axes.get_title()) == (count > 1)
        part = 1e9 * drawn.heights[:, :rows]
        np.testing.assert_allclose(image.get_array(), (part - part.mean()).T, atol=1e-9)
        assert f"Sq = {part.std():.4g} nm" in image.axes.get_title() and image.axes.get_aspect() == 1.0
        (share, height) = figures[-1].axes[1].lines[0].get_data()
        z = prepared.surface.heights
        assert np.mean(1e9 * (z - z.mean()) > height[100]) == pytest.approx(share[100] / 100, abs=2 / z.size)


def test_fields_are_written_the_right_way_round(solved):
    prepared, point = solved
    with np.load(io.BytesIO(fields_bytes([point], 4e-6))) as kept:
        for name in ("heights", "pressure", "gap", "deflection", "film", "shear"):
            np.testing.assert_array_equal(kept[f"{name}_0"], getattr(point.fields, name))
        assert np.diff(kept["x_0"]) == pytest.approx(1.1e-6) and np.diff(kept["y_0"]) == pytest.approx(1.7e-6)
        assert kept["speed"] == [0.01] and "load sharing" in str(kept["solve_0"])
        np.testing.assert_array_equal(kept["film_pressure_0"], point.balance.film.pressure)
    x = np.array([0.0, 1.0, 2.0])
    y = np.array([10.0, 20.0])
    values = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
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
    assert "sampling_standard_error" in units and "sampling_error" not in units  # others are half of a 95 % interval
    old = csv_bytes(curve).replace(b"sampling_standard_error", b"sampling_error")
    assert list(read_table("old.csv", old)) == list(read_table("new.csv", csv_bytes(curve))) and b"standard" not in old
    assert units == {name: UNITS.get(name, "-") for name in units} and {*UNITS} <= {*units}
    for name in ("speed", "coefficient", "film_load", "couette_force", "rolling_force", "min_film", "central_film"):
        column = heading.index(f"{name} [{units[name]}]")
        assert [float(row[column]) for row in rows] == [getattr(point, name) for point in curve.points]


def test_a_study_over_two_keys_is_drawn_and_written_along_its_axes(figures, tmp_path):
    smooth = SCENE.with_(surface={"sq": 0.0, "correlation_length": 8e-6})
    study = lubfric.study(smooth, {"lubricant.viscosity": [0.2, 0.4]}, [1.0, 2.0, 4.0])
    curves = (lubfric.stribeck(smooth.with_(lubricant={"viscosity": v}), [1.0, 2.0, 4.0]) for v in (0.2, 0.4))
    f = np.array([curve.coefficient for curve in curves])
    for (across, up), expected in zip((("speed", "lubricant.viscosity"), ("lubricant.viscosity", "speed")), (f, f.T)):
        plot_map(tmp_path / "x.png", study, across, up)
        axes = figures[-1].axes[0]
        assert axes.get_xlabel().endswith({"speed": "(m/s)"}.get(across, "(mPa s)"))
        assert axes.get_ylabel().endswith({"speed": "(m/s)"}.get(up, "(mPa s)"))
        np.testing.assert_array_equal(axes.images[0].get_array(), expected)  # few values are no contours
        ticks = [[float(tick.get_text()) for tick in axis.get_ticklabels()] for axis in (axes.xaxis, axes.yaxis)]
        assert ticks == [{"speed": [1.0, 2.0, 4.0]}.get(key, [200.0, 400.0]) for key in (across, up)]
    study.to_csv(tmp_path / "study.csv")
    with (tmp_path / "study.csv").open() as file:
        names = "lubricant.viscosity [Pa s]", "speed [m/s]", "coefficient [-]"
        rows = [[float(row[name]) for name in names] for row in csv.DictReader(file)]
    assert rows == [[eta, u, f[i, j]] for i, eta in enumerate((0.2, 0.4)) for j, u in enumerate((1.0, 2.0, 4.0))]


def test_many_curves_have_a_bar_of_colours_and_few_a_key():
    smooth = SCENE.with_(surface={"sq": 0.0, "correlation_length": 8e-6})
    for loads in ([2.0, 5.0], np.linspace(2.0, 5.0, 12).tolist()):
        study = lubfric.study(smooth, {"bodies.load": loads}, [1.0, 2.0])
        axes = study.plot(new_figure().subplots())
        lines = [line for line in axes.lines if line.get_xdata().size == 2]
        assert len(lines) == len(loads)
        for line, f in zip(lines, study["coefficient"]):
            np.testing.assert_array_equal(line.get_ydata(), f)
        key = [] if axes.get_legend() is None else [text.get_text() for text in axes.get_legend().get_texts()]
        bars = [bar.get_ylabel() for bar in axes.figure.axes[1:]]
        few = len(loads) == 2
        assert (key, bars) == ((["total load 2 N", "total load 5 N"], []) if few else ([], ["total load (N)"]))


def test_at_rest_no_friction_is_drawn(figures):
    t = np.array([0.0, 0.01, 0.02, 0.03])
    zero = 0 * t
    columns = {"time": t, "entrainment_speed": np.array([0.1, 0.0, 0.0, 0.1]), "load": zero + 5.0}
    columns["sliding_speed"] = 2 * columns["entrainment_speed"]
    columns |= dict.fromkeys(("central_film", "min_film", "mean_gap"), zero + 1e-7)
    columns |= {"contact_load": zero + 1.0, "coefficient": np.array([0.05, 0.0, 0.0, 0.04])}
    columns |= dict.fromkeys(("boundary_force", "couette_force", "rolling_force"), zero)
    plot_history("x.png", columns, "title")
    np.testing.assert_array_equal(data(figures[0].axes[3], "friction coefficient")[1], [0.05, np.nan, np.nan, 0.04])


def test_points_with_warnings_are_ringed_also_where_all_are(figures):
    entry = SimpleNamespace(severe=False, is_note=False, assumption="", what="starved")
    columns = COLUMNS | {"ratio": COLUMNS["speed"]}
    plot_traction("x.png", columns, "title", [(entry,)] * 4)
    solved = np.isfinite(COLUMNS["coefficient"])
    np.testing.assert_array_equal(data(figures[0].axes[0], "with warnings")[0], np.sort(COLUMNS["speed"][solved]))
    below = "Assumptions of the model that the marked points do not fulfil (see the warnings): starved"
    assert figures[0].get_supxlabel() == below
    cold = dict.fromkeys(("flash_temperature_rise", "film_temperature_rise"), 0 * COLUMNS["speed"])
    plot_traction("x.png", columns | cold, "title", [()] * 4)
    assert len(figures[1].axes) == 3  # no panel of temperatures where none rises


def test_a_spike_does_not_take_the_colours_of_a_map_and_is_reported():
    surface = lubfric.generate_surface((60, 60), 1e-6, sq=1e-7, correlation_length=4e-6, seed=1)
    heights = surface.heights.copy()
    heights[5, 7] = 5e-6
    axes = lubfric.Surface(heights, surface.spacing).plot(new_figure().subplots())
    low, high = axes.images[0].get_clim()
    assert -500 < low < -200 and 200 < high < 500 and "highest 499" in axes.get_title()
    assert axes.get_aspect() == 1.0  # to scale
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x (µm)", "y (µm)")  # no motion is chosen
    low, high = surface.plot(axes.figure.subplots()).images[0].get_clim()
    z = 1e9 * (surface.heights - surface.heights.mean())
    assert (low, high) == pytest.approx((z.min(), z.max()), rel=0.2)


def test_a_picture_for_a_paper_is_a_vector_graphic(tmp_path):
    scene = tmp_path / "s.toml"
    scene.write_text(SCENE.with_(motion={"entrainment_speed": 0.1}, numerics={"model": "paper"}).to_toml())
    out = tmp_path / "out"
    main(["run", str(scene), "--speeds", "0.1,1", "--out", str(out)])
    plot = ["plot", str(out), "--panels", "friction"]
    for kind, begin in (("pdf", b"%PDF"), ("svg", b"<?xml")):
        assert main([*plot, "--format", kind, "--width", "85 mm"]) == 0
        assert (out / f"stribeck.{kind}").read_bytes().startswith(begin)
    assert b"/Type3" not in (out / "stribeck.pdf").read_bytes()  # letters that journals reject
    assert "friction coefficient" in (out / "stribeck.svg").read_text()  # letters, not their outlines
    for options, dots in ((["--width", "85 mm"], 300), (["--width", "85 mm", "--dpi", "600"], 600), ([], 150)):
        assert main([*plot, *options]) == 0
        width = 85 / 25.4 if "--width" in options else 7.0
        assert int.from_bytes((out / "stribeck.png").read_bytes()[16:20], "big") == pytest.approx(width * dots, abs=1)
    assert (
        main(["plot", str(out), "--dpi", "9"]) == 2 and main(["plot", str(out), "--dpi", "99", "--format", "pdf"]) == 2
    )
    main(["run", str(scene), "--speeds", "0.1,1", "--out", str(out)])  # a new run removes what is no longer its own
    assert not (out / "stribeck.pdf").exists() and (out / "stribeck.png").exists()


def test_a_narrow_picture_has_smaller_lines_and_markers():
    """For a journal's column: lines, markers and those of the key, and in the usual width the style's own."""
    sizes = {}
    for width in (0.085, 0.178):
        figure = Figure()
        axes = figure.subplots()
        axes.plot([1, 2], [1, 2], "o-", ms=4, lw=2, label="f")
        axes.legend()
        PictureOptions(width=width).thin(figure)
        lines = (axes.lines[0], axes.get_legend().get_lines()[0])
        sizes[width] = [(line.get_markersize(), line.get_linewidth()) for line in lines]
    assert sizes[0.178] == [(4, 2), (4, 2)]
    assert all(0 < small < large for pairs in zip(sizes[0.085], sizes[0.178]) for small, large in zip(*pairs))


def test_the_model_form_error_is_drawn_with_both_its_sides():
    axes = new_figure().subplots()
    f = np.array([0.1, 0.1])
    columns = {"coefficient": f, "interval_low": 0.6 * f, "interval_high": 1.9 * f, "model_error": np.array([0.8, 0.8])}
    columns |= {"model_error_low": np.array([0.3, 0.3]), "model_error_high": np.array([0.8, 0.8])}
    interval_band(axes, np.array([1.0, 2.0]), columns)
    low, high = (line.get_ydata() for line in axes.lines[:2])
    assert low == pytest.approx(0.07) and high == pytest.approx(0.18)


def test_the_sampling_error_is_drawn_at_95_percent_of_students_t():
    """t is 2.776 with four degrees of freedom, and 4.303 with two (any table)."""
    axes = new_figure().subplots()
    f = np.array([0.1, 0.1])
    columns = {"coefficient": f, "interval_low": 0.4 * f, "interval_high": 1.6 * f}
    columns |= {"sampling_error": np.array([0.1, 0.1]), "sampling_freedom": np.array([4, 2])}
    interval_band(axes, np.array([1.0, 2.0]), columns)
    assert axes.lines[1].get_ydata() == pytest.approx([0.12776, 0.14303], rel=1e-3)


def test_marks_of_warnings_and_lines_of_parts_are_left_out_where_requested(figures):
    """The rings, the text below and the lines of single errors go; what f means nothing at stays crossed out."""
    entry = SimpleNamespace(severe=False, is_note=False, assumption="", what="starved")
    severe = SimpleNamespace(severe=True, is_note=False, assumption="", what="turbulent")
    columns = COLUMNS | {"model_error": np.array([0.02, 0.02, np.nan, 0.02])}
    violations = [(entry,), (), (), (severe,)]
    for options in (PictureOptions(), PictureOptions(has_warnings=False, has_parts=False, has_title=False)):
        plot_stribeck("x.png", columns, "title", violations, options=options)
    labels = [{line.get_label() for line in figure.axes[0].lines} for figure in figures]
    assert {"with warnings", "model-form error alone"} <= labels[0] and "starved" in figures[0].get_supxlabel()
    assert not {"with warnings", "model-form error alone"} & labels[1] and "starved" not in figures[1].get_supxlabel()
    assert all("outside the model (accepted)" in each for each in labels)
    assert [figure.get_suptitle() for figure in figures] == ["title", ""]


def test_a_note_is_not_marked(figures):
    note = SimpleNamespace(severe=False, is_note=True, what="numerical error")
    plot_stribeck("x.png", COLUMNS, "title", [(note,), (), (), ()])
    assert "with warnings" not in {line.get_label() for line in figures[0].axes[0].lines}
    assert figures[0].get_supxlabel() == ""


def test_a_long_title_lies_within_a_narrow_picture(laid_out):
    options = PictureOptions(width=0.085)
    plot_stribeck(
        "x.png",
        COLUMNS,
        "a deterministic model on long cells, calibrated on 295 solved cases",
        [()] * 4,
        options=options,
    )
    (figure,) = laid_out
    figure.canvas.draw()
    box = figure._suptitle.get_window_extent()
    assert figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1


def test_key_and_text_leave_a_narrow_diagram_its_height(laid_out):
    warning = SimpleNamespace(severe=False, is_note=False, assumption="surfaces fast enough for the heat " * 6, what="")
    options = PictureOptions(width=0.085, panels=("friction",), y_scale="log")
    plot_stribeck("x.png", COLUMNS, "title", [[warning]] * 4, options=options)
    (figure,) = laid_out
    figure.canvas.draw()
    assert figure.axes[0].get_window_extent().height / figure.dpi > 1.1  # inch, of a panel of 2.4


def test_two_numbers_that_are_varied_are_told_apart_in_the_picture_of_a_study(figures):
    """Of many curves: colour by the first number, marker and dashes by the second, which the key names."""
    vary = {"bodies.load": [2.0, 3.0, 4.0, 5.0], "surface.sq": [5e-8, 1e-7, 1.5e-7]}
    study = lubfric.study(SCENE.with_(numerics={"model": "paper"}), vary, [0.02, 0.1])
    axes = study.plot(new_figure().subplots())
    curves = [line for line in axes.lines if len(line.get_xdata())]
    assert len({(line.get_marker(), str(line.get_color())) for line in curves}) == len(curves) == 12
    assert len({line.get_marker() for line in curves}) == 3
    assert {"50 nm", "100 nm", "150 nm"} <= {line.get_label().rpartition("Sq = ")[2] for line in axes.lines}


def test_a_curve_without_intervals_says_so():
    speed = np.geomspace(0.01, 1.0, 3)
    f = np.array([0.09, 0.05, 0.02])
    unknown = np.full(3, np.nan)
    axes = new_figure().subplots()
    interval_band(axes, speed, {"coefficient": f, "interval_low": unknown, "interval_high": unknown})
    assert axes.get_legend_handles_labels()[1] == ["95 % interval not known"]
    assert not axes.collections
    (sample,) = axes.patches
    assert sample.get_edgecolor()[3] == 1.0 and not sample.get_fill()


def test_few_values_of_a_study_are_named_and_many_are_read_off_a_bar():
    """Each curve has the colour of its load in the key, none of them too light for white."""
    scene = paper_scene(numerics={"sampling": "patch", "model": "paper", "contact_tolerance": 1e-3})
    loads = [3.0, 4.0, 9.0]
    study = lubfric.study(scene, {"bodies.load": loads, "lubricant.viscosity": [0.1, 0.2, 0.3, 0.4]}, [0.1, 0.3])
    axes = new_figure().subplots()
    study.plot(axes)
    assert len(axes.figure.axes) == 1
    handles = dict(zip(*reversed(axes.get_legend_handles_labels())))
    colours = [to_rgb(handles[f"total load {load:g} N"].get_color()) for load in loads]
    drawn = {to_rgb(line.get_color()) for line in axes.lines if len(line.get_xdata()) == 2}
    assert drawn == set(colours) and len(drawn) == 3
    assert max(0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in colours) < 0.8


@pytest.mark.parametrize("shape", [(64, 20), (20, 64), (40, 40)])
@pytest.mark.parametrize("place, along", [("right", "y"), ("top", "x")])
def test_a_bar_of_colours_is_as_long_as_its_map(shape, place, along):
    """A map that is to scale is smaller than its place, in which the bar was drawn; ends for clipped values lie beyond
    it."""
    figure = new_figure(figsize=(7, 4), layout="constrained")
    axes = figure.subplots(1, 2)[0]
    values = np.arange(float(np.prod(shape))).reshape(shape)
    field_image(axes, *(np.arange(count) * 1e-6 for count in shape), values, "viridis", "label", place=place)
    figure.draw_without_rendering()
    (bar,) = figure.axes[2:]
    drawn, of_map = (each.get_position() for each in (bar, axes))
    for end in (f"{along}0", f"{along}1"):
        assert getattr(drawn, end) == pytest.approx(getattr(of_map, end), abs=1e-6)
    gap = drawn.x0 - of_map.x1 if place == "right" else drawn.y0 - of_map.y1
    assert 0 < gap < 0.1


@pytest.mark.parametrize("width", [0.178, 0.085])
def test_a_picture_of_a_contact_has_no_empty_band(tmp_path, solved, width):
    """Of the pixels: white rows at the edges are less than 4 mm high, and between the panels less than 8 % of the
    picture."""
    (prepared, point) = solved
    plot_contact(tmp_path / "c.png", drawn_contact(prepared, point), PictureOptions(width=width, dpi=60))
    pixels = imread(tmp_path / "c.png")[..., :3].min(axis=2)
    rows = np.flatnonzero((pixels < 0.98).any(axis=1))
    height = pixels.shape[0]
    assert max(rows[0], height - 1 - rows[-1]) * 25.4 / 60 < 4.0
    assert np.diff(rows).max() < 0.08 * height


@pytest.mark.parametrize("renamed", [False, True])
def test_a_record_of_version_0_2_0_is_read(tmp_path, renamed):
    """Its violations have "remedy" in place of a recommendation, and none of the fields that came later; others are
    refused."""
    old = {"what": "film pressure", "value": 1.2, "limit": 1.0, "unit": "GPa", "consequence": "why", "severe": False}
    old |= {"advice" if renamed else "remedy": "less"}
    record = {"scene": {"name": "old"}, "points": [{"validity": [old]}]}
    (tmp_path / "result.json").write_text(json.dumps(record))
    if renamed:
        with pytest.raises(lubfric.InputError, match="damaged, or no record of a run"):
            read_record(tmp_path)
        return
    (point,) = read_record(tmp_path)["points"]
    assert point["validity"][0]["recommendation"] == "less"
