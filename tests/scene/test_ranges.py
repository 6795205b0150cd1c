"""Inputs known to a range only, and f_b over speed or temperature: as given, written, read, in f and its interval."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene
from toys import Spring

import lubfric
from lubfric.estimate import with_input_ranges
from lubfric.output.inputs import inputs
from lubfric.scene import Table

FRICTION = "boundary_friction_coefficient"
HARDNESS = "hardness"
EYRING = "eyring_stress"
ALPHA = "pressure_viscosity_coefficient"
SMALL = paper_scene(numerics={"sampling_tolerance": 0.1}, lubricant={EYRING: 5e6})


def f(scene, speed=0.003):
    return lubfric.friction(scene, speed)


def test_a_range_is_kept_as_long_as_its_value(tmp_path):
    """Given by its ends, with a value between them, or by the name of a typical value; written and read back."""
    scene = SMALL.with_(
        bodies={FRICTION: ["8 %", "12 %"], HARDNESS: "100Cr6"}, lubricant={EYRING: ["5 MPa", "2 MPa", "10 MPa"]}
    )
    keys = [name for name, *_ in scene.ranges]
    assert keys == [f"bodies.{FRICTION}", f"bodies.{HARDNESS}", f"lubricant.{EYRING}"]
    assert scene.bodies.boundary_friction_coefficient == pytest.approx(0.1) and scene.ranges[0][1:] == (0.08, 0.12)
    assert scene.ranges[2][1:] == (2e6, 1e7) and scene.lubricant.eyring_stress == 5e6
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert lubfric.load_scene(tmp_path / "scene.toml") == scene
    assert scene.with_(bodies={"load": 6.0}).ranges == scene.ranges
    assert scene.with_(bodies={FRICTION: 0.1}, lubricant={EYRING: 5e6}).ranges == scene.ranges[1:2]
    assert scene.with_(bodies={"hardness_hv": 700}).ranges == (scene.ranges[0], scene.ranges[2])
    assert scene != scene.with_(bodies={FRICTION: scene.bodies.boundary_friction_coefficient})


@pytest.mark.parametrize(
    "given",
    [[0.12, 0.08], [0.1], [0.2, 0.1, 0.15], [0.1, 0.1], [0.1, "x"], [-0.1, 0.1], {"speed": [1], "values": [1]}]
    + [{"sliding_speed": [0, 1], "values": [0.1]}, {"sliding_speed": [1, 0], "values": [0.1, 0.1]}],
)
def test_what_is_no_range_and_no_table_is_refused(given):
    with pytest.raises(lubfric.InputError, match="boundary_friction_coefficient"):
        SMALL.with_(bodies={FRICTION: given})


def test_an_end_that_is_not_solved_does_not_lose_the_point(monkeypatch):
    def fails(*args):
        raise lubfric.ConvergenceError("no balance")

    monkeypatch.setattr("lubfric.models.load_sharing.answer.solve_balance", fails)
    known = f(SMALL.with_(bodies={HARDNESS: [1.2e9, 6e9]})).uncertainty
    assert np.isfinite(known.interval).all() and math.isnan(known.inputs)
    assert "range of hardness: not in the interval" in known.text


@pytest.mark.parametrize("key, ends", [(FRICTION, (0.07, 0.1)), (HARDNESS, (1.2e9, 6e9))])
def test_both_ends_are_in_the_interval(key, ends):
    """The scene at each end by itself, on the same first strips: its change of f adds to the half-width as squares."""
    middle = SMALL.with_(bodies={key: [0.5 * sum(ends), *ends]}, numerics={"sampling_tolerance": 0.5})
    known = f(middle)
    plain = f(middle.with_(bodies={key: 0.5 * sum(ends)}))
    changes = [f(middle.with_(bodies={key: end})).coefficient / plain.coefficient - 1 for end in ends]
    assert known.coefficient == plain.coefficient and known.uncertainty.inputs > 1e-3
    assert known.uncertainty.inputs == pytest.approx(max(map(abs, changes)), rel=0.02 if key == FRICTION else 0.2)
    for side, sign in ((0, -1), (1, 1)):
        budget = plain.uncertainty.budget
        own = math.hypot(budget["numerical"], budget["sampling"], plain.uncertainty.model_sides[side])
        by_range = max(0.0, *(sign * change for change in changes))
        half = abs(known.uncertainty.interval[side] / known.coefficient - 1)
        largest = (ends[1] if key == FRICTION else 0.09) + 2 * known.rolling_force / 5.5  # by the limits of the stress
        most = largest / known.coefficient - 1 if side else math.inf
        assert half == pytest.approx(min(math.hypot(own, by_range), most), rel=2e-3)
    assert key in known.uncertainty.text and known.uncertainty.text in known.report.notes


def test_a_range_widens_a_friction_below_zero_to_the_right_side():
    """Backwards f is below 0, and a larger f_b raises it. On the other side the interval stays."""
    scene = SMALL.with_(motion={"slide_roll_ratio": -1e-5}, bodies={FRICTION: 1e-4})
    plain = f(scene, 0.03)
    known = f(scene.with_(bodies={FRICTION: [1e-4, 1e-4, 0.02]}), 0.03)
    assert known.coefficient == plain.coefficient < 0 < plain.contact_load
    (low, high) = plain.uncertainty.interval
    (least, most) = known.uncertainty.interval
    assert least == pytest.approx(low, rel=1e-9)
    assert most - plain.coefficient == pytest.approx(
        math.hypot(high - plain.coefficient, 0.0199 * plain.contact_load / 5.5), rel=1e-6
    )
    towards_zero, away_from_zero = known.uncertainty.input_sides
    assert away_from_zero == 0 < towards_zero


def test_the_deterministic_answer_has_its_ranges_too():
    """The change of f between two answers to scenes at the ends, each solved by itself on cells half as long."""
    numerics = {"model": "deterministic", "grid": "given", "sampling": "patch"}
    scene = SMALL.with_(contact={"shape": (48, 48), "spacing": 90e-6 / 48}, numerics=numerics)
    known = f(scene.with_(lubricant={EYRING: [5e6, 1e6, 2e7]}), 0.03)
    ends = [f(scene.with_(lubricant={EYRING: end}), 0.03).coefficient / known.coefficient - 1 for end in (1e6, 2e7)]
    assert known.uncertainty.inputs == pytest.approx(max(map(abs, ends)), rel=0.1) and min(map(abs, ends)) > 0.01
    assert f"range of {EYRING}: f -1" in known.uncertainty.text  # two digits, the first of which is sure
    by_friction = f(scene.with_(bodies={FRICTION: [0.08, 0.1]}), 0.03)
    share = 0.01 * by_friction.contact_load / scene.bodies.load / by_friction.coefficient
    assert by_friction.uncertainty.inputs == pytest.approx(share)


@pytest.mark.parametrize("model", ["paper", "quick"])
def test_the_change_by_a_pressure_viscosity_coefficient_is_that_of_points_at_both_ends(model):
    """Within the residuals of the solves, on the same cells. The quick model calibrates f at each end by itself, so its
    f before that is compared."""
    contact = {"shape": (24, 24), "spacing": 90e-6 / 24}
    scene = SMALL.with_(contact=contact, numerics={"model": model, "sampling": "patch"})

    def of_cells(value):
        point = f(scene.with_(lubricant={ALPHA: value}), 0.05)
        return point, point.coefficient if model == "paper" else point.deterministic.coefficient

    (known, middle) = of_cells([2.5e-8, 1.2e-8, 4e-8])
    changes = [of_cells(end)[1] / middle - 1 for end in (1.2e-8, 4e-8)]
    stated = [-known.uncertainty.input_sides.towards, known.uncertainty.input_sides.away]
    assert stated == pytest.approx(sorted(changes), abs=4e-3) and min(map(abs, changes)) > 0.03
    assert known.uncertainty.inputs_in_interval == (f"lubricant.{ALPHA}",)


def test_a_range_of_the_pressure_viscosity_coefficient_of_an_oil_changes_nothing_else_of_it(tmp_path):
    """It takes the place of the estimate, as one value does; at another temperature it is the same, and without a value
    the estimate is back."""
    scene = SMALL.with_(lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "70 °C"})
    known = scene.with_(lubricant={ALPHA: ["20 1/GPa", "15 1/GPa", "24 1/GPa"]})
    for (_, *ends), alphas in zip(known.at_ends(), [(1.5e-8, 2.4e-8)], strict=True):
        assert [end.lubricant for end in ends] == [scene.with_(lubricant={ALPHA: end}).lubricant for end in alphas]
    (tmp_path / "scene.toml").write_text(known.to_toml())
    assert lubfric.load_scene(tmp_path / "scene.toml") == known
    assert known.with_(lubricant={"temperature": "90 °C"}).ranges == known.ranges
    assert known.with_(lubricant={ALPHA: None}) == scene
    with pytest.raises(lubfric.InputError, match=r"pressure_viscosity_coefficient is missing or 0.*nu40"):
        scene.with_(lubricant={ALPHA: [2e-8, 0.0, 3e-8]})  # no Roelands exponent


def test_a_range_is_stated_from_its_lowest_to_its_highest_f():
    """At the value itself the change is 0, so that ends which both lower f leave 0 as the upper end. What the rounding
    of a solve leaves is 0, too."""
    known = f(SMALL.with_(numerics={"model": "paper"}))
    plain = replace(known.uncertainty, notes=())
    changes = {"bodies.hardness": (-0.0005, -0.001), "lubricant.eyring_stress": (0.002, -0.001)}
    notes = with_input_ranges(replace(plain, coefficient=0.1), changes).notes
    assert notes == ("range of hardness: f -1 to 0 %", "range of eyring_stress: f -1 to +2 %")
    by_rounding = {"lubricant.limiting_stress_coefficient": (-0.001, 4.4e-17)}
    assert with_input_ranges(replace(plain, coefficient=0.1), by_rounding).notes[0].endswith(": f -1 to 0 %")


@pytest.mark.parametrize("motion", [{}, {"slide_roll_ratio": 0.3}])
def test_only_the_ends_of_ranges_are_solved(motion, monkeypatch):
    """The middle is the answer itself. A hardness above every pressure of the contact changes nothing, so an end that
    is that hard is not solved where the middle is too; one that the pressure reaches is."""
    solves = []

    def counted(solve):
        def wrapper(*args, **options):
            solves.append(solve)
            return solve(*args, **options)

        return wrapper

    at_rest = lubfric.models.deterministic.solve_strip

    def without_motion(scene, bodies, speed, target, **options):
        """Stand in for the march in time, which takes a minute here: only the number of solves counts."""
        del options["most_work"]
        return at_rest(scene, bodies[0].surface, speed, find_slope=True, **options)

    pair = "lubfric.models.deterministic.strip_on_two_grids"
    for place in (pair, "lubfric.models.deterministic.strip"):
        monkeypatch.setattr(f"{place}.solve_strip", counted(at_rest))
    monkeypatch.setattr(f"{pair}.solve_moving_strip", counted(without_motion))
    if motion:  # no second march, on longer cells
        monkeypatch.setattr(f"{pair}.longer_than", lambda surface, factors, **options: factors)
    numerics = {"model": "deterministic", "sampling": "patch", "tolerance": 0.2}
    contact = {"shape": (24, 16), "spacing": (3e-6, 6e-6)}
    surface = {"correlation_length": (8e-6, 14e-6)}
    scene = SMALL.with_(contact=contact, numerics=numerics, motion=motion, surface=surface)
    lubricant = {EYRING: [5e6, 1e6, 2e7]}
    counts = []
    answers = []
    for ranges in (
        {},
        {"lubricant": lubricant, "bodies": {FRICTION: [0.08, 0.1]}},
        {"lubricant": lubricant, "bodies": {FRICTION: [0.08, 0.1], HARDNESS: [50e9, 80e9]}},
        {"bodies": {HARDNESS: [0.3e9, 80e9]}},
    ):
        solves.clear()
        answers.append(f(scene.with_(**ranges), 0.01))
        counts.append(len(solves))
    assert [count - counts[0] for count in counts] == [0, 2, 2, 1]
    assert answers[2].uncertainty.inputs == answers[1].uncertainty.inputs > 0
    assert answers[3].uncertainty.inputs > 0


def test_a_friction_of_nothing_may_be_as_large_as_its_range():
    """At rest in entrainment the contact carries all, and rubs with f_b: 0, or up to 0.1."""
    known = f(SMALL.with_(bodies={FRICTION: [0.0, 0.0, 0.1]}), 0.0)
    assert known.coefficient == 0 and known.uncertainty.interval == pytest.approx((0.0, 0.1))
    assert known.uncertainty.inputs == math.inf and "f +0 to +0.1" in known.uncertainty.text


def test_a_contact_of_the_users_own_is_kept_at_the_ends():
    """Nobody here knows how its hardness acts; ranges of the oil are found with it, as without a range of hardness."""
    spring = Spring(4e-7, 1e-7, 2.0)
    oil = {EYRING: [5e6, 2e6, 1e7]}
    plain, known = (
        f(lubfric.prepare(SMALL.with_(lubricant=oil, bodies=bodies), contact=spring), 0.1)
        for bodies in ({}, {HARDNESS: [6e9, 5e9, 7e9]})
    )
    assert plain.uncertainty.inputs > 0 and math.isnan(known.uncertainty.inputs)
    assert known.uncertainty.interval == pytest.approx(plain.uncertainty.interval, nan_ok=True)
    assert "range of hardness: not in the interval, as the contact was given by the caller" in known.uncertainty.text


def test_a_range_is_in_the_columns_of_a_curve():
    scene = SMALL.with_(bodies={FRICTION: [0.07, 0.11]})
    curve = lubfric.stribeck(scene, [0.003, 1.0])
    slow, fast = curve.uncertainty.inputs
    assert slow == pytest.approx(0.02 / 0.09 * curve.contact_load[0] * 0.09 / 5.5 / curve.coefficient[0]) and fast == 0


def test_a_table_over_the_sliding_speed_is_read_at_every_speed(tmp_path):
    table = {"sliding_speed": [0, 0.004, 10], "values": [0.15, 0.12, 0.05]}
    scene = SMALL.with_(bodies={FRICTION: table})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert lubfric.load_scene(tmp_path / "scene.toml") == scene
    curve = lubfric.stribeck(scene, [0.001, 0.003])
    for speed, result in zip((0.001, 0.003), curve.coefficient, strict=True):
        value = np.interp(2 * speed, table["sliding_speed"], table["values"])
        assert result == f(SMALL.with_(bodies={FRICTION: value}), speed).coefficient
    with pytest.raises(lubfric.InputError, match="no value at 20 m/s"):
        f(scene, 10.0)
    assert scene.with_(bodies={FRICTION: 0.1}).bodies.boundary_friction_table is None


def test_a_table_over_the_temperature_is_read_at_that_of_the_oil():
    table = {"temperature": ["20 °C", "120 °C"], "values": ["13 %", "8 %"]}
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "70 °C"}
    scene = SMALL.with_(bodies={FRICTION: table}, lubricant=oil)
    assert scene.bodies.boundary_friction_coefficient == pytest.approx(0.105)
    assert scene.with_(lubricant={"temperature": "120 °C"}).bodies.boundary_friction_coefficient == pytest.approx(0.08)
    with pytest.raises(lubfric.InputError, match="table"):
        scene.with_(lubricant={"temperature": "130 °C"})
    with pytest.raises(lubfric.InputError, match=r"lubricant\.temperature"):
        SMALL.with_(bodies={FRICTION: table})


def test_info_and_report_tell_ranges_and_tables():
    """The range that was given, not the usual one of a typical value that has the same middle."""
    stated = {}
    for given in (
        {FRICTION: [0.1, 0.14], HARDNESS: [5e9, 7e9]},
        {FRICTION: {"sliding_speed": [0, 2], "values": [0.15, 0.1]}},
    ):
        rows = inputs(SMALL.with_(bodies=given), "bodies")
        stated |= {key.partition(".")[2] + str(len(given)): note for _, _, key, note in rows}
    lengths = SMALL.with_(surface={"correlation_length": [[8e-6, 9e-6], [4e-6, 5e-6], [8e-6, 9e-6]]})
    assert [note for *_, note in inputs(lengths, "surface") if note] == [", range 4 and 5 µm to 8 and 9 µm"]
    assert stated[FRICTION + "2"] == ", range 0.1 to 0.14" and stated[HARDNESS + "1"] == ""
    assert stated[HARDNESS + "2"] == ", range 5 to 7 GPa"
    assert stated[FRICTION + "1"] == ", by a table over sliding_speed: 0.15 at 0 m/s, 0.1 at 2 m/s"


def test_a_run_in_time_takes_f_b_at_its_own_sliding_speed():
    """At rest in entrainment the contact carries all: f is that of the table at the sliding speed."""
    plan = lubfric.Transient(1e-4, outputs=1, speed=0.0, sliding=0.5, initial="rest")
    scene = SMALL.with_(
        bodies={FRICTION: {"sliding_speed": [0, 1], "values": [0.15, 0.05]}}, numerics={"sampling": "patch"}
    )
    run = lubfric.transient(scene.with_(transient=plan))
    assert run.coefficient[-1] == pytest.approx(0.1, rel=0.02)


def test_a_run_in_time_has_the_range_of_f_b_and_tells_the_others():
    """Each end by itself gives f there, as f_b moves no film; what is not solved at its ends is said not to be."""
    plan = lubfric.Transient(1e-4, outputs=1, speed=0.01, sliding=0.5)
    scene = SMALL.with_(numerics={"sampling": "patch"}, transient=plan)
    run = lubfric.transient(scene.with_(bodies={FRICTION: [0.09, 0.08, 0.12]}))
    ends = [lubfric.transient(scene.with_(bodies={FRICTION: end})).coefficient for end in (0.08, 0.12)]
    assert run.coefficient - run.inputs[0] == pytest.approx(ends[0]) and run.inputs[1].min() > 0.01
    assert run.coefficient + run.inputs[1] == pytest.approx(ends[1])
    assert run.uncertainty.inputs == pytest.approx(run.inputs[1] / run.coefficient) and not run.not_in
    both = lubfric.transient(scene.with_(bodies={FRICTION: [0.09, 0.08, 0.12], HARDNESS: [6e9, 5e9, 7e9]}))
    assert np.isnan(both.uncertainty.inputs).all() and both.uncertainty.text[0].endswith(both.not_in[0])
    assert both.not_in[0].startswith("range of hardness: not in the interval") and both.not_in[0] in both.report.notes


def test_a_run_in_time_takes_a_range_and_a_table_that_begins_above_zero():
    """Its hardness is that of the middle; where the entrainment turns, the surfaces slide at 0.5 m/s as before. Outside
    the table it is refused before any work."""
    plan = lubfric.Transient(1e-4, outputs=1, speed=0.0, sliding=0.5, initial="rest")
    table = {FRICTION: {"sliding_speed": [0.2, 0.8], "values": [0.13, 0.07]}, HARDNESS: [6e9, 5e9, 7e9]}
    scene = SMALL.with_(bodies=table, numerics={"sampling": "patch"}, motion={"entrainment_speed": 0.2})
    assert lubfric.transient(scene.with_(transient=plan)).coefficient[-1] == pytest.approx(0.1, rel=0.02)
    late = Table(times=(0.0, 0.9e-4, 1e-4), values=(0.5, 0.5, 1.0))
    with pytest.raises(lubfric.InputError, match="no value at"):
        lubfric.transient(scene.with_(transient=replace(plan, sliding=late)), on_step=pytest.fail)
