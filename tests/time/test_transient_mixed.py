"""Load sharing in time: the steady limit, cycles, hysteresis, rest, balances, checkpoint, command line."""

import csv
import json
import re
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scene_text import paper_scene
from small_study import slowness
from toys import Spring, YieldingSpring

import lubfric
from lubfric.models import prepare
from lubfric.output import main, run_history
from lubfric.scene import Harmonic, Ramp, Table, Transient
from lubfric.time import ContactStep, TransientLoadSharing

SCENE = paper_scene(
    numerics={"sampling": "patch"},
    contact={"shape": (64, 64), "spacing": 0.8e-6},
    surface={"correlation_length": 5e-6},
    motion={"entrainment_speed": 0.02},
)
MODEL = prepare(SCENE)


def run(plan, times=None, model=MODEL, **options):
    return lubfric.transient(replace(model, scene=replace(model.scene, transient=plan)), times, **options)


def test_a_steady_scene_stays_at_the_steady_answer():
    result = lubfric.transient(MODEL, [0.0, 1e-3, 0.1])
    steady = lubfric.friction(MODEL)
    np.testing.assert_allclose(result.coefficient, steady.coefficient, rtol=2e-3)
    np.testing.assert_allclose(result.contact_load, steady.contact_load, rtol=3e-3)
    assert result.couette_force[0] == pytest.approx(steady.couette_force, rel=5e-3)
    assert result.rolling_force[0] == pytest.approx(steady.rolling_force, rel=5e-3)
    assert result.coefficient[-1] == pytest.approx(result.coefficient[0], rel=3e-4)


def test_pure_rolling_backwards_has_the_resistance_of_rolling_forwards():
    """The map is mirrored with the motion; the coefficient is that of the steady model, sign and all. That its
    motion is left out is said, and nothing where it rests."""
    rolling = SCENE.with_(motion={"slide_roll_ratio": 0.0, "entrainment_speed": -0.02})
    heights = prepare(rolling).surface
    mirrored = prepare(rolling, replace(heights, heights=heights.heights[::-1]))
    result = run(Transient(0.1), [0.0, 0.1], mirrored)
    forwards = lubfric.friction(rolling.with_(motion={"entrainment_speed": 0.02}))
    np.testing.assert_allclose(result.coefficient, lubfric.friction(mirrored).coefficient, rtol=5e-3)
    np.testing.assert_allclose(result.coefficient, forwards.coefficient, rtol=5e-3)
    np.testing.assert_allclose(result.power_loss, forwards.power_loss, rtol=5e-3)
    assert "treated as stationary" in result.report.notes[-1]
    assert "treated as stationary" not in " ".join(run(Transient(0.1), [0.0, 0.1]).report.notes)


def test_a_slow_ramp_follows_the_stribeck_curve():
    speed = Ramp(start=0.02, end=0.1, until=2.0)
    result = run(Transient(2.0, speed=speed), np.linspace(0, 2, 6))
    curve = lubfric.stribeck(MODEL, [speed.at(t) for t in result.time])
    np.testing.assert_allclose(result.coefficient, curve.coefficient, rtol=0.01)
    np.testing.assert_allclose(result.contact_load, curve.contact_load, atol=0.01 * SCENE.bodies.load)
    assert result.contact_load[0] > 1 and result.contact_load[-1] == 0  # through the lift-off


def test_the_last_asperity_leaves_and_meets_the_film_with_any_load():
    """A contact that opens by 3 % of its gap while its load falls from 1e-5 of the total to nothing: the film passes
    its opening up and down, and the contact has the load of its closed form."""
    load = 1e-5 * SCENE.bodies.load
    opening = 2.671e-7
    contact = Spring(opening, 0.03 * opening, load)
    plan = Transient(0.3, speed=Harmonic(mean=0.06, amplitude=0.0025, frequency=4.0))
    result = lubfric.transient(prepare(SCENE.with_(transient=plan), contact=contact), np.linspace(0.01, 0.3, 9))
    expected = load * (np.maximum(0.0, 1 - result.mean_gap / opening) / 0.03) ** 1.5
    np.testing.assert_allclose(result.contact_load, expected, rtol=1e-9)
    touches = result.contact_load > 0.0
    assert 1 < touches.sum() < 8 and 0.0 < result.contact_load[touches].min() < load


