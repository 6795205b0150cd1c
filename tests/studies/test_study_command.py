"""``lubfric study``: files written, study files read strictly, exit codes, broken streams, interrupts."""

import csv
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH
from scipy.stats import t as student
from small_study import SCENE as SMALL
from small_study import made_study, violations_at

import lubfric
from lubfric import studies
from lubfric._base.progress import report_progress
from lubfric.models.shared import violations_by_numerical_error
from lubfric.output import (
    main,
    run_study,
    status,
    study_answer,
    study_inputs,
    study_pictures,
    study_report,
    study_warnings,
)
from lubfric.studies import result as study_result
from lubfric.units import plain_number

ROOT = Path(__file__).parents[2]
SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.001\n" + SMALL_PATCH
STUDY = """
scene = "small.toml"
speed_range = [0.03, 0.3, 2]
[vary]
bodies.load = [3.0, 5.5]
[[together]]
"surface.seed" = [1, 2]
surface.sq = [1e-7, 1.2e-7]
"""


def written(folder, study=STUDY):
    (folder / "small.toml").write_text(SCENE)
    (folder / "study.toml").write_text(study)
    return str(folder / "study.toml")


def command(*arguments, **options):
    environment = os.environ | {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    return subprocess.Popen([sys.executable, "-m", "lubfric", *map(str, arguments)], env=environment, **options)


def test_a_study_file_is_carried_out(tmp_path, capsys, drawn):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().err
    assert (
        "8 points" in said
        and "[8/8]" in said
        and "wrote references.bib, report.html, resolved.toml, resolved_study.toml" in said
    )
    assert re.search(r"in [\d.]+ s of wall-clock time \([\d.]+ s of processor time", " ".join(said.split()))
    result = lubfric.open_study(tmp_path / "out")
    scene = lubfric.load_scene(tmp_path / "small.toml")
    pairs = [(1, 1e-7), (2, 1.2e-7)]
    again = lubfric.study(
        scene, {"bodies.load": [3.0, 5.5], ("surface.seed", "surface.sq"): pairs}, np.geomspace(0.03, 0.3, 2)
    )
    f = result["coefficient"]
    np.testing.assert_array_equal(f, again["coefficient"])
    for word, value in (("smallest", f.min()), ("largest", f.max())):  # at the end, with its place
        (row,) = (row for row in said.splitlines() if row.startswith(f"The {word} friction coefficient is"))
        assert float(row.split(" is ")[1].split()[0].rstrip(",")) == pytest.approx(value, rel=0.05)
        load, seed, speed = (axis[i] for axis, i in zip(((3, 5.5), (1, 2), (0.03, 0.3)), np.argwhere(f == value)[0]))
        assert f": total load {load:g} N, seed {seed}, " in row and row.endswith(f"speed {speed:g} m/s.")
    assert (tmp_path / "out" / "study.png").read_bytes().startswith(b"\x89PNG")
    rows = (tmp_path / "out" / "study.csv").read_text().splitlines()
    assert len(rows) == 9 and rows[0].startswith("bodies.load [N],surface.seed,surface.sq [m],speed [m/s],")
    assert not [p for p in (tmp_path / "out").rglob("*") if p.name.startswith(".part")]
    assert studies.load_study(tmp_path / "out" / "resolved_study.toml").keys == result.plan.keys


def test_a_study_of_which_no_point_can_be_solved_is_refused_before_any_work(tmp_path, capsys):
    """A generated surface without contact.shape; one point that can be solved is reason enough to go on."""
    (tmp_path / "small.toml").write_text(re.sub("shape = .*", "", SMALL.to_toml()))
    (tmp_path / "loads.csv").write_text("load [N],speed [m/s]\n3,0.1\n5.5,0.3\n")
    command = ["study", str(tmp_path / "small.toml"), "--points", str(tmp_path / "loads.csv")]
    assert main([*command, "--out", str(tmp_path / "out")]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "no point of the study can be solved: contact.shape" in said and "[1/2]" not in said
    assert not (tmp_path / "out").exists()
    spacings = SMALL.contact.spacing, 1e-4
    some = lubfric.plan_study(SMALL, {"contact.spacing": spacings}, [0.3])
    assert "cannot be solved" in studies.explained(some, refuses=True)[0]


@pytest.mark.parametrize(
    "vary, lines",
    [({}, 3), ({"bodies.load": [3.0, 5.5]}, 8), ({"bodies.load": [3.0, 5.5], "surface.seed": [1, 2]}, 9)],
)
def test_a_study_of_one_speed_is_drawn_over_what_is_varied(tmp_path, vary, lines):
    """Its answer has the errors of the largest f, and of one point its numbers in one line, else the extremes, why they
    are at different points, and what the load changes at each seed."""
    result = lubfric.study(SMALL, vary, [0.3])
    study_pictures.plot_study(tmp_path / "study.png", result)
    assert (tmp_path / "study.png").stat().st_size > 5000 and len(study_answer.answer_lines(result)) == lines


SLIP = lubfric.Violation(what="slip", value=3.0, limit=5.0, unit="", consequence="why", recommendation="")


def numbered(vary, coefficient):
    """A study of SMALL at one speed with made numbers, f by ``coefficient`` of what is varied."""
    plan = lubfric.plan_study(SMALL, vary, [0.3])
    f = np.empty(plan.shape)
    for place, scene in zip(np.ndindex(f.shape), plan.scenes):
        f[place] = coefficient(scene)
    names = list(lubfric.study(SMALL, {}, [0.3]).columns)
    columns = dict.fromkeys(names, np.zeros(f.shape)) | {"coefficient": f, "film_load": np.ones(f.shape)}
    return made_study(plan, columns)


def test_shares_of_the_variance_are_those_of_a_product_of_powers(tmp_path):
    loads = [1.0, 2.0, 4.0, 8.0]
    viscosities = [0.1, 0.2, 0.4]
    vary = {"bodies.load": loads, "lubricant.viscosity": viscosities}
    result = numbered(vary, lambda scene: scene.bodies.load**-1.0 * scene.lubricant.viscosity**0.5)
    parts = {"bodies.load": np.var(np.log(loads)), "lubricant.viscosity": np.var(np.log(viscosities)) / 4}
    effects = studies.main_effects(result)
    assert list(effects) == list(parts) and [effect.slope for effect in effects.values()] == [-1, 1]
    for key, effect in effects.items():
        assert effect.share == pytest.approx(parts[key] / sum(parts.values()), rel=1e-12)
    (line,) = (line for line in study_answer.answer_lines(result) if "variance" in line)
    assert (
        "total load 88 % (on average f falls with it); viscosity at ambient pressure 12 % (on average f rises with it)."
        in line
    )
    page = study_report.study_page(result, {}, []).decode()
    assert "Films, pressure, temperature, and parts of the error" in page
    largest = int(np.nanargmax(np.abs(result["coefficient"]))) + 1
    assert f"<h3>Effects not modelled, at point {largest} (largest f)</h3>" in page
    unknown = result.columns | {"film_temperature_rise": np.full(result.status.shape, np.nan)}
    cold = study_report.study_page(replace(result, columns=unknown), {}, []).decode()
    assert "up to threefold" in page and "up to threefold" not in cold  # how well the rises are known, beside them
    hertz = re.findall(r'data-label="peak Hertz pressure[^>]*>([0-9.]+) MPa|>([0-9.]+) MPa<', page)
    assert len(hertz) == 12


@pytest.mark.parametrize("error, reached", [(0.0, False), (0.02, False), (1e3, True)])
def test_shares_have_the_range_that_the_errors_of_f_leave(error, reached):
    """None without errors. Of numbers that are errors alone, k values of an input in n points explain (k - 1)/(n - 1)
    on average."""
    vary = {"bodies.load": [1.0, 2.0, 4.0, 8.0], "lubricant.viscosity": [0.1, 0.2, 0.4]}
    result = numbered(vary, lambda scene: scene.bodies.load**-1.0 * scene.lubricant.viscosity**0.5)
    errors = {"sampling_error": np.full(result.status.shape, error)}
    effects = studies.main_effects(replace(result, columns=result.columns | errors))
    for effect, by_chance in zip(effects.values(), (3 / 11, 2 / 11)):
        low, high = effect.interval
        assert low <= effect.share <= high and (low < high) == (error > 0)
        assert (low < by_chance < high) == reached
    wide = replace(result, columns=result.columns | errors | {"model_error": np.full(result.status.shape, np.nan)})
    assert np.isnan([effect.interval for effect in studies.main_effects(wide).values()]).all()
    assert "with its range" not in "".join(study_answer.answer_lines(wide))


def test_the_range_of_a_share_is_on_both_sides_of_it_and_contains_that_without_errors():
    """Errors add a variance of their own, by which the shares of disturbed points are too small."""
    vary = {"bodies.load": [1.0, 2.0, 4.0, 8.0], "lubricant.viscosity": [0.1, 0.2, 0.4, 0.8]}
    result = numbered(vary, lambda scene: scene.bodies.load**-1.0 * scene.lubricant.viscosity**0.5)
    true = 0.8  # of ln 2 over two steps of 1 and 0.5
    errors = {"sampling_error": np.full(result.status.shape, 0.3)}
    held = []
    for draw in np.random.default_rng(1).standard_normal((20, *result.status.shape)):
        columns = result.columns | errors | {"coefficient": result["coefficient"] * np.exp(0.3 * draw)}
        effect = studies.main_effects(replace(result, columns=columns))["bodies.load"]
        low, high = effect.interval
        assert low < effect.share < high
        held.append(low <= true <= high)
    assert np.mean(held) >= 0.9


@pytest.mark.parametrize(
    "column, error, way", [("model_error", 4.0, "a model with"), ("sampling_error", 2.0, "a smaller")]
)
def test_parts_are_not_known_where_errors_exceed_the_differences_of_f(column, error, way):
    """ln f varies by a factor of 8; errors of f of its own size leave any part to each input, and more points do, too."""
    vary = {"bodies.load": [1.0, 2.0, 4.0, 8.0], "lubricant.viscosity": [0.1, 0.2, 0.4, 0.8]}
    result = numbered(vary, lambda scene: scene.bodies.load**-1.0 * scene.lubricant.viscosity**0.5)
    zero = np.zeros(result.status.shape)
    columns = result.columns | {"numerical_error": zero, "model_error": zero, "sampling_error": zero}
    columns["sampling_freedom"] = zero + 30.0
    texts = []
    for size in (0.001, error):
        wide = replace(result, columns=columns | {column: zero + size})
        texts.append(next(line for line in study_answer.answer_lines(wide) if "variance of ln f" in line))
    assert "not known" not in texts[0]
    assert "Most of these parts are not known, because the errors of f" in texts[1] and f"{way} " in texts[1]


def test_inputs_that_vary_together_have_no_shares_of_their_own():
    pairs = [(load, load / 10) for load in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)]
    result = numbered({("bodies.load", "lubricant.viscosity"): pairs}, lambda scene: scene.bodies.load)
    assert not studies.main_effects(result)


def test_shares_of_a_table_of_points_are_those_of_its_columns():
    """Loads and speeds in all combinations, as rows; the place of a point is no input."""
    pairs = [(load, speed) for load in (1.0, 2.0, 4.0) for speed in (0.1, 0.2, 0.4)]
    rows = [{"load [N]": load, "speed [m/s]": speed, "position [m]": load} for load, speed in pairs]
    plan = lubfric.plan_study(SMALL, points=rows)
    f = np.array([load**-1.0 * speed**0.5 for load, speed in pairs])
    columns = lubfric.study(SMALL, {}, [0.3]).columns
    columns = dict.fromkeys(columns, np.zeros(f.shape)) | {"coefficient": f}
    result = made_study(plan, columns)
    effects = studies.main_effects(result)
    assert list(effects) == ["bodies.load", "speed"]
    assert [effect.share for effect in effects.values()] == pytest.approx([0.8, 0.2])
    assert "finite number of points" not in " ".join(study_answer.answer_lines(result))


def drawn_designs(repeated):
    """Points that are designs, P = F Sq², a sample of 64 and so many rows at one roughness and load."""
    sample = lubfric.sample([lubfric.Between(1.0, 8.0, "log"), lubfric.Between(5e-8, 2e-7, "log")], 64)
    rows = [*sample, *[(4.0, 7e-8)] * repeated]
    table = {"load [N]": [row[0] for row in rows], "surface.sq": [row[1] for row in rows], "speed": [0.1] * len(rows)}
    plan = lubfric.plan_study(SMALL, points=table)
    columns = lubfric.study(SMALL, {}, [0.3]).columns
    columns = {name: np.full(len(rows), values.item()) for name, values in columns.items()}
    loss = np.array([load * (1e7 * sq) ** 2 for load, sq in rows])
    ends = {"power_loss": loss, "power_loss_low": 0.99 * loss, "power_loss_high": 1.01 * loss}
    return made_study(plan, columns | ends)


def test_rows_that_repeat_a_design_leave_no_effect_of_an_input():
    """ln P varies by (ln 8)² of the load, and by (2 ln 4)² of the roughness."""
    parts = np.array([np.log(8), 2 * np.log(4)]) ** 2
    effects = studies.main_effects(drawn_designs(0), "power_loss")
    assert [effects[key].share for key in ("bodies.load", "surface.sq")] == pytest.approx(parts / parts.sum(), abs=0.02)
    repeated = drawn_designs(16)
    assert not studies.main_effects(repeated, "power_loss")
    assert "16 points share one value of" in studies.why_not_separated(repeated, "power_loss")


def test_points_that_are_designs_are_compared_as_a_whole():
    result = drawn_designs(0)
    (one,) = result.best("power_loss")
    assert one.row == int(result["power_loss"].argmin()) + 1 and set(one.design) == {"bodies.load", "surface.sq"}
    said = " ".join(study_answer.answer_lines(result))
    assert "mean power loss" not in said
    assert said.count("The points differ in total load too, so that none of them is the best design.") == 1
    assert said.count("do not include the error by the finite number of points") == 1
    smooth = lubfric.plan_study(SMALL, points={"surface.sq": [5e-8, 1e-7], "load": [4.0, 4.0], "speed": [0.1, 0.1]})
    columns = {name: values[:2] for name, values in result.columns.items()}
    assert "is lowest at point" in (text := " ".join(study_answer.answer_lines(made_study(smooth, columns))))
    assert "best design" not in text
    with pytest.raises(lubfric.InputError, match="result.best"):
        result.best_mean("power_loss")
    with pytest.raises(lubfric.InputError, match="no law over other inputs is offered"):
        result.law()
    with pytest.raises(lubfric.InputError, match="vary no design"):
        lubfric.study(SMALL, points={"load": [3.0, 4.0], "speed": [0.1, 0.2]}).best()


def test_a_grade_that_is_varied_is_no_common_input():
    graded = SMALL.with_(lubricant={"grade": "ISO VG 46", "viscosity_index": 95, "temperature_celsius": 60})
    page = study_inputs.common_inputs(
        lubfric.plan_study(graded, {"lubricant.grade": ["ISO VG 46", "ISO VG 100"]}, [0.3])
    )
    assert "ISO VG" not in page
    assert "ISO VG 46" in study_inputs.common_inputs(lubfric.plan_study(graded, {"bodies.load": [1.0, 2.0]}, [0.3]))


def test_common_inputs_are_shown_as_given_and_an_estimate_is_named(tmp_path):
    """Ra and the viscosities at 40 and 100 °C as the user wrote them, and the estimated coefficient with its range; not
    the load that is varied, nor an Ra in place of which Sq is varied."""
    oil = '[lubricant]\nnu40 = "66 mm2/s"\nnu100 = "11.6 mm2/s"\ntemperature = "100 °C"\n'
    rough = '[surface]\nra = "0.3 µm"\ncorrelation_length = "10 µm"\n'
    bodies = (
        "[bodies]\nradius = 0.02\nload = 400\nwidth = 0.012\nmaterial = 'steel'\nboundary_friction_coefficient = 0.1\n"
    )
    (tmp_path / "scene.toml").write_text(f"{bodies}{oil}[motion]\nentrainment_speed = 1\n{rough}")
    (tmp_path / "study.toml").write_text("scene = 'scene.toml'\nspeeds = [1.0]\n[vary]\n'bodies.load' = [1.0, 2.0]\n")
    given = studies.given_tables_of_study(tmp_path / "study.toml")
    page = study_inputs.common_inputs(studies.load_study(tmp_path / "study.toml"), given)
    given_as = [
        f"{key} = &quot;{value}&quot;"
        for key, value in (("nu40", "66 mm2/s"), ("nu100", "11.6 mm2/s"), ("ra", "0.3 µm"))
    ]
    assert all(text in page for text in (*given_as, "measured oils 11 to 18.1 /GPa"))
    assert "load = 400" not in page and "<h3>transient" not in page
    rougher = lubfric.plan_study(lubfric.load_scene(tmp_path / "scene.toml"), {"surface.sq": [1e-7, 2e-7]}, [1.0])
    assert "ra = " not in study_inputs.common_inputs(rougher, given)
    warmer = {"lubricant.temperature": [300.0, 350.0]}
    of_warmer = study_inputs.common_inputs(lubfric.plan_study(rougher.scene, warmer, [1.0]), given)
    assert "nu40 = " in of_warmer and "mPa s" not in of_warmer and "temperature = " not in of_warmer


@pytest.mark.parametrize(
    "values, is_log",
    [
        ([1, 2, 4, 8], True),
        ([1, 2, 3, 4], False),
        ([1, 1.5, 2], False),
        ([2, 30], False),
        ([1, 10, 19, 28], False),
        ([1, 3, 28], True),
    ],
)
def test_numbers_that_are_spaced_by_factors_have_a_logarithmic_axis(values, is_log):
    axes = study_pictures.figures.new_figure().subplots()
    study_pictures.figures.log_if_wide(axes, "x", np.array(values, dtype=float))
    assert (axes.get_xscale() == "log") == is_log


# More keys of a study than its picture has panels.
EXTRA = {"surface.sq": 1e-7, "lubricant.viscosity": 0.2, "bodies.boundary_friction_coefficient": 0.1}


def test_points_of_a_picture_have_the_numbers_of_the_report(tmp_path, monkeypatch):
    drawn = []
    new_figure = study_pictures.figures.new_figure
    monkeypatch.setattr(
        study_pictures.figures, "new_figure", lambda *a, **k: drawn.append(new_figure(*a, **k)) or drawn[-1]
    )
    vary = {"bodies.load": [3.0, 2.0], "numerics.heat": ["off", "auto"]}
    result = numbered(vary, lambda scene: scene.bodies.load + (scene.numerics.heat == "auto"))
    study_pictures.plot_study(tmp_path / "study.png", result)
    (axes,) = drawn[-1].axes
    lines = [line for line in axes.lines if not line.get_label().startswith("_")]
    for line, heat, f in zip(lines, ("off", "auto"), ([2, 3], [3, 4]), strict=True):
        assert line.get_label() == f"heat {heat}"
        np.testing.assert_array_equal(line.get_xydata(), np.transpose([[2, 3], f]))
    keys = ["bodies.load", "numerics.heat", *(f"bodies.{name}" for name in ("radius", "width", "hardness", "e_prime"))]
    values = [3.0, "off", 2e-3, 1e-3, 6e9, 2e11]
    more = {
        tuple([*keys, *EXTRA]): [
            tuple([*values, *EXTRA.values()]),
            tuple([2.0, "auto", *(1.1 * v for v in (*values[2:], *EXTRA.values()))]),
        ]
    }
    study_pictures.plot_study(tmp_path / "study.png", numbered(more, lambda scene: scene.bodies.load))
    (axes,) = drawn[-1].axes
    np.testing.assert_array_equal(axes.lines[-1].get_xydata(), [[1, 3], [2, 2]])
    assert "study.csv" in " ".join(axes.get_xlabel().split())


def test_explain_solves_nothing(tmp_path, capsys):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out"), "--explain"]) == 0
    assert "8 points" in capsys.readouterr().out and not (tmp_path / "out").exists()


@pytest.mark.parametrize("change, words", [(("speed_range", "speed_rnage"), "did you"), (("small", "smal"), "smal")])
def test_bad_study_files_are_one_line(tmp_path, capsys, change, words):
    assert main(["study", written(tmp_path, STUDY.replace(*change)), "--out", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1 and not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "solved, missing, words",
    [(1, 8, "1 point is kept in out, 8 points are left"), (8, 1, "8 points are kept in out, 1 point is left")],
)
def test_the_points_that_are_kept_are_counted_in_words(monkeypatch, solved, missing, words):
    study = SimpleNamespace(solved=solved, missing=missing, chosen=False)
    monkeypatch.setattr("lubfric.studies.open_study", lambda folder: study)
    assert run_study._kept(Path("out")) == words


@pytest.mark.parametrize(
    "sent, code", [(signal.SIGINT, 130), pytest.param(signal.SIGTERM, 143, marks=pytest.mark.slow)]
)
def test_an_interrupt_is_one_line_and_the_command_goes_on(tmp_path, sent, code):
    many = STUDY.replace("[3.0, 5.5]", str([3.0 + 0.001 * i for i in range(300)]))
    path = written(tmp_path, many)
    out = tmp_path / "out"
    process = command("study", path, "--out", out, "--workers", 2, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not any(path.stat().st_size for path in out.glob(f"points/{'?' * 40}.bin")):
        time.sleep(0.05)
    process.send_signal(sent)
    said = process.communicate()[1].splitlines()
    assert process.returncode == code and "kept in" in said[-1] and "continues from there" in said[-1], said
    assert not any("Traceback" in line for line in said)
    result = lubfric.open_study(out)
    assert 0 < result.missing < result.status.size


@pytest.mark.parametrize("arguments", [["--workers", "0"], ["--workers", str(2**70)], ["--out", "/dev/null/x"]])
def test_bad_options_are_one_line(tmp_path, capsys, arguments):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out"), *arguments]) == 2
    assert capsys.readouterr().err.splitlines()[-1].startswith("lubfric: ")


def test_a_table_that_cannot_be_written_is_reported_before_any_point(tmp_path, monkeypatch, capsys):
    from lubfric import studies

    monkeypatch.setitem(sys.modules, "xarray", None)
    monkeypatch.setattr(studies, "study", lambda *a, **k: pytest.fail("solved"))
    (tmp_path / "study.toml").write_text('scene = "paper"\nspeeds = [0.01]\n[vary]\n"bodies.load" = [5.5]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--netcdf", "--out", str(tmp_path / "out")]) == 2
    assert "needs the package xarray" in capsys.readouterr().err


def test_how_far_a_point_of_a_study_is_reaches_the_user(tmp_path, monkeypatch):
    """As at a point of a curve (`tests/output/test_cli.py`)."""
    seen = []

    def stopped(*_, **__):
        report_progress("moving roughness", 3, 10)
        raise lubfric.InputError("enough")

    monkeypatch.setattr(run_study, "moment_reports", lambda: lambda *said: seen.append(said))
    monkeypatch.setattr("lubfric.studies.study", stopped)
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "study.toml").write_text('scene = "scene.toml"\n[vary]\n"bodies.load" = [4.0, 5.0]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]) == 2
    assert seen == [("moving roughness", 3, 10)]


def test_the_picture_of_a_study_is_drawn_again_for_a_journal(tmp_path, drawn):
    """As wide as asked, in the folder of the study; options of a curve are refused by name."""
    (tmp_path / "s.toml").write_text(SMALL.to_toml())
    (tmp_path / "study.toml").write_text('scene = "s.toml"\nspeeds = [0.03, 0.3]\n[vary]\nbodies.load = [3.0, 5.5]\n')
    out = tmp_path / "out"
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(out)]) == 0
    before = (out / "study.png").read_bytes()
    assert main(["plot", str(out), "--width", "85 mm", "--without", "title", "--format", "svg"]) == 0
    head = (out / "study.svg").read_text(encoding="utf-8")[:2000]
    width = float(re.search(r'width="([\d.]+)pt"', head)[1])
    assert width == pytest.approx(85 / 25.4 * 72, rel=1e-3)
    assert main(["plot", str(out), "--name", "again"]) == 0
    assert (out / "again.png").read_bytes() == before == (out / "study.png").read_bytes()
    assert main(["plot", str(out), "--panels", "load"]) != 0


MISSED = "sampling error of f at 95 % is"


def test_points_that_miss_the_sampling_tolerance_are_named_once(tmp_path, capsys):
    """On the console and in the report together, in study.csv each by itself: those whose error is above it."""
    scene = SMALL.with_(
        contact={"shape": (48, 96)}, surface={"correlation_length": 2.5e-6}, numerics={"sampling_tolerance": 1e-3}
    )
    (tmp_path / "small.toml").write_text(scene.to_toml())
    (tmp_path / "s.toml").write_text('scene = "small.toml"\nspeeds = [0.1, 1.0]\n[vary]\nbodies.load = [3.0, 5.5]\n')
    assert main(["study", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) == 0
    above = lubfric.open_study(tmp_path / "out")["sampling_error"].ravel() > 1.05e-3
    where = f"At point{'s' if above.sum() > 1 else ''} {' and '.join(str(i + 1) for i in np.flatnonzero(above))}"
    said, page = capsys.readouterr().err, (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    with (tmp_path / "out" / "study.csv").open(encoding="utf-8") as table:
        cells = [row["validity"] for row in csv.DictReader(table)]
    assert [MISSED in cell for cell in cells] == above.tolist() and 0 < above.sum() < above.size
    for text in (said, page):
        words = " ".join(text.split())
        assert words.count(f"{where}: {MISSED}") == words.count(f": {MISSED}") == 1


def test_points_that_miss_the_numerical_tolerance_are_named_on_the_console():
    result = numbered({"bodies.load": [1.0, 2.0, 3.0]}, lambda scene: 0.1)
    (note,) = violations_by_numerical_error(0.07, 0.05, "less")
    violations = violations_at(result.status.shape, (), (note,), (note,))
    (line,) = study_warnings.tolerance_lines(replace(result, violations=violations))
    assert line.startswith("At points 2 and 3: estimated numerical error of f is 7 %, above 5 %.")
    assert "study.csv" not in line
    many = numbered({"bodies.load": np.linspace(1.0, 2.0, 40).tolist()}, lambda scene: 0.1)
    every_second = violations_at(many.status.shape, *[(), (note,)] * 20)
    (line,) = study_warnings.tolerance_lines(replace(many, violations=every_second))
    assert "At 20 of 40 points: " in line and line.endswith("column validity of study.csv has all of them.")


def test_the_tables_of_a_report_have_the_films():
    """In one unit each: the lambda ratio in the first table, which fits a window, and the films in the folded one."""
    result = numbered({"bodies.load": [1.0, 2.0]}, lambda scene: 0.1)
    films = {"central_film": [2e-7, 3e-7], "min_film": [1.1e-7, 1.2e-7], "lambda_ratio": [0.7, 0.8]}
    columns = {name: np.reshape(values, result.status.shape) for name, values in films.items()}
    page = study_report.study_page(replace(result, columns=result.columns | columns), {}, []).decode()
    first, folded = (table for table in re.findall(r"<table.*?</table>", page, re.DOTALL) if ">no.</th>" in table)
    shown = {}
    for text in first, folded:
        heads = re.findall(r"<th[^>]*>([^<]*)</th>", text)
        rows = re.findall(r"<tr>(.*?)</tr>", text, re.DOTALL)
        cells = [re.findall(r"<td[^>]*>([^<]*)</td>", row) for row in rows if "<td" in row]
        shown |= dict(zip(heads, zip(*cells)))
        assert ("lambda ratio" in heads) == (text is first)
    assert shown["central separation [nm]"] == ("200", "300") and shown["lambda ratio"] == ("0.7", "0.8")
    assert shown["smallest film thickness [nm]"] == ("110", "120")


def with_columns(result, **columns):
    """A study with other numbers in some columns."""
    shape = result.status.shape
    return replace(result, columns=result.columns | {name: np.reshape(v, shape) for name, v in columns.items()})


def test_a_status_names_the_tolerances_that_are_missed_and_by_how_much():
    """Of numerical, sampling (at 95 %, by Student's t) and model-form error; the box has the colour of a warning
    then."""
    plain = numbered({"bodies.load": [1.0, 2.0, 3.0]}, lambda scene: 0.1)
    kind = re.compile(r'<p class="status (\w*)" role="status">(.*?)</p>')
    assert kind.findall(study_report.study_page(plain, {}, []).decode()) == [
        ("", "Converged: all 3 points are solved.")
    ]
    numerics = SMALL.numerics
    missed = with_columns(
        plain,
        numerical_error=numerics.tolerance * np.array([0.9, 1.5, 3.0]),
        sampling_error=numerics.sampling_tolerance * np.array([1.0, 2.0, 1.0]),
        sampling_freedom=[4.0, 4.0, 4.0],
    )
    ((colour, text),) = kind.findall(study_report.study_page(missed, {}, []).decode())
    t = student.ppf(0.975, 4)
    at_95 = [f"{100 * t * n * numerics.sampling_tolerance:.2g} %" for n in (2, 1)]
    assert colour == "inexact" and text == (
        "Converged: all 3 points are solved. At 2 of 3 points the numerical error of f is above its tolerance, "
        "farthest at point 3: "
        f"{300 * numerics.tolerance:.2g} %, above {100 * numerics.tolerance:.2g} % (numerics.tolerance). At point 2 "
        "the sampling "
        f"error of f at 95 % is {at_95[0]}, above {at_95[1]} (the standard error "
        f"numerics.sampling_tolerance = {numerics.sampling_tolerance:g}, at 95 %). The interval of f includes these errors."
    )
    chosen = lubfric.plan_study(SMALL.with_(numerics={"model": "auto"}), {"bodies.load": [1.0, 2.0, 3.0]}, [0.3])
    of_model = with_columns(replace(plain, plan=chosen), model_error=[0.01, 0.3, 0.3], limit_error=[0.0, 0.299, 0.18])
    ((colour, text),) = kind.findall(study_report.study_page(of_model, {}, []).decode())
    assert colour == "inexact" and "At point 3 the model-form error of f is 24 %, above 5 %" in text


def test_a_study_states_both_sides_of_the_parts_of_an_interval():
    """In the sentence of the largest f and in the table of every point; f and its interval have a column each."""
    plain = numbered({"bodies.load": [1.0, 2.0]}, lambda scene: 0.05 * scene.bodies.load)
    sides = {"model_error": [0.1, 0.2], "model_error_low": [0.1, 0.05], "model_error_high": [0.1, 0.2]}
    result = with_columns(plain, interval_low=[0.04, 0.09], interval_high=[0.06, 0.13], **sides)
    (line,) = (line for line in study_answer.answer_lines(result) if "relative errors of the largest f" in line)
    assert "model-form -5 to +20 %" in line
    page = study_report.study_page(result, {}, []).decode()
    rows = [re.findall(r"<td[^>]*>([^<]*)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", page)]
    heads = re.findall(r"<th[^>]*>([^<]*)</th>", page.split("<h2>Operating points</h2>")[1])
    place = heads.index("95 % interval of f")
    assert heads[place - 1] == "friction coefficient"
    (first, last) = [row for row in rows if len(row) > place and row[place - 1].startswith(("0.05", "0.10"))]
    assert first[place - 1 : place + 1] == ["0.050", "0.040 to 0.060"] and last[place] == "0.090 to 0.130"
    assert any("-5 to +20 %" in row for row in rows) and any(row.count("10 %") == 1 for row in rows)


def test_texts_of_a_study_are_gathered_once_for_console_and_report(monkeypatch):
    cells = []
    gather = study_result.gathered_in_table
    monkeypatch.setattr(study_result, "gathered_in_table", lambda texts: cells.append(texts) or gather(texts))
    result = numbered({"bodies.load": [1.0, 2.0]}, lambda scene: 0.1)
    result = replace(result, violations=violations_at(result.status.shape, *[(SLIP,)] * 2))
    page = study_report.study_page(result, {}, []).decode()
    assert "slip is 3" in page and study_warnings.warning_lines(result) and study_warnings.tolerance_lines(result) == []
    assert len(cells) == 1
    assert not study_warnings.warning_lines(replace(result, violations=violations_at(result.status.shape)))


@pytest.mark.parametrize("model_tolerance", [1e-3, 1.0])
def test_console_report_and_table_count_the_same_warnings_and_notes(tmp_path, model_tolerance):
    """The model-form error of a model that the scene names is a note in all three, where it is above its target."""
    scene = SMALL.with_(numerics={"model": "paper", "model_tolerance": model_tolerance})
    result = lubfric.study(scene, {"bodies.load": [3.0, 5.0]}, [0.1, 0.3, 2.0])
    result.to_csv(tmp_path / "study.csv")
    with open(tmp_path / "study.csv", newline="") as file:
        cells = [row["validity"] for row in csv.DictReader(file)]
    notes = sum("note: " in cell for cell in cells)
    warnings = sum("warning: " in cell for cell in cells)
    above = result["model_error"].ravel() > model_tolerance
    assert ["note: model-form error of f is" in cell for cell in cells] == above.tolist()
    assert above.any() == (model_tolerance < 1)
    counts = f"arnings at {warnings} of 6 points{f', notes at {notes} ' if notes else '; '}"
    (head, *_) = study_warnings.warning_lines(result) or ["warnings at 0 of 6 points; "]
    page = study_report.study_page(result, {}, []).decode()
    assert counts in head and warnings == result.with_warnings
    assert ("model-form error of f is above its tolerance" in status.study_in_words(result)) == above.any()
    assert any("model-form" in line for line in study_warnings.tolerance_lines(result)) == above.any()
    assert (counts in page) == bool(warnings or notes)


def test_a_note_that_is_a_warning_at_another_point_is_in_its_text_alone():
    """A note of its own has its list."""
    result = numbered({"bodies.load": [1.0, 2.0, 3.0]}, lambda scene: 0.1)
    (other,) = violations_by_numerical_error(0.07, 0.05, "less")
    at_points = ((SLIP,), (replace(SLIP, is_note=True),), (other,))
    result = replace(result, violations=violations_at(result.status.shape, *at_points))
    (warning,) = study_warnings.numbered_warnings(result)
    assert warning.numbers == (1,) and warning.text.endswith(" At point 2 this is a note.")
    (note,) = study_warnings.notes_without_warning(result)
    assert note.startswith("At point 3: estimated numerical error")
    page = study_report.study_page(result, {}, []).decode()
    assert page.count("slip is 3") == 1 and "Notes (1)" in page


def test_points_that_share_a_reason_are_one_line_with_the_worst():
    """On the console, and numbered in the report, where each row of the table has the numbers of its warnings."""
    result = numbered({"bodies.load": np.linspace(1.0, 2.0, 40).tolist()}, lambda scene: 0.1)
    pressures = [1.2 + 0.01 * n for n in range(40)]
    known = {"limit": 1.0, "unit": "GPa", "consequence": "why", "recommendation": "less"}
    warnings = [lubfric.Violation(what="film pressure", value=pressure, **known) for pressure in pressures]
    at_points = [(warning, SLIP) if n in (4, 7) else (warning,) for n, warning in enumerate(warnings)]
    result = replace(result, violations=violations_at(result.status.shape, *at_points))
    head, *lines = study_warnings.warning_lines(result)
    assert head.startswith("warnings at 40 of 40 points; study.csv")
    assert [line.strip() for line in lines] == [
        "at points 1 to 40: film pressure is 1.2 to 1.59 GPa (at point 40), above 1 GPa",
        "at points 5 and 8: slip is 3, below 5",
    ]
    page = study_report.study_page(result, {}, []).decode()
    (listed,) = re.findall(r"<h2>Warnings</h2>\s*<p>Warnings at 40 of 40 points;[^<]*</p><ol>(.*?)</ol>", page)
    assert listed.count("<li>") == 2 and "The last column of this table has the numbers of the warnings above." in page
    body = page.split("<h2>Operating points</h2>")[1].split("</table>")[0]
    rows = [re.findall(r">([^<]*)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", body)[1:]]
    assert [row[-1] for row in rows] == ["1, 2" if n in (4, 7) else "1" for n in range(40)]


def test_a_reason_that_many_points_fail_for_is_said_once(capsys):
    plan = lubfric.plan_study(SMALL, {"bodies.load": np.linspace(1.0, 2.0, 12).tolist()}, [0.3])
    report = run_study._point_reports(plan, time.perf_counter())
    for n in range(12):
        report(n + 1, 12, (n, 0), lubfric.InputError("no spacing" if n != 5 else "no load"))
    said = " ".join(capsys.readouterr().err.split())
    assert said.count("no spacing") == said.count("no load") == 1
    assert said.count("failed for the same reason as point 1 (") == 10


def test_a_study_without_a_solved_point_has_a_report(tmp_path, capsys, monkeypatch):
    def fail(*_, **__):
        raise lubfric.InputError("no film")

    monkeypatch.setattr("lubfric.studies.points.friction", fail)
    (tmp_path / "s.toml").write_text(SMALL.to_toml())
    (tmp_path / "study.toml").write_text('scene = "s.toml"\nspeeds = [0.1]\n[vary]\nbodies.load = [3.0, 5.5]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]) == 1
    said = capsys.readouterr().err
    assert "was not written" not in said and "2 of 2 points failed" in said
    assert "Not complete: 0 of 2 points solved" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_an_unfinished_study_is_drawn_as_far_as_it_is(tmp_path, drawn, capsys):
    """Even while it runs, which locks its folder; the finished one then takes its usual place."""
    (tmp_path / "s.toml").write_text(SMALL.to_toml())
    (tmp_path / "study.toml").write_text('scene = "s.toml"\nspeeds = [0.03, 0.3]\n[vary]\nbodies.load = [3.0, 5.5]\n')
    out = tmp_path / "out"
    plan = studies.load_study(tmp_path / "study.toml")

    def stop(done, total, index, outcome):
        if done == 3:
            assert main(["plot", str(out)]) == 0
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        lubfric.study(plan, store=out, on_point=stop)
    assert "the study is not finished: 3 of 4 points are solved" in capsys.readouterr().err
    assert (out / "so_far" / "study.png").is_file() and not (out / "study.png").exists()
    result = lubfric.open_study(out)
    assert study_pictures.solved_so_far(result) == "3 of 4 points are solved"
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(out)]) == 0
    assert main(["plot", str(out)]) == 0
    said = capsys.readouterr().err
    assert (out / "study.png").is_file() and "not finished" not in said
    assert not (out / "so_far").exists()
    together = float(lubfric.open_study(out)["seconds"].sum())  # also of the points that the first call solved
    times = f"each as it was solved: {plain_number(together, 's')}. Points that earlier calls solved: 3."
    assert all(times in " ".join(text.split()) for text in (said, (out / "report.html").read_text(encoding="utf-8")))


def test_a_study_without_a_point_is_not_drawn(tmp_path, drawn, capsys):
    plan = lubfric.plan_study(SMALL, {"bodies.load": [3.0, 5.5]}, [0.3])
    with studies.opened(tmp_path / "out") as store:
        store.add("plan", tuple(getattr(plan, name) for name in studies.result.PLAN_FIELDS))
    assert main(["plot", str(tmp_path / "out")]) == 2
    assert "has a study without a solved point so far" in " ".join(capsys.readouterr().err.split())


def test_an_interrupt_while_the_report_is_written_states_what_is_kept(tmp_path, capsys, monkeypatch):
    """The points are in the store, and no file is there; then the same command writes all of them without a solve."""
    path = written(tmp_path, 'scene = "small.toml"\nspeeds = [0.3]\n')
    out = tmp_path / "out"

    def stop(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as interrupted:
        interrupted.setattr(run_study, "study_page", stop)
        assert main(["study", path, "--out", str(out)]) == 130
    said = " ".join(capsys.readouterr().err.split())
    assert f"interrupted; the solved points are kept in {out}, and of the tables and the report no file is" in said
    assert said.endswith("the same command continues from there") and not (out / "study.csv").exists()
    assert lubfric.open_study(out).missing == 0
