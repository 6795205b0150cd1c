"""Operating points in pairs: each row of a table is the point of its own scene, whatever the table is made of."""

import csv
import re
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE, made_study, same

import lubfric
from lubfric.output import films_in_words, main
from lubfric.output.rolling_part import cells_of_rolling
from lubfric.output.status import status_of_study
from lubfric.output.study_answer import answer_lines
from lubfric.output.study_inputs import common_inputs, range_in_a_line
from lubfric.output.study_report import study_page
from lubfric.output.study_tables import why_no_rises
from lubfric.output.study_warnings import counts_of_warnings
from lubfric.studies import load_study, places_without_sliding, plot_points
from lubfric.units import with_interval

ROWS = [  # radius m, load N, u1, u2 m/s, duration s
    (4e-3, 3.0, 0.02, 0.01, 1.0),
    (5e-3, 5.0, 0.015, 0.015, 2.0),
    (4.5e-3, 4.0, 0.01, 0.02, 1.0),
]
CSV = "# gear\nposition [mm];radius [mm];load [N];u1 [mm/s];u2 [mm/s];duration [min]\n" + "\n".join(
    f"{i - 1};{1e3 * r:g};{f:g};{1e3 * a:g};{1e3 * b:g};{t / 60!r}" for i, (r, f, a, b, t) in enumerate(ROWS)
)


def expected():
    """The points one by one, each by its own scene and speed."""
    scenes = [
        SCENE.with_(bodies={"radius": r, "load": f}, motion={"slide_roll_ratio": (b - a) / (0.5 * (a + b))})
        for r, f, a, b, _ in ROWS
    ]
    return [lubfric.friction(scene, 0.5 * (a + b)) for scene, (_, _, a, b, _) in zip(scenes, ROWS)]


@pytest.fixture(scope="module")
def points():
    return expected()


@pytest.fixture(scope="module")
def result():
    columns = dict(zip(("radius", "load", "u1", "u2", "duration"), zip(*ROWS)))
    return lubfric.study(SCENE, points=columns | {"position": [-1e-3, 0.0, 1e-3]})


def test_every_row_is_the_point_of_its_scene(result, points):
    assert result.dims == ("point",) and result["coefficient"].shape == (3,)
    for name in ("coefficient", "power_loss", "contact_load", "central_film"):
        np.testing.assert_allclose(result[name], [getattr(p, name) for p in points], rtol=1e-12)
    np.testing.assert_allclose(result["power_loss_high"], [p.power_loss_interval[1] for p in points], rtol=1e-12)


def test_where_nothing_slides_the_power_is_the_resistance_of_both_surfaces(result):
    """Point 2 rolls without slip: P = (F_1 + F_2) U. Its f counts in no mean and no smallest f, and a sentence says
    so."""
    assert result["power_loss"][1] == pytest.approx(result["rolling_resistance"][1] * 0.015, rel=1e-12)
    assert result.mean("coefficient") == pytest.approx(result["coefficient"][[0, 2]].mean(), rel=1e-12)
    assert np.argmin(np.abs(result["coefficient"])) == 1
    lines = answer_lines(result)
    assert not any(
        "Nothing slides" in line or "smallest friction coefficient" in line and "at point 2" in line for line in lines
    )
    assert any(line.startswith("At point 2 rolling resistance makes most of f") for line in lines)
    rolling = lubfric.study(SCENE.with_(motion={"slide_roll_ratio": 0.0}), points={"speed": [0.01, 0.1]})
    assert rolling.mean("coefficient") == pytest.approx(rolling["coefficient"].mean(), rel=1e-12)
    (text,) = [line for line in answer_lines(rolling) if "smallest f" in line]
    assert "rolling resistance of both surfaces" in text


def test_the_mean_of_a_cycle_weighs_by_the_duration(result, points):
    energy = sum(point.power_loss * row[-1] for point, row in zip(points, ROWS))
    assert result.mean("power_loss") == pytest.approx(energy / 4.0, rel=1e-12)
    plain = lubfric.study(SCENE, points={"speed": [0.01, 0.1]})
    assert plain.mean("power_loss") == pytest.approx(plain["power_loss"].mean(), rel=1e-12)