def test_a_gap_that_jumps_where_a_cell_yields_keeps_the_load_of_the_jump():
    """While the film passes the gaps of the jump, the contact carries its load, within the tolerance of the balance;
    elsewhere that of its closed form. The trials went from one side to the other, until the shortest step failed."""
    (touching, sigma, stiffness, limit, drop) = (2.7e-7, 6e-8, 1.0, 0.3, 1.5e-8)
    contact = YieldingSpring(touching, sigma, stiffness, limit=limit, drop=drop)
    plan = Transient(0.02, speed=Ramp(start=0.044, end=0.052, until=0.02), tolerance=1e-4)
    result = lubfric.transient(prepare(SCENE.with_(transient=plan), contact=contact), np.linspace(0.0, 0.02, 9))
    above = result.mean_gap - contact.gap(limit)  # of the jump, from its upper end
    expected = ((touching - result.mean_gap - drop * (above < -drop)) / sigma) ** 1.5 * stiffness
    in_jump = (-drop <= above) & (above <= 0.0)
    np.testing.assert_allclose(result.contact_load, np.where(in_jump, limit, expected), atol=1e-4 * SCENE.bodies.load)
    assert in_jump.sum() > 2 and (above > 0).any() and (above < -drop).any()


@pytest.mark.parametrize("power", [1.5, 4.0, 9.0])
def test_the_power_of_a_contact_is_that_of_its_load_whatever_film_it_had_before(power):
    """A load that grows with a power of the approach from first touch; under the last film the first touch was
    elsewhere."""
    contact = Spring(2e-7, 1e-8, 1.0)

    def step(gap, touching_gap):
        state = replace(contact.close(np.full(contact.x.size, gap), 0.0), mean_gap=gap)
        load = ((2e-7 - gap) / 1e-7) ** power
        return ContactStep(load=load, state=state, touching_gap=touching_gap, power=1.2 * power)

    assert step(1.2e-7, 2e-7).power_from(step(1.1e-7, 2.6e-7)) == pytest.approx(power)
    changed_by_1e_4 = step(1.2e-7 + 8e-12 / power, 2e-7)  # a load that changes slowly
    assert changed_by_1e_4.power_from(step(1.2e-7, 2e-7)) == pytest.approx(power, rel=1e-3)


def test_a_rough_contact_that_lifts_off_under_a_steep_load_takes_few_steps():
    """A plateau-honed surface under 3 kN: the load of its asperities is steep in the film, and each film that is solved
    has another shape. From rest to 0.3 m/s in 1.5 ms took twice as many steps, and ten times as long."""
    steel_on_iron = {"e_prime": None, "material": ["steel", "cast iron"], "hardness": None, "hardness_hv": 250}
    oil = {"nu40": 68e-6, "nu100": 11e-6, "temperature": 363.15, "eyring_stress": "mineral"}
    scene = paper_scene(
        bodies={"radius": 0.05, "width": 0.2513, "load": 3000.0, **steel_on_iron},
        lubricant={"viscosity": None, "pressure_viscosity_coefficient": None, **oil},
        surface={"sq": None, "sk": 1.5e-7, "spk": 1e-7, "svk": 4e-7, "correlation_length": 2e-5, "acf": "exponential"},
        contact={"shape": (96, 24), "spacing": 5e-6},
        numerics={"sampling": "patch", "grid": "given", "accept": True},
        transient=lubfric.Transient(1.5e-3, 2, speed=Harmonic(amplitude=1.0, frequency=100 / 3)),
    )
    result = lubfric.transient(scene)
    np.testing.assert_allclose(result.contact_load[1:] / 3000, [0.488, 0.0944], rtol=0.01)
    assert result.report.evaluations < 100


@pytest.mark.parametrize("geometry", ["cylinder", "flat"])
def test_a_contact_forgets_the_load_and_the_radius_that_it_had(geometry):
    """After half the load and a third of the radius f is the steady one there: the area A is the Hertz strip of the
    moment."""
    scene = SCENE.with_(contact={"geometry": geometry})
    (load, radius) = (scene.bodies.load, scene.bodies.radius)
    plan = Transient(
        0.2, load=Ramp(start=load, end=load / 2, until=0.05), radius=Ramp(start=radius, end=radius / 3, until=0.05)
    )
    result = run(plan, [0.0, 0.2], prepare(scene))
    there = lubfric.friction(scene.with_(bodies={"load": load / 2, "radius": radius / 3}))
    assert there.contact_load > 0.3 * load / 2
    np.testing.assert_allclose(result.coefficient[-1], there.coefficient, rtol=5e-3)
    np.testing.assert_allclose(result.contact_load[-1], there.contact_load, rtol=1e-2)


def test_balances_hold_at_every_output():
    speed = Harmonic(amplitude=0.05, frequency=50.0, phase=1.0)
    load = Harmonic(mean=4.0, amplitude=1.0, frequency=30.0)
    result = run(Transient(0.02, speed=speed, load=load, tolerance=1e-3), np.linspace(0, 0.02, 21))
    total = result.contact_load + result.film_load
    np.testing.assert_allclose(total, result.load, rtol=1e-6)
    touching = result.contact_load > 0
    np.testing.assert_allclose(result.mean_gap[touching], result.mean_film[touching], rtol=3e-4)
    nodal = np.trapezoid(result.pressure, result.x, axis=1) * SCENE.bodies.width
    np.testing.assert_allclose(nodal, result.film_load, rtol=3e-3)  # without the tails
    assert np.all(result.mass_residual < 1e-3)
    parts = result.boundary_force + result.couette_force + result.rolling_force
    np.testing.assert_allclose(parts, result.friction_force, rtol=1e-12)
    boundary = 0.09 * result.contact_load * np.sign(result.sliding_speed)
    np.testing.assert_allclose(result.boundary_force, boundary, rtol=1e-12)
    np.testing.assert_allclose(result.coefficient, np.abs(result.friction_force) / result.load, rtol=1e-12)


def test_a_reciprocating_contact_becomes_periodic_and_mirrors_itself():
    wave = Harmonic(amplitude=0.05, frequency=100.0, phase=np.pi / 2)
    result = run(Transient(0.025, speed=wave, tolerance=1e-3), np.arange(51) * 5e-4)
    f = result.coefficient
    np.testing.assert_allclose(f[30:51], f[10:31], rtol=2e-3)  # one period later
    np.testing.assert_allclose(f[20:41], f[10:31], rtol=5e-3)  # run backwards (the map itself is not symmetric)
    assert f.max() > 1.5 * f.min()
    for side in (
        result.model_error_low,
        result.model_error_high,
    ):  # f resists the sliding both ways, and so do its errors
        np.testing.assert_allclose(side[20:41], side[10:31], rtol=2e-2)
    low, high = result.uncertainty.interval.T
    np.testing.assert_allclose(((f - low) / (high - f))[20:41], ((f - low) / (high - f))[10:31], rtol=2e-2)


def loop_gap(period):
    """Friction on the way down minus on the way up, at half the largest speed."""
    wave = Harmonic(mean=0.05, amplitude=0.045, frequency=1 / period, phase=np.pi / 2)
    times = np.array([1.25, 1.75]) * period
    result = run(Transient(1.75 * period, speed=wave, tolerance=1e-3), times)
    assert result.entrainment_speed == pytest.approx([0.05, 0.05])
    return result.coefficient[0] - result.coefficient[1]


def test_the_friction_loop_has_its_hysteresis():
    """Slowing down drags a thick film along (less contact friction), speeding up a thin one."""
    fast = loop_gap(5e-3)
    slow = loop_gap(0.1)
    assert fast < -5e-4 and abs(slow) < 0.3 * abs(fast)


def test_from_rest():
    result = run(Transient(4e-3, speed=Ramp(start=0.0, end=0.1, until=2e-3)), [0.0, 1e-4, 1e-3, 4e-3])
    assert result.contact_load[0] == pytest.approx(5.5) and result.film_load[0] == 0
    assert result.coefficient[1] == pytest.approx(0.09, rel=0.05)
    assert np.all(np.diff(result.contact_load) < 0)
    assert result.central_film[-1] == pytest.approx(lubfric.friction(MODEL, 0.1).central_film, rel=0.01)