def test_all_forms_of_a_table_are_the_same_points(result, tmp_path):
    (tmp_path / "gear.csv").write_text(CSV)
    frame = pytest.importorskip("pandas").DataFrame(
        {"radius [mm]": [1e3 * row[0] for row in ROWS], "bodies.load": [row[1] for row in ROWS]}
        | {"motion.entrainment_speed": [0.5 * (row[2] + row[3]) for row in ROWS]}
        | {"sliding_speed": [row[3] - row[2] for row in ROWS]}
    )
    rows = [
        {"radius": f"{1e3 * r!r} mm", "load": f, "speed": f"{500 * (a + b)!r} mm/s", "srr": (b - a) / (0.5 * (a + b))}
        for r, f, a, b, _ in ROWS
    ]
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    listed = "\n".join(
        f"[[points]]\nradius = '{1e3 * r!r} mm'\nbodies.load = {f}\nu1 = {a}\nu2 = {b}" for r, f, a, b, _ in ROWS
    )
    (tmp_path / "study.toml").write_text(f'scene = "scene.toml"\n{listed}\n')
    (tmp_path / "named.toml").write_text('scene = "scene.toml"\npoints = "gear.csv"\n')
    plans = [
        lubfric.plan_study(SCENE, points=table)
        for table in (tmp_path / "gear.csv", str(tmp_path / "gear.csv"), frame, rows)
    ]
    plans += [load_study(tmp_path / name) for name in ("study.toml", "named.toml")]
    plans += [load_study(tmp_path / "scene.toml", points=tmp_path / "gear.csv")]
    for plan in plans:
        np.testing.assert_allclose(plan.point_speeds, result.plan.point_speeds, rtol=1e-12)
        for scene, other in zip(plan.scenes, result.plan.scenes):
            assert scene.bodies.radius == pytest.approx(other.bodies.radius, rel=1e-12)
            assert scene.bodies.load == other.bodies.load
            ratios = scene.motion.slide_roll_ratio, other.motion.slide_roll_ratio
            assert ratios[0] == pytest.approx(ratios[1], rel=1e-9, abs=1e-12)
    durations = plans[0].coordinates["duration"]
    np.testing.assert_allclose(durations, [row[-1] for row in ROWS], rtol=1e-12)


def test_the_radii_of_both_flanks_give_the_reduced_radius(tmp_path):
    flanks = [(5.0, 33.0), (20.0, 20.0), (8.0, -24.0)]  # mm; the last is a pinion in a ring gear
    expected = [1e-3 * a * b / (a + b) for a, b in flanks]
    first, second = ([pair[side] for pair in flanks] for side in (0, 1))
    (tmp_path / "gear.csv").write_text("R1 [mm];R2 [mm]\n" + "\n".join(f"{a};{b}" for a, b in flanks))
    tables = [
        tmp_path / "gear.csv",
        {"R1 [mm]": first, "R2 [mm]": second},
        {"r1": [f"{radius} mm" for radius in first], "r2": [1e-3 * radius for radius in second]},
        {"radii [mm]": flanks},
        {"bodies.radii": [[1e-3 * radius for radius in pair] for pair in flanks]},
    ]
    for table in tables:
        plan = lubfric.plan_study(SCENE, points=table)
        np.testing.assert_allclose([scene.bodies.radius for scene in plan.scenes], expected, rtol=1e-12)
        np.testing.assert_allclose(plan.coordinates["R1"], 1e-3 * np.array(first), rtol=1e-12)
    plane = lubfric.plan_study(SCENE, points={"R1 [mm]": [5.0], "R2 [mm]": [float("inf")]})
    assert plane.scenes[0].bodies.radius == 5e-3
    (tmp_path / "pairs.csv").write_text('radii [mm],load [N]\n"[5, 33]",3\n')
    with pytest.raises(lubfric.InputError, match="give both R1 and R2.* in place of radii"):
        lubfric.plan_study(SCENE, points=tmp_path / "pairs.csv")


def test_temperatures_of_rows_move_the_viscosity(tmp_path):
    oil = {"lubricant.nu40": 68e-6, "lubricant.nu100": 8.6e-6, "lubricant.temperature": 313.15}
    scene = SCENE.with_keys(oil)
    (tmp_path / "t.csv").write_text("speed [m/s],temperature [°C]\n0.1,40\n0.1,100\n")
    for table in (tmp_path / "t.csv", {"speed": [0.1, 0.1], "temperature [K]": [313.15, 373.15]}):
        cold, hot = (one.lubricant.viscosity for one in lubfric.plan_study(scene, points=table).scenes)
        assert cold == pytest.approx(scene.lubricant.viscosity, rel=1e-9) and hot < 0.2 * cold


def test_a_column_of_names_is_that_of_a_table_in_python(tmp_path):
    oil = SCENE.with_(lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 60})
    columns = {
        "lubricant.grade": ["ISO VG 32", "ISO VG 68"],
        "bodies.boundary_friction_coefficient": ["anti-wear", 0.1],
    }
    rows = "\n".join(f"{grade},{friction},0.1" for grade, friction in zip(*columns.values()))
    (tmp_path / "t.csv").write_text(f"{','.join(columns)},speed [m/s]\n{rows}\n")
    keys = [
        lubfric.plan_study(oil, points=table).keys for table in (tmp_path / "t.csv", columns | {"speed": [0.1] * 2})
    ]
    assert keys[0] == keys[1]
    repeated = {
        "lubricant.grade": ["ISO VG 68", "ISO VG 32", "ISO VG 32", "ISO VG 32", "ISO VG 68"],
        "speed": [0.1] * 5,
    }
    plan = lubfric.plan_study(oil, points=repeated)
    assert "5 x lubricant.grade ISO VG 68, ISO VG 32; speed" in plan.explain()
    assert range_in_a_line("lubricant.grade", np.array([*"abbbbba"])) == "grade: a, b"
    (tmp_path / "t.csv").write_text("load [N],speed [m/s]\nheavy,0.1\n")
    with pytest.raises(lubfric.InputError, match="'heavy' is not a number"):
        lubfric.plan_study(oil, points=tmp_path / "t.csv")


def test_other_values_are_varied_beside_the_points():
    result = lubfric.study(
        SCENE, {"bodies.boundary_friction_coefficient": [0.05, 0.1]}, points=[{"speed": 0.01}, {"speed": 0.1}]
    )
    assert result.dims == ("bodies.boundary_friction_coefficient", "point") and result["coefficient"].shape == (2, 2)
    other = lubfric.study(SCENE, {"bodies.boundary_friction_coefficient": [0.05, 0.1]}, [0.01, 0.1])
    np.testing.assert_array_equal(result["coefficient"], other["coefficient"])
    assert result.mean("coefficient").shape == (2,)
    for call in (result.law, lambda: result.lift_off, lambda: result.at(0.05)):
        with pytest.raises(lubfric.InputError, match="operating points|a law is over"):
            call()


def test_rows_that_repeat_are_solved_once_and_a_cut_study_goes_on(tmp_path, monkeypatch):
    table = {"speed": [0.01, 0.1, 0.01], "load": [3.0, 3.0, 3.0]}
    first = lubfric.study(SCENE, points=table, store=tmp_path)
    assert len(list((tmp_path / "points").rglob("*.bin"))) == 3  # two points, and the plan
    assert first["coefficient"][0] == first["coefficient"][2]
    monkeypatch.setattr("lubfric.studies.points.outcome_of", None)
    same(lubfric.study(SCENE, points=table, store=tmp_path), first)
    same(lubfric.open_study(tmp_path), first)