def test_jumps_of_load_and_speed():
    plan = Transient(
        0.02,
        speed=Table(times=(0, 5e-3, 5e-3, 0.02), values=(0.01, 0.01, 0.1, 0.1)),
        load=Table(times=(0, 0.01, 0.01, 0.02), values=(5.5, 5.5, 0.55, 0.55)),
    )
    result = run(plan, [0.0, 5e-3, 0.01, 0.02])
    light = replace(MODEL, scene=MODEL.scene.with_(bodies={"load": 0.55}))
    ends = [lubfric.friction(*end) for end in ((MODEL, 0.01), (MODEL, 0.1), (light, 0.1))]
    for index, steady in zip((1, 2, 3), ends):
        assert result.central_film[index] == pytest.approx(steady.central_film, rel=0.01)
        assert result.coefficient[index] == pytest.approx(steady.coefficient, rel=0.02)


def test_the_flat_contact_runs_in_time():
    flat = prepare(lubfric.load_scene("flat").with_(contact={"shape": (64, 64), "spacing": 8e-6}))
    wave = Harmonic(mean=0.1, amplitude=0.05, frequency=20.0)
    result = run(Transient(0.05, speed=wave, tolerance=1e-3), np.linspace(0, 0.05, 11), flat)
    assert result.report.converged and 0 < result.contact_load.min() and np.ptp(result.coefficient) > 1e-3


def test_failed_steps_are_reported_with_the_rows_so_far(monkeypatch):
    real = TransientLoadSharing.solve

    def failing(sharing, at, *rest):
        result = real(sharing, at, *rest)
        return replace(result, status="diverged") if at > 1.5e-3 else result

    monkeypatch.setattr(TransientLoadSharing, "solve", failing)
    with pytest.raises(lubfric.ConvergenceError) as caught:
        lubfric.transient(MODEL, [0.0, 1e-3, 2e-3])
    result = caught.value.result
    assert result.time.tolist() == [0.0, 1e-3] and "stopped at t = " in str(caught.value)
    assert result.status.startswith("Not converged: stopped at t = 1.") and "2 of 3 outputs" in result.status
    assert lubfric.transient(MODEL, [0.0, 1e-3]).status.startswith("Converged: all 2 outputs to t = 1 ms are solved")