@pytest.mark.parametrize(
    "table, words",
    [
        ({}, "no columns"),
        (3, "a file, a list of rows"),
        ({"speed": [0.1, 0.2], "load": [1.0]}, "different lengths"),
        ([{"speed": 0.1}, {"load": 1.0}], "row 1: load is missing"),
        ({"sped": [0.1]}, "'sped' is not a column of operating points .did you mean 'speed'"),
        ({"u1": [0.1]}, "both u1 and u2"),
        ({"R1": [0.01]}, "both R1 and R2.*or radius"),
        ({"R1": [0.01], "R2": [0.02], "radius": [0.01]}, "omit radius"),
        ({"R1": [0.01, 0.01], "R2": [0.02, -0.005]}, "row 2: .*do not touch"),
        ({"R1": [10.0], "R2": [20.0]}, r"heading R1 \[mm\]"),
        ({"radii": [0.01]}, "a pair of radii in each row"),
        ({"u1": [0.1], "u2": [0.1], "speed": [0.1]}, "leave motion.entrainment_speed out"),
        ({"u1": [0.1], "u2": [-0.1]}, "row 1: .*no entrainment|row 1: no entrainment"),
        ({"sliding_speed": [0.1]}, "goes with speed"),
        ({"speed": [0.1], "motion.entrainment_speed": [0.1]}, "two columns give motion.entrainment_speed"),
        ({"temperature": [40.0]}, "names no unit"),
        ({"load [N/mm]": [40.0]}, "is in N/m; .*times the length of the line, bodies.width"),
        ({"load per length": [40.0]}, "times the length of the line, bodies.width"),
        ({"load [m]": [40.0]}, "is in m"),
        ({"load": ["3 m"]}, "is in m"),
        ({"load": [-3.0]}, "row 1: bodies.load"),
        ({"speed": ["fast"]}, "fast"),
        ({"duration": [-1.0], "speed": [0.1]}, "negative"),
        ({"speed": [float("nan")]}, "row 1: speed"),
        ({"numerics.tolerance": [3.0], "speed": [0.1]}, "numerics.tolerance"),
    ],
)
def test_what_is_no_operating_point_is_refused_by_row_and_name(table, words):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.plan_study(SCENE, points=table)


def test_points_take_the_place_of_speeds():
    with pytest.raises(lubfric.InputError, match="points and speeds both"):
        lubfric.plan_study(SCENE, speeds=[0.1], points={"speed": [0.1]})
    with pytest.raises(lubfric.InputError, match="points and vary both give bodies.load"):
        lubfric.plan_study(SCENE, {"bodies.load": [1.0]}, points={"speed": [0.1], "load": [1.0]})


def test_the_command_takes_a_scene_with_a_table_and_writes_a_report(tmp_path, capsys, points, drawn):
    (tmp_path / "gear.csv").write_text(CSV)
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    out = tmp_path / "out"
    assert main(["study", str(tmp_path / "scene.toml"), "--points", str(tmp_path / "gear.csv"), "--out", str(out)]) == 0
    with open(out / "study.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    result = [float(row["power_loss [W]"]) for row in rows]
    np.testing.assert_allclose(result, [p.power_loss for p in points], rtol=1e-9)
    np.testing.assert_allclose([float(row["position [m]"]) for row in rows], [-1e-3, 0, 1e-3], atol=1e-12)
    said = capsys.readouterr().err
    mean = sum(p.power_loss * row[-1] for p, row in zip(points, ROWS)) / 4
    ends = [float(sum(p.power_loss_interval[i] * row[-1] for p, row in zip(points, ROWS)) / 4) for i in (0, 1)]
    mean_text = with_interval(mean, *ends, unit="W")
    assert f"The mean power loss of the operating points, each point weighted by its duration, is {mean_text}" in said
    (loss,) = (line for line in said.splitlines() if line.startswith("The mean power loss"))
    assert "one tooth pair" in loss and "contact ratio if each row has the load on one pair." in loss  # over positions
    largest = max(points, key=lambda point: point.power_loss)
    largest_text = with_interval(largest.power_loss, *largest.power_loss_interval, unit="W")
    assert f"The largest power loss of the computed points is {largest_text}" in said
    page = (out / "report.html").read_text()
    assert "power loss [mW]" in page and mean_text in page and "Converged: all 3 points are solved." in page
    assert page.count("the temperature rises are not computed: the lubricant does not state how") == 1
    common = page.partition("Inputs common to all points")[2].partition("Method and sources")[0]
    assert "total load" not in common and "length of the line contact" in common  # the load is varied
    assert "data:image/png;base64" in page and (out / "study.png").stat().st_size > 10_000


def test_plain_numbers_that_may_be_in_another_unit_are_questioned_at_the_plan():
    plan = lubfric.plan_study(
        SCENE, points={"speed": [0.1, 0.2], "position": [-2.0, 2.0], "slip_percent": [0.01, 0.02]}
    )
    (position, slip) = plan.warnings()
    assert "-2 is read as -2 m" in position and "position [mm]" in position
    assert "did you mean slide_roll_ratio = 0.02, which is 2 %?" in slip
    assert all(text in plan.explain() for text in (position, slip))
    stated = {"speed": [0.1, 0.2], "position [mm]": [-2.0, 2.0], "slip_percent [%]": [0.01, 0.02]}
    assert lubfric.plan_study(SCENE, points=stated).warnings() == []
    ratios = lubfric.plan_study(SCENE, points={"speed": [0.1, 0.2], "slide_roll_ratio": [1, 1.5]})
    assert "did you mean slip_percent = 1?" in ratios.explain()
    varied = lubfric.plan_study(SCENE, {"motion.slip_percent": [0.01, 0.05]}, [0.1])
    assert "slide_roll_ratio = 0.05" in varied.explain()


def test_radii_in_mm_are_questioned_at_the_plan_before_any_solve(monkeypatch):
    monkeypatch.setattr("lubfric.studies.points.outcome_of", None)
    table = {"speed": [0.1, 0.1, 0.1], "radius [m]": [4.0, 5.0, 5e-3]}
    words = (
        "2 of 3 scenes: warning: bodies.radius is 4 to 5 m, above 1 m. Where it is largest: did you mean 5 mm (0.005 "
        "m)?"
    )
    assert words in lubfric.plan_study(SCENE, points=table).explain()
    strips = lubfric.load_scene("paper").with_(bodies={"hardness": None}, numerics={"model": "paper"})
    heavy = lubfric.plan_study(strips, {"bodies.hertz_pressure": [5e8, 2e9]}, [0.1])
    assert "highest film pressure is 2 GPa, above 1 GPa" in heavy.explain()


@pytest.mark.parametrize(
    "column, values, likely",
    [
        ("radius", [5e-3, 5.2], "radius [mm]"),
        ("bodies.radius", [5.2, 5e-3], "bodies.radius [mm]"),
        ("u1", [0.2, 1600.0], "u1 [mm/s]"),
        ("slide_roll_ratio", [0.1, 5.0], "slide_roll_ratio [%]"),
        ("surface.sq", [1e-7, 0.1], "surface.sq [µm]"),
    ],
)
def test_a_column_without_a_unit_is_refused_where_its_numbers_suit_another_unit(column, values, likely, tmp_path):
    table = {column: values} | ({"u2": [0.1, 0.1]} if column == "u1" else {"speed": [0.1, 0.1]})
    (tmp_path / "t.csv").write_text("\n".join(",".join(map(str, row)) for row in (table, *zip(*table.values()))))
    for points in (table, tmp_path / "t.csv"):
        with pytest.raises(lubfric.InputError, match=re.escape(f"write the heading {likely}")):
            lubfric.plan_study(SCENE, points=points)


def test_a_stated_unit_of_a_heading_is_taken_as_it_is():
    plan = lubfric.plan_study(SCENE, points={"speed": [0.1, 0.1], "radius [m]": [5.2, 5e-3]})
    assert [scene.bodies.radius for scene in plan.scenes] == [5.2, 5e-3]


def test_a_column_of_slip_in_percent_is_that_of_the_ratio(tmp_path):
    ratio = lubfric.plan_study(SCENE, points={"speed": [0.1, 0.2], "slide_roll_ratio": [0.02, -0.05]})
    (tmp_path / "t.csv").write_text("speed [m/s],slip_percent [%]\n0.1,2\n0.2,-5\n")
    for table in (
        {"speed": [0.1, 0.2], "slip_percent": [2, -5]},
        {"speed": [0.1, 0.2], "slip_percent": ["2 %", "-5 %"]},
        tmp_path / "t.csv",
    ):
        percent = lubfric.plan_study(SCENE, points=table)
        assert ratio.axes == percent.axes and ratio.keys == percent.keys


def test_surface_speeds_of_a_table_are_in_its_result(result):
    np.testing.assert_array_equal(result.coords["u1"][1], [row[2] for row in ROWS])
    np.testing.assert_array_equal(result.coords["u2"][1], [row[3] for row in ROWS])


def test_the_mean_friction_is_that_of_its_magnitude(points):
    durations = [row[-1] * (row[2] != row[3]) for row in ROWS]  # point 2 does not slide
    magnitude = np.average([abs(point.coefficient) for point in points], weights=durations)
    columns = dict(zip(("radius", "load", "u1", "u2", "duration"), zip(*ROWS)))
    result = lubfric.study(SCENE, points=columns)
    (text,) = [line for line in answer_lines(result) if "mean" in line and "friction" in line]
    assert float(re.search(r"is ([0-9.]*[0-9])", text)[1]) == pytest.approx(magnitude, rel=0.02)


@pytest.mark.parametrize("alpha, is_estimate", [(None, True), (2e-8, False)])
def test_the_answer_of_a_study_names_an_estimated_pressure_viscosity_coefficient(alpha, is_estimate):
    """With the changes by measured oils that a run of its point has."""
    oil = {"viscosity": None, "pressure_viscosity_coefficient": alpha, "grade": "ISO VG 68", "viscosity_index": 95}
    scene = SCENE.with_(lubricant=oil | {"temperature": "40 °C"})
    text = " ".join(answer_lines(lubfric.study(scene, {"bodies.load": [scene.bodies.load]}, [0.5])))
    assert ("The pressure-viscosity coefficient is an estimate" in text) == is_estimate
    if is_estimate:
        effects = lubfric.friction(scene, 0.5).unmodelled_effects
        by_alpha = [effect.change for effect in effects if "measured oils" in effect.what]
        assert by_alpha and all(f"by at most about {100 * change:.2g} %" in text for change in by_alpha)


def test_the_load_on_films_at_their_limit_is_stated_beside_the_asperity_load_ratio():
    """Two films at the limit of the oil, one that is part of the asperity load, one whose load is not known."""
    loads = {
        "contact_load": np.array([0.0, 20.0, 60.0, 10.0]),
        "film_load": np.array([100.0, 80.0, 40.0, 90.0]),
        "boundary_film_load": np.array([0.0, 20.0, 10.0, 10.0]),
        "saturated_film_load": np.array([92.0, 50.0, 50.0, np.nan]),
    }
    assert "carry 50 to 92 % of the load at 2 of 4 points" in films_in_words.films_at_limit(loads)
    assert "carry 92 % of the load;" in films_in_words.films_at_limit({name: load[:1] for name, load in loads.items()})
    assert films_in_words.films_at_limit({name: load[2:] for name, load in loads.items()}) == ""


def test_the_line_of_f_ends_where_the_sliding_changes_its_direction(result):
    """Point 2 of 3 rolls without slip: no line joins it to the others, of f and of the power loss, but of the load."""
    for quantity in ("coefficient", "power_loss"):
        drawn = plot_points(result, quantity).lines[0].get_ydata()
        np.testing.assert_array_equal(np.isnan(drawn), [False, True, False, True, False])
    load = plot_points(result, "film_load").lines[0].get_ydata()
    assert np.isfinite(load).all() and load.size == 3


@pytest.mark.parametrize(
    "sliding, places",
    [
        ([0.3, 0.1, -0.3], [1.5]),
        ([0.3, 0.0, -0.3], [1.0]),
        ([0.0, 0.0, 0.0], []),
        ([0.1, 0.2, 0.3], []),
        ([0.0, 0.0, -0.3], [0.0, 1.0]),
    ],
)
def test_a_line_is_drawn_where_nothing_slides(sliding, places):
    """Over 0, 1 and 3: where a straight line between two points is 0, or at a point."""
    where = places_without_sliding(np.array([0.0, 1.0, 3.0]), np.array(sliding))
    np.testing.assert_allclose(where, places)


def test_a_ratio_that_follows_from_given_speeds_is_not_asked_for_its_unit():
    """Neither the plan nor the check of the motion asks for percent where the table gives the sliding speed."""
    scene = SCENE.with_(numerics={"sampling": "patch", "model": "paper"})
    table = {"speed [m/s]": [0.1, 0.1], "sliding_speed [m/s]": [0.48, 0.56]}
    text = lubfric.plan_study(scene, points=table).explain()
    assert "slide" in text and "percent" not in text.replace("slip_percent", "percent") and "Did you mean" not in text
    assert "otherwise check the speeds of the surfaces" in text


def test_identical_points_are_counted_before_they_are_solved_once():
    """The base circle of a cam: the same load and speeds at three of four times, one of them with another label."""
    table = {"time [s]": [0, 1, 2, 3], "load [N]": [5, 5, 4, 5], "u1 [m/s]": [0.1] * 4, "u2 [m/s]": [0.3] * 4}
    plan = lubfric.plan_study(SCENE, points=table)
    assert plan.explain().splitlines()[0].endswith("4 points, 2 of them different: identical ones are solved once")
    del table["load [N]"]
    table["radius [mm]"] = [4, 5, 6, 7]
    assert "different" not in lubfric.plan_study(SCENE, points=table).explain()


@pytest.mark.parametrize("first, turns", [([0.1, -0.8], 0), ([0.1, -0.3], 0), ([0.9, 0.1], 1)])
def test_a_reversal_of_the_entrainment_is_none_of_the_sliding(first, turns):
    """u1 against u2 = 0.7 m/s: where u1 = -0.8 m/s, as at the nose of a cam, U is negative and the sliding is not."""
    smooth = SCENE.with_(surface={"sq": 0.0, "correlation_length": 8e-6}, numerics={"model": "paper"})
    table = {"position [mm]": [0, 1], "u1 [m/s]": first, "u2 [m/s]": [0.7, 0.7]}
    axes = plot_points(lubfric.study(smooth, points=table), "coefficient")
    assert np.isnan(axes.lines[0].get_ydata()).sum() == turns


# Points of a table that slide in one direction and have no position, with a temperature in each row.
HOT = lubfric.plan_study(
    lubfric.load_scene("paper").with_(
        lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70.0},
        numerics={"sampling": "patch", "model": "paper"},
    ),
    points={"temperature [°C]": [70, 45, 90], "speed [m/s]": [0.1, 0.2, 0.3], "slide_roll_ratio": [0.2, 0.3, 0.4]},
)