def test_a_balance_that_is_lost_after_a_reversal_is_named_with_its_output(monkeypatch):
    """The largest residual of the lubricant over its tolerance, by the columns of the result."""
    swing = Transient(0.02, speed=Harmonic(amplitude=0.05, frequency=50.0, phase=np.pi / 2), tolerance=3e-3)
    times = np.linspace(0.0, 0.02, 9)
    monkeypatch.setattr("lubfric.time.result.MASS", 1e-15)
    with pytest.raises(lubfric.ConvergenceError) as caught:
        run(swing, times)
    result = caught.value.result
    index = int(result.mass_residual.argmax())
    said = re.search(
        r"the balance of the lubricant is (\S+) times its tolerance at output (\d+), t = (\S+) ms", str(caught.value)
    )
    times_its_tolerance = float(said[1].translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")).replace("·10", "e"))
    assert times_its_tolerance == pytest.approx(result.mass_residual[index] / 1e-15, rel=0.01)
    assert (int(said[2]), float(said[3])) == (index + 1, pytest.approx(1e3 * times[index]))
    reverses = [3, 7]  # the outputs (from 0) with another sign of the speed than the one before
    assert ("where the motion reverses" in str(caught.value)) == (index in reverses)
    assert ("after the motion has reversed" in str(caught.value)) == (index > 2 and index not in reverses)
    assert "all 9 outputs are solved, but" in result.status and "max_iterations" not in str(caught.value)


@pytest.mark.parametrize(
    "plan, words",
    [
        (Transient(1.0, load=Ramp(start=5.5, end=6.0, until=1.0)), "bodies.load"),
        (Transient(1.0, initial="steady", speed=Ramp(start=0.0, end=1.0, until=1.0)), "'rest'"),
        (Transient(1.0, initial_film=1e-8), "initial_film"),
        (None, r"\[transient\]"),
    ],
)
def test_impossible_runs_are_refused(plan, words):
    with pytest.raises(lubfric.InputError, match=words):
        run(plan)


def test_starts_that_contradict_or_are_missing_are_refused():
    with pytest.raises(
        lubfric.InputError, match="transient.initial = 'steady' has no effect together with initial_film"
    ):
        Transient(1e-3, initial="steady", initial_film=1e-6)
    with pytest.raises(lubfric.InputError, match="initial_film"):
        lubfric.transient(SCENE.with_(surface={"sq": 0.0}, transient=Transient(1.0, speed=Ramp(end=1.0))))


class Killed(Exception):
    pass


def stopped(model, folder, after=1):
    """The times of all steps of a run that ends by an exception after some of them."""
    seen = []

    def on_step(time, *_):
        seen.append(time)
        if len(seen) == after:
            raise Killed

    plan = Transient(0.01, outputs=10, speed=Harmonic(mean=0.05, amplitude=0.02, frequency=100.0))
    with pytest.raises(Killed):
        run(plan, model=model, checkpoint=folder, on_step=on_step)
    return seen


def test_a_checkpoint_of_another_map_or_scene_is_left_alone(tmp_path):
    first = stopped(MODEL, tmp_path)
    surface = MODEL.surface
    for other in (
        prepare(SCENE, surface=replace(surface, heights=surface.heights[::-1])),
        prepare(SCENE, surface=replace(surface, spacing=(0.8e-6, 0.81e-6))),
        prepare(SCENE.with_(bodies={"load": 5.6})),
        prepare(SCENE.with_(bodies={"boundary_friction_coefficient": 0.1})),
        prepare(SCENE.with_(numerics={"tolerance": 0.02})),
    ):
        begun = stopped(other, tmp_path)[0]
        assert stopped(other, tmp_path)[0] > begun  # each goes on from its own
    assert stopped(MODEL, tmp_path)[0] > first[0]


def test_a_damaged_checkpoint_is_reported_and_the_run_begins_again(tmp_path):
    first = stopped(MODEL, tmp_path, after=12)
    for path in sorted((tmp_path / "points").iterdir()):
        whole = path.read_bytes()
        for content in (whole[: len(whole) // 2], whole[:-1] + bytes([whole[-1] ^ 1]), b""):
            path.write_bytes(content)
            with pytest.warns(UserWarning, match="damaged and is not used"):
                assert stopped(MODEL, tmp_path, after=12) == first
    assert stopped(MODEL, tmp_path)[0] > first[-1]


def test_the_command_writes_history_figure_and_animation(tmp_path, capsys, monkeypatch):
    text = (Path(__file__).parents[2] / "docs" / "examples" / "stop_and_start.toml").read_text()
    scene = tmp_path / "scene.toml"
    quick = 'outputs = 6\ntolerance = 1e-3\n[numerics]\nsampling = "patch"\ntolerance = 0.05'
    for long, short in (("[200, 200]", "[64, 64]"), ("0.45e-6", "0.8e-6"), ("outputs = 200", quick)):
        text = text.replace(long, short)
    scene.write_text(text)
    assert main(["run", str(scene), "--out", str(tmp_path / "out"), "--animation"]) == 0
    names = {p.name for p in (tmp_path / "out").iterdir()}
    stated = (
        ".lubfric history.csv history.png fields.npz surface.png report.html references.bib resolved.toml "
        "result.json animation.gif"
    )
    assert names == {*stated.split()}
    rows = (tmp_path / "out" / "history.csv").read_text().splitlines()
    assert len(rows) == 8 and rows[0].startswith("time [s],entrainment_speed [m/s]")
    with (tmp_path / "out" / "history.csv").open() as table:
        history = list(csv.DictReader(table))
    at, loss = (np.array([float(row[f"{name}]"]) for row in history]) for name in ("time [s", "power_loss [W"))
    mean = json.loads((tmp_path / "out" / "result.json").read_text())["mean"]
    assert mean["power_loss"] == pytest.approx(np.trapezoid(loss, at) / (at[-1] - at[0]), rel=1e-6)
    assert "t = 0.02 of 0.02 s" in capsys.readouterr().err
    (tmp_path / "out" / "history.png").unlink()
    assert main(["plot", str(tmp_path / "out")]) == 0 and (tmp_path / "out" / "history.png").is_file()
    drawn = (tmp_path / "out" / "history.png").read_bytes()

    def full_disk(path, *_, **_options):
        Path(path).write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("lubfric.output.plot_again.plot_history", full_disk)
    assert main(["plot", str(tmp_path / "out")]) != 0
    assert (tmp_path / "out" / "history.png").read_bytes() == drawn
    assert {p.name for p in (tmp_path / "out").iterdir()} == names


def test_an_interrupted_command_writes_the_outputs_so_far_and_continues(tmp_path, capsys, monkeypatch):
    """The interrupt comes with the third output; the same command then continues after it."""
    plan = Transient(0.01, outputs=4, speed=Harmonic(mean=0.05, amplitude=0.02, frequency=100.0), tolerance=1e-3)
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.with_(transient=plan).to_toml())
    command = ["run", str(scene), "--out", str(tmp_path / "out")]
    on_step = run_history.HistoryProgress.on_step

    def interrupted(self, now, duration, row):
        on_step(self, now, duration, row)
        if now == 0.005:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(run_history.HistoryProgress, "on_step", interrupted)
        assert main(command) == 130
    assert "interrupted; the state at t = 0.005 s is kept" in " ".join(capsys.readouterr().err.split())
    assert json.loads((tmp_path / "out" / "result.json").read_text())["report"]["status"] == "interrupted"
    begun = (tmp_path / "out" / "history.csv").read_text().splitlines()
    assert main(command) == 0 and "continues at t = 0.005 s" in " ".join(capsys.readouterr().err.split())
    complete = (tmp_path / "out" / "history.csv").read_text().splitlines()
    assert len(begun) == 4 and len(complete) == 6 and complete[:4] == begun


def test_the_command_continues_with_a_larger_limit_of_work_from_where_a_smaller_one_ended_it(tmp_path, capsys):
    """The same history as at once, of which the command solves only what was left."""
    plan = Transient(0.01, outputs=4, speed=Harmonic(mean=0.05, amplitude=0.02, frequency=100.0), tolerance=1e-3)

    def history(most_work):
        scene = tmp_path / "scene.toml"
        scene.write_text(SCENE.with_(transient=plan, numerics={"max_work": most_work}).to_toml())
        code = main(["run", str(scene), "--out", str(tmp_path / "out")])
        with (tmp_path / "out" / "history.csv").open() as table:
            numbers = [[float(row["time [s]"]), float(row["coefficient [-]"])] for row in csv.DictReader(table)]
        return code, np.array(numbers), " ".join(capsys.readouterr().err.split())

    (code, begun, said) = history(0.06)
    assert code != 0 and 0 < begun[-1, 0] < 0.01 and "larger numerics.max_work continues from there" in said
    (code, continued, said) = history(50.0)
    assert code == 0 and "the run continues at t = " in said and not (tmp_path / "out" / "unfinished").exists()
    at_once = lubfric.transient(SCENE.with_(transient=plan))
    np.testing.assert_allclose(continued.T, [at_once.time, at_once.coefficient], rtol=1e-9)
    np.testing.assert_array_equal(begun, continued[: begun.shape[0]])


@pytest.mark.slow
def test_three_hundred_steps_of_the_paper_scene_take_less_than_thirty_seconds():
    """Processor seconds of the machine that forecasts are made for."""
    wave = Harmonic(amplitude=0.03, frequency=10.0, phase=np.pi / 2)
    scene = paper_scene(numerics={"sampling": "patch"})
    before = slowness()
    begun = time.process_time()
    result = lubfric.transient(scene.with_(transient=Transient(0.1, outputs=300, speed=wave)))
    took = time.process_time() - begun
    assert result.report.iterations >= 300 and took / (0.5 * (before + slowness())) < 30


def test_steps_follow_the_order_of_the_method_down_to_small_errors():
    """The local error of BDF2 falls with the third power of the step. If contact or balance were solved less accurately
    than a step, their noise would be taken for it, and a tenth of the tolerance took four times as many steps."""
    wave = Harmonic(mean=0.03, amplitude=0.01, frequency=50.0)
    patch = lubfric.load_scene("paper").with_(
        contact={"shape": (64, 64), "spacing": 0.9e-6}, numerics={"sampling": "patch", "accept": True}
    )
    steps = [
        lubfric.transient(
            patch.with_(transient=Transient(0.02, outputs=4, speed=wave, tolerance=error))
        ).report.iterations
        for error in (1e-5, 1e-6)
    ]
    assert 1.5 < steps[1] / steps[0] < 1.3 * 10 ** (1 / 3)