def stand_in(model_error=0.4):
    """A result of these points with made-up numbers: nothing is solved."""
    f = np.array([0.1, 0.2, 0.3])
    columns = {name: np.full(3, model_error) for name in ("interval_low", "interval_high", "model_error")}
    columns |= {"coefficient": f, "power_loss": f}
    return made_study(HOT, columns)


def test_a_table_without_positions_is_drawn_over_the_number_of_its_points():
    """No line joins them, because the rows have no order; each has a bar of its interval."""
    axes = plot_points(stand_in(), "coefficient")
    (line,) = axes.lines
    np.testing.assert_array_equal(line.get_xdata(), [1, np.nan, 2, np.nan, 3])
    np.testing.assert_array_equal(line.get_ydata(), [0.1, np.nan, 0.2, np.nan, 0.3])
    bars = [each.get_segments()[0][0][0] for each in axes.collections if hasattr(each, "get_segments")]
    assert bars == [1, 2, 3]


def test_what_follows_from_a_varied_temperature_is_no_common_input():
    common = common_inputs(stand_in())
    assert "length of the line contact" in common and "mPa s" not in common
    assert "lubricant.temperature" not in common and "pressure_viscosity_coefficient" not in common


def test_the_table_of_a_report_has_what_was_given_and_folds_what_follows_from_it(result):
    """The slide-roll ratio follows from the speeds of both surfaces."""
    page = study_page(result, {}, []).decode()
    (shown, folded) = (
        {*re.findall(r"<th(?: [^>]*)?>(.*?)</th>", part)}
        for part in page.partition("<h2>Operating points</h2>")[2].split("<details>")[:2]
    )
    assert "slide-roll ratio" in folded - shown
    assert {"lambda ratio", "asperity load ratio F_C/F_T"} <= shown
    assert any(head.startswith("speed of surface 1 [") for head in shown)
    ratios = re.findall(r'data-label="slide-roll ratio"[^>]*>([^<]*)', page)
    assert [float(ratio) for ratio in ratios] == [float(f"{(b - a) / (0.5 * (a + b)):.4g}") for _, _, a, b, _ in ROWS]


def test_the_status_of_a_study_is_read_as_its_columns_are():
    assert list(stand_in()["status"]) == ["converged"] * 3 and list(stand_in()["validity"]) == [""] * 3


@pytest.mark.parametrize(
    "heat, numbers, words",
    [
        ("auto", "At points 1 and 3", "numerics.heat = 'auto' computes them only where"),
        ("off", "At all points", "numerics.heat = 'off' neglects the heat; 'on' computes them."),
        ("on", "At point 2", "nothing slides there"),
    ],
)
def test_a_report_says_why_temperature_rises_are_not_computed_and_how_to_get_them(heat, numbers, words):
    """The recommendation holds: with it the rises of all points that slide are numbers."""
    oil = {"temperature": 353.15, "temperature_coefficient": 0.03, "reference_temperature": None}
    scene = SCENE.with_(lubricant={key: value for key, value in oil.items() if value}, numerics={"heat": heat})
    columns = dict(zip(("radius", "load", "u1", "u2", "duration"), zip(*ROWS)))
    result = lubfric.study(scene, points=columns)
    reasons = why_no_rises(result)
    (reason,) = (text for text in reasons if words in text)
    assert reason.startswith(f"{numbers} the temperature rises are not computed: ")
    assert np.isfinite(result["flash_temperature_rise"]).tolist() == [heat == "on", False, heat == "on"]
    assert len(reasons) == {"auto": 2, "off": 1, "on": 1}[heat]


def test_the_points_of_the_answer_are_in_the_table_of_a_long_study(monkeypatch):
    """Ten points with a table of three: those of the smallest and largest f and power loss are in it."""
    monkeypatch.setattr("lubfric.output.study_report.MOST_ROWS", 3)
    result = lubfric.study(SCENE, {"bodies.load": np.linspace(3.0, 6.0, 10).tolist()}, speeds=[0.03])
    page = study_page(result, {}, ["a study"])
    numbers = [int(number) for number in re.findall(r"<tr><td[^>]*>(\d+)</td>", page.decode())]
    for name in ("coefficient", "power_loss"):
        values = np.ravel(result[name])
        assert {int(np.argmin(values)) + 1, int(np.argmax(values)) + 1} <= set(numbers)


def test_the_status_and_the_notes_of_a_study_count_the_same_points():
    """Rolling resistance makes most of f at point 2: no relative error counts there, in either."""
    columns = dict(zip(("radius", "load", "u1", "u2", "duration"), zip(*ROWS)))
    study = lubfric.study(SCENE.with_(numerics={"model": "paper", "model_tolerance": 1e-3}), points=columns)
    (missed,) = (each for each in status_of_study(study).exceeded if "model-form" in each.error)
    (note,) = (each for each in study.gathered if each.violation.unit == "%" and "model-form" in each.violation.what)
    assert "Recommendation" in note.text
    known = replace(study, columns={**study.columns, "interval_low": study["coefficient"]})
    assert "the interval of f includes their effect, or nothing reduces it; recom" in counts_of_warnings(known)
    assert note.numbers == tuple(point + 1 for point in missed.points) == (1, 3)
    assert note.violation.value == pytest.approx(100 * missed.value, rel=1e-12)


def test_a_small_rolling_resistance_is_a_number_of_two_digits():
    """0.4567 W is less than 1 % of 580 W, 5.678 W is not of 31 W."""
    cells = cells_of_rolling(np.array([0.4567, 5.678, 0.0, np.nan]), np.array([580.0, 31.0, 31.0, 31.0]))
    assert cells == ["0.46", "5.68", "0", "-"]
