"""Studies: the plan, the same bits on any executor and after any kill, lost workers, failures, tables."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_study import SCENE, same

import lubfric
from lubfric.studies import run as run_module
from lubfric.studies import trail
from lubfric.studies.explain import _costs
from lubfric.studies.journal import Journal, outcome_of
from lubfric.studies.run import rows_of
from lubfric.studies.trail import Trail, points_of
from lubfric.studies.walk import Walk

ROOT = Path(__file__).parents[2]
SPEEDS = (0.003, 0.03, 0.3)
VARY = {"bodies.load": [3.0, 5.5], "surface.seed": [1, 2]}


@pytest.fixture(scope="module")
def serial():
    return lubfric.study(SCENE, VARY, SPEEDS)


# what is computed


def test_every_point_is_what_friction_gives(serial):
    """Cold, alone, on its own model: within the tolerance on f of both."""
    assert serial.dims == ("bodies.load", "surface.seed", "speed") and serial.status.shape == (2, 2, 3)
    assert serial.failed == serial.missing == 0
    for i, load in enumerate(VARY["bodies.load"]):
        for j, seed in enumerate(VARY["surface.seed"]):
            scene = SCENE.with_(bodies={"load": load}, surface={"seed": seed})
            alone = [lubfric.friction(scene, speed).coefficient for speed in SPEEDS]
            np.testing.assert_allclose(serial["coefficient"][i, j], alone, rtol=SCENE.numerics.tolerance)


@pytest.mark.parametrize("first", ["bodies.hertz_pressure", "bodies.radius"])
def test_keys_of_several_dimensions_act_together(first):
    """A Hertz pressure is that with the radius of the same point, w = 2 pi R p²/E', whichever key comes first."""
    vary = {"bodies.hertz_pressure": [1e8, 2e8], "bodies.radius": [2e-3, 4e-3]}
    plan = lubfric.plan_study(SCENE, {first: vary[first], **vary}, SPEEDS)
    for walk in plan.walks:
        at = {axis.name: axis.values[i][0] for axis, i in zip(plan.axes, walk.index)}
        bodies = walk.scene.bodies
        assert bodies.radius == at["bodies.radius"]
        load = 2 * np.pi * bodies.radius * at["bodies.hertz_pressure"] ** 2 / bodies.e_prime * bodies.width
        assert bodies.load == pytest.approx(load, rel=1e-12)
    whole = SCENE.with_keys({"bodies.radius": 4e-3, "bodies": {"hertz_pressure": 1e8}})
    assert whole == SCENE.with_(bodies={"radius": 4e-3, "hertz_pressure": 1e8})


@pytest.mark.parametrize(
    "vary, words",
    [
        ({"bodies.load": [3.0, 5.5], "bodies.hertz_pressure": [1e8]}, "say the same thing"),
        ({"motion.slip_percent": [10.0], "motion.slide_roll_ratio": [0.1, 2.0]}, "say the same thing"),
        ({"motion.surface_speeds": [(0.0, 0.1), (0.0, 0.2)]}, "give speeds"),
        ({"motion.speed_range": [(0.1, 1.0, 3)]}, "give speeds"),
        ({"lubricant.temperature_celsius": [40.0, 80.0]}, "moves no viscosity"),
    ],
)
def test_keys_of_which_one_would_do_nothing_are_refused(vary, words):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.plan_study(SCENE, vary, [0.1])


def test_a_study_says_that_its_points_are_steady():
    moving = SCENE.with_(transient=lubfric.Transient(duration=0.1))
    assert "[transient]) is left out" in lubfric.plan_study(moving, {}, [0.1]).explain()
    assert "[transient]" not in lubfric.plan_study(SCENE, {}, [0.1]).explain()


def test_cautions_and_accepted_points_are_marked(tmp_path):
    """A turbulent film: refused, or accepted and marked, in every table."""
    thin = SCENE.with_(surface={"sq": 0.0}, lubricant={"viscosity": 0.005})
    vary = {"numerics.accept": [False, True], "motion.slide_roll_ratio": [1.0, 2.0]}
    found = lubfric.study(thin, vary, [1.0, 1000.0], store=tmp_path)
    point = lubfric.friction(thin.with_(numerics={"accept": True}), 1000.0)
    assert any(entry.severe for entry in point.validity)
    assert found.status[0, 1, 1].startswith("ValidityError") and found.status[1, 1, 1] == "converged"
    assert found.validity[1, 1, 1] == " | ".join(entry.text for entry in point.validity)
    assert "not valid" in found.validity[1, 1, 1] and found.validity[1, 0, 0] == ""
    assert found.cautioned == np.count_nonzero(found.validity != "") and "with cautions" in repr(found)
    same(lubfric.open_study(tmp_path), found)
    assert (lubfric.open_study(tmp_path).validity == found.validity).all()
    found.to_csv(tmp_path / "t.csv")
    rows = list(csv.DictReader((tmp_path / "t.csv").read_text().splitlines()))
    assert [row["validity"] for row in rows] == found.validity.ravel().tolist()
    assert {name for name in rows[0] if "[" not in name} == {"numerics.accept", "status", "validity"}
    assert {"uncertainty_length [m]", "uncertainty_numerical [-]", "speed [m/s]"} <= set(rows[0])


def test_keys_of_the_other_body_have_their_units(tmp_path):
    facing = SCENE.with_(counterface={"sq": 0.0, "correlation_length": 4e-6}, surface={"sq": 0.0})
    lubfric.study(facing, {"counterface.sq": [0.0, 1e-12]}, [1.0]).to_csv(tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_text().startswith("counterface.sq [m],speed [m/s],coefficient [-]")


def test_temperatures_are_varied_with_a_viscosity():
    keys = ("lubricant.temperature", "lubricant.viscosity")
    numbers = lubfric.plan_study(SCENE, {keys: [(313.15, 0.2), (353.15, 0.05)]}, [0.1])
    assert [walk.scene.lubricant.viscosity for walk in numbers.walks] == [0.2, 0.05]
    oil = {"lubricant.nu40": 68e-6, "lubricant.nu100": 8.6e-6, "lubricant.temperature": 313.15}
    oils = lubfric.plan_study(SCENE.with_keys(oil), {"lubricant.temperature_celsius": [40.0, 100.0]}, [0.1])
    cold, hot = (walk.scene.lubricant.viscosity for walk in oils.walks)
    assert hot < 0.2 * cold


def test_oils_and_whole_sections_are_named_in_the_tables(tmp_path):
    oils = [lubfric.oil.from_grade("ISO VG 68", index) for index in (60, 160)]
    warm = SCENE.with_(lubricant={"oil": oils[0], "temperature": 330.0}, surface={"sq": 0.0})
    rough = [warm.surface, replace(warm.surface, seed=5)]
    result = lubfric.study(warm, {"lubricant.oil": oils, "surface": rough}, [1.0], store=tmp_path / "study")
    result.to_csv(tmp_path / "table.csv")
    lines = (tmp_path / "table.csv").read_text().splitlines()
    assert len(lines) == 5 and result.failed == 0
    assert "ISO VG 68, VI 60" in lines[1] and "ISO VG 68, VI 160" in lines[-1] and "seed=5" in lines[2]
    same(lubfric.open_study(tmp_path / "study"), result)


def test_the_flat_contact_shares_its_curve():
    flat = SCENE.with_(contact={"geometry": "flat", "spacing": 2e-6})
    plan = lubfric.plan_study(flat, {"bodies.load": [2.0, 5.5]}, SPEEDS)
    assert len(plan.batches) == 1 and plan.batches[0].leader.bodies.load == 5.5
    found = lubfric.study(plan)
    for i, load in enumerate((2.0, 5.5)):
        alone = lubfric.stribeck(flat.with_(bodies={"load": load}), SPEEDS)
        np.testing.assert_allclose(found["coefficient"][i], alone.coefficient, rtol=flat.numerics.tolerance)


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_gives_the_same_bits(serial, pool, tmp_path):
    with pool(2) as executor:
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=executor), serial)
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=executor, store=tmp_path), serial)
    same(lubfric.open_study(tmp_path), serial)


def test_a_longer_study_takes_over_what_is_known(serial, tmp_path, monkeypatch):
    lubfric.study(SCENE, {"bodies.load": [5.5], "surface.seed": [1, 2]}, SPEEDS, store=tmp_path)
    solved, real = [], trail.friction
    monkeypatch.setattr(trail, "friction", lambda *args, **kw: solved.append(args) or real(*args, **kw))
    same(lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path), serial)
    assert len(solved) == 6 and {model.scene.bodies.load for model, _ in solved} == {3.0}


# kept through everything

SCRIPT = """
import sys
import lubfric
from lubfric.studies import trail
real = trail.friction
def counted(model, speed, **options):
    found = real(model, speed, **options)
    print("solved", flush=True)
    return found
trail.friction = counted
scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"}).with_(
    contact={"shape": (48, 48), "spacing": 1.1e-6}, surface={"correlation_length": 4e-6})
lubfric.study(scene, {"bodies.load": [3.0, 5.5], "surface.seed": [1, 2]}, (0.003, 0.03, 0.3), store=sys.argv[1])
print("done", flush=True)
"""


def killed_until_done(folder, rng, kills):
    """(points solved in all runs together, kills)."""
    solved, count = 0, 0
    while True:
        environment = os.environ | {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
        process = subprocess.Popen([sys.executable, "-c", SCRIPT, str(folder)], env=environment, stdout=subprocess.PIPE)
        if count < kills:
            first = process.stdout.readline()
            time.sleep(rng.exponential(0.02))
            process.send_signal(signal.SIGKILL)
            count += 1
            text = first + process.communicate()[0]
        else:
            text = process.communicate()[0]
            assert process.returncode == 0
        solved += text.decode().count("solved")
        if b"done" in text:
            return solved, count


@pytest.mark.parametrize("kills", [1, pytest.param(30, marks=pytest.mark.slow)])
def test_killed_studies_lose_and_repeat_nothing(serial, tmp_path, kills):
    """A kill may cost the point that is being solved, never one that was finished."""
    rng, left = np.random.default_rng(kills), kills
    for run in range(1000):
        folder = tmp_path / str(run)
        solved, used = killed_until_done(folder, rng, min(left, 10))
        left -= used
        found = lubfric.open_study(folder)
        same(found, serial)
        assert solved <= found.status.size + used
        lines = [line for path in (folder / "points").iterdir() for line in path.read_bytes().splitlines()]
        assert len({line.split(b'"')[3] for line in lines if line.count(b'"') > 3}) == found.status.size
        if left <= 0:
            break


@pytest.mark.parametrize("moment", ["before the state", "after the state", "after the record"])
@pytest.mark.parametrize("at", [0, 1, 3])
def test_a_cut_at_every_moment_of_a_point(tmp_path, monkeypatch, moment, at):
    model = lubfric.prepare(SCENE)
    walk = Walk(model.scene, "x", (0.3, 0.1, 0.03, 0.003), frozenset({0.1}))
    whole = [point.record for point in Trail(model, walk).points()]

    class Killed(BaseException):
        pass

    journal, real_keep, kept = Journal(tmp_path), Journal.keep, []

    def keep(self, key, speed, outcome, fields):
        if len(kept) == at and moment == "before the state":
            raise Killed
        kept.append(key)
        if len(kept) == at + 1 and moment == "after the state":
            self.add = lambda *_: (_ for _ in ()).throw(Killed)
        point = real_keep(self, key, speed, outcome, fields)
        if len(kept) == at + 1:
            raise Killed
        return point

    monkeypatch.setattr(Journal, "keep", keep)
    with pytest.raises(Killed), journal:
        list(Trail(model, walk, journal).points())
    monkeypatch.setattr(Journal, "keep", real_keep)
    with Journal(tmp_path) as again:
        known = again.records()
        assert len(known) == at + (moment == "after the record")
        points = list(Trail(model, walk, again, known).points())
        again.end(walk.keys)
    found = again.records()
    for key, record, point in zip(walk.keys, whole, points):
        assert key == point.key and {**found[key], "seconds": 0} == {**record, "seconds": 0}
        assert {**point.record, "seconds": 0} == {**record, "seconds": 0}
    lines = [line for path in (tmp_path / "points").iterdir() for line in path.read_bytes().splitlines()]
    assert len(lines) == len(whole) and points[1].outcome.balance is not None
    assert points[0].outcome.balance is None and not any((tmp_path / "states").iterdir())


def test_a_lost_or_damaged_state_is_solved_again_to_the_same_bits(serial, tmp_path):
    lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path)
    for path in (tmp_path / "points").iterdir():
        lines = path.read_bytes().splitlines(keepends=True)
        path.write_bytes(b"".join(lines[:-1]) + lines[-1][:50])
    found = lubfric.open_study(tmp_path)
    assert found.missing == len(list((tmp_path / "points").iterdir())) and "not computed" in found.status
    same(lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path), serial)


def test_two_writers_are_refused(tmp_path):
    with lubfric.studies.FolderLock(tmp_path):
        with pytest.raises(lubfric.InputError, match="another run"):
            lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path)


def suicidal(batch):
    if batch.walks[0].index == (1, 0) and os.getpid() != PARENT:
        if batch.folder is not None:  # after its first point
            next(points_of(batch))
        os.kill(os.getpid(), signal.SIGKILL)
    return rows_of(batch)


PARENT = os.getpid()


@pytest.mark.parametrize("stored", [False, True])
def test_a_killed_worker_loses_nothing(serial, tmp_path, monkeypatch, stored):
    monkeypatch.setattr(run_module, "rows_of", suicidal)
    monkeypatch.setattr("lubfric.studies.plan.BATCH", 1)
    with ProcessPoolExecutor(2) as executor:
        found = lubfric.study(SCENE, VARY, SPEEDS, executor=executor, store=tmp_path if stored else None)
    same(found, serial)
    if stored:
        keys = [line[17:] for p in (tmp_path / "points").iterdir() for line in p.read_bytes().splitlines()]
        assert len(keys) == found.status.size


def test_a_piece_that_is_handed_out_again_solves_nothing_again(tmp_path, monkeypatch):
    """As by a cluster that lost its rows with the worker that held them."""

    class Twice(ThreadPoolExecutor):
        def submit(self, work, *arguments):
            return super().submit(lambda: [work(*arguments) for _ in range(2)][1])

    with Twice(1) as executor:
        found = lubfric.study(SCENE, {}, SPEEDS, executor=executor, store=tmp_path)
    lines = [line for path in (tmp_path / "points").iterdir() for line in path.read_bytes().splitlines()]
    assert found.missing == found.failed == 0 and len(lines) == found.status.size
    assert not list((tmp_path / "states").iterdir())


# failures


def test_a_failing_point_is_a_row_with_its_status(serial, monkeypatch, tmp_path):
    real = trail.friction

    def failing(model, speed, **options):
        if speed == 0.03 and model.scene.surface.seed == 2:
            raise lubfric.ConvergenceError("injected", lubfric.Report("x", "diverged", 1, float("inf"), 0.1))
        return real(model, speed, **options)

    monkeypatch.setattr(trail, "friction", failing)
    found = lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path)
    assert found.failed == 2 and set(found.status[:, 1, 1]) == {"ConvergenceError: injected"}
    assert np.isnan(found["coefficient"][:, 1, 1]).all() and np.isfinite(found["coefficient"]).sum() == 10
    np.testing.assert_array_equal(found["coefficient"][:, 0], serial["coefficient"][:, 0])
    errors = [outcome_of(record) for record in Journal(tmp_path).records().values() if "error" in record]
    assert errors[0].report.status == "diverged" and errors[0].report.residual == float("inf")


def test_a_scene_that_cannot_be_made_ready_is_a_row_too():
    found = lubfric.study(SCENE, {"contact.spacing": [1.1e-6, 1e-4]}, SPEEDS)
    assert (found.status[0] == "converged").all() and "InputError: correlation_length" in found.status[1, 0]


def faulty(*_, **__):
    raise ZeroDivisionError("a fault of the program")


@pytest.mark.parametrize("pool", [None, ThreadPoolExecutor])
def test_a_fault_of_the_program_is_raised_as_it_is(monkeypatch, pool, tmp_path):
    monkeypatch.setattr("lubfric.studies.trail.friction", faulty)
    executor = pool(2) if pool else None
    with pytest.raises(ZeroDivisionError, match="a fault of the program"):
        lubfric.study(SCENE, VARY, SPEEDS, executor=executor, store=tmp_path)


def test_an_interrupt_keeps_what_is_done(tmp_path, monkeypatch):
    monkeypatch.setattr("lubfric.studies.plan.BATCH", 1)

    def on_progress(done, total):
        if done == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        lubfric.study(SCENE, {"lubricant.viscosity": [0.2, 0.3]}, SPEEDS, store=tmp_path, on_progress=on_progress)
    found = lubfric.open_study(tmp_path)
    assert (found.status[0] == "converged").all() and found.missing == 3


# what can be varied


def test_keys_that_go_together_and_samples():
    points = lubfric.sample([lubfric.Between(1.0, 10.0), lubfric.Between(0.01, 1.0, "log")], 8, seed=3)
    plan = lubfric.plan_study(
        SCENE, {("bodies.load", "lubricant.viscosity"): points, "contact.region": ["hertz", "box"]}, [0.1]
    )
    assert plan.shape == (8, 2, 1) and [axis.name for axis in plan.axes] == ["case", "contact.region"]
    curve = next(walk for walk in plan.walks if walk.index == (5, 1))
    assert (curve.scene.bodies.load, curve.scene.lubricant.viscosity) == points[
        5
    ] and curve.scene.contact.region == "box"


def test_samples_fill_their_ranges():
    ranges = [lubfric.Between(1.0, 10.0), lubfric.Between(0.01, 1.0, "log")]
    sobol = np.array(lubfric.sample(ranges, 64, seed=3))
    shares = np.stack([(sobol[:, 0] - 1) / 9, np.log(sobol[:, 1] / 0.01) / np.log(100)], axis=1)
    for column in shares.T:  # one point in each of the 64 equal parts of every range
        assert sorted((column * 64).astype(int)) == list(range(64))
    assert (
        lubfric.sample(ranges, 64, seed=3) == lubfric.sample(ranges, 64, seed=3) != lubfric.sample(ranges, 64, seed=4)
    )
    spread = np.array(lubfric.sample(ranges, 4000, "random", seed=1))
    assert np.log10(spread[:, 1]).mean() == pytest.approx(-1.0, abs=0.05)
    assert spread[:, 0].mean() == pytest.approx(5.5, abs=0.2)


def test_several_maps(tmp_path):
    maps = []
    for seed in (1, 2):
        surface = lubfric.generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=4e-6, seed=seed)
        np.save(tmp_path / f"{seed}.npy", surface.heights)
        maps.append({"file": str(tmp_path / f"{seed}.npy"), "spacing": 1e-6, "correlation_length": None, "sq": None})
    scene = SCENE.with_(contact={"shape": None, "spacing": None})
    found = lubfric.study(scene, {"surface": maps}, [0.01])
    for i, part in enumerate(maps):
        alone = lubfric.friction(scene.with_(surface=part), 0.01).coefficient
        assert found["coefficient"][i, 0] == pytest.approx(alone, rel=0.01)
    assert found.coords["surface"][1][1].startswith('{"file"')


@pytest.mark.parametrize(
    "vary, speeds, words",
    [
        ({"bodies.laod": [1]}, None, "did you mean 'load'"),
        ({"bodys.load": [1]}, None, "did you mean 'bodies'"),
        ({"bodies.load": 5.0}, None, "a list of values"),
        ({"bodies.load": []}, None, "a list of values"),
        ({"bodies.load": lubfric.Between(1, 2)}, None, "lubfric.sample"),
        ({"bodies.load": [-1.0]}, None, "bodies.load = -1 N"),
        ({("bodies.load", "bodies.radius"): [(1.0,)]}, None, "go together"),
        ({"bodies.load": [1.0], ("bodies.load", "bodies.width"): [(1, 2)]}, None, "given twice"),
        ({"motion.speeds": [(1.0,)]}, None, "speeds = "),
        ({"transient.duration": [1.0]}, None, "no key of a scene"),
        ([1], None, "a dict"),
        ({}, [0.1, 0.1], "twice"),
        ({}, ["a"], "speeds"),
        ({}, "aut", "speeds in m/s, or 'auto'"),
    ],
)
def test_what_cannot_be_varied_is_said_before_any_work(vary, speeds, words, tmp_path):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.study(SCENE, vary, speeds, store=tmp_path / "store")
    assert not (tmp_path / "store").exists()


@pytest.mark.parametrize("arguments", [([], 4), ([1], 4), ([lubfric.Between(0, 1)], 3), ([lubfric.Between(0, 1)], 0)])
def test_bad_samples(arguments):
    with pytest.raises(lubfric.InputError):
        lubfric.sample(*arguments)
    with pytest.raises(lubfric.InputError):
        lubfric.Between(0.0, 1.0, "log")


def test_explain_counts_before_anything_is_solved(monkeypatch):
    monkeypatch.setattr("lubfric.studies.trail.prepare", None)
    plan = lubfric.plan_study(SCENE, VARY | {"lubricant.viscosity": [0.1] * 5}, np.geomspace(1e-3, 1, 60))
    text = plan.explain()
    for words in (
        "1200 points",
        "2 x bodies.load 3, 5.5",
        "60 speeds",
        "2 height maps",
        "60 chains of up to 20 speeds",
    ):
        assert words in text, text
    assert "processes share it" in text and " batches, each of one map" in text
    one = lubfric.plan_study(SCENE, {"contact.spacing": [1e-4]}).explain()
    assert "cannot be solved: correlation_length" in one and "1 height map, " in one
    assert "1 batch, each of" in one and "processes share it" not in one
    sampled = lubfric.sample([lubfric.Between(0.05, 0.4)], 16)
    drawn = [value for (value,) in sampled]
    many = lubfric.plan_study(SCENE, {"lubricant.viscosity": sampled}, [0.01]).explain()
    assert f"16 x lubricant.viscosity {min(drawn):.4g} to {max(drawn):.4g}" in many


def test_progress_on_an_executor_is_that_of_the_store(tmp_path, monkeypatch):
    """A batch comes back only when it ends; its points are counted as they reach the store. None is counted twice."""
    told: list[tuple[int, int]] = []
    monkeypatch.setattr("lubfric.studies.spread.LOOK", 0.01)
    with ThreadPoolExecutor(1) as executor:
        for _ in range(2):
            lubfric.study(
                SCENE,
                {"bodies.load": [3.0, 4.0, 5.5]},
                np.geomspace(1e-3, 0.3, 8),
                executor=executor,
                store=tmp_path,
                on_progress=lambda *what: told.append(what),
            )
    done = [number for number, _ in told]
    first = done.index(24) + 1
    assert done[0] == 0 and done[:first] == sorted(set(done)) and first > 6 and done[first:] == [24]
    assert {total for _, total in told} == {24}


@pytest.mark.parametrize("speeds", [np.geomspace(1e-3, 0.3, 4), "auto"])
def test_explain_leaves_out_what_the_store_holds(tmp_path, speeds):
    """Half of a study is solved in a store: the rest of the whole costs what the other half costs alone."""
    half, other = ({"lubricant.viscosity": [0.1]}, {"lubricant.viscosity": [0.3]})
    both = lubfric.plan_study(SCENE, {"lubricant.viscosity": [0.1, 0.3]}, speeds)
    lubfric.study(SCENE, half, speeds, store=tmp_path)
    count, what = (1, "curves") if isinstance(speeds, str) else (len(speeds), "points")
    assert f"{count} of {2 * count} {what} are in {tmp_path}" in both.explain(tmp_path)
    known = Journal(tmp_path).records()
    alone, rest = lubfric.plan_study(SCENE, other, speeds), [_costs(both, known)[1] for _ in range(3)]
    assert 0.4 < np.median(rest) / np.median([_costs(alone)[1] for _ in range(3)]) < 2.5
    assert np.median(rest) < np.median([_costs(both)[1] for _ in range(3)])
    lubfric.study(both, store=tmp_path)
    assert "nothing is left to solve" in both.explain(tmp_path) and _costs(both, Journal(tmp_path).records())[1] == 0
    assert not (tmp_path / "nowhere").exists() and "kept" not in both.explain(tmp_path / "nowhere")
    assert not (tmp_path / "nowhere").exists()


# tables


def test_tables_hold_the_same_numbers(serial, tmp_path):
    pytest.importorskip("xarray"), pytest.importorskip("pandas")
    data, frame = serial.to_xarray(), serial.to_frame()
    picked = data.coefficient.sel({"bodies.load": 5.5, "surface.seed": 2}).sel(speed=0.03)
    row = frame[(frame["bodies.load"] == 5.5) & (frame["surface.seed"] == 2) & (frame["speed"] == 0.03)]
    assert float(picked) == row["coefficient"].item() == serial["coefficient"][1, 1, 1]
    assert data.contact_load.attrs == {"units": "N", "long_name": "load carried by the rough contact"}
    assert data["bodies.load"].attrs["units"] == "N" and set(data.status.values.flat) == {"converged"}
    serial.to_csv(tmp_path / "study.csv")
    heading, *rows = (tmp_path / "study.csv").read_text().splitlines()
    assert heading.startswith("bodies.load [N],surface.seed,speed [m/s],coefficient [-]") and len(rows) == 12
    assert float(rows[10].split(",")[3]) == serial["coefficient"][1, 1, 1]


def test_netcdf_and_parquet_round_trips(serial, tmp_path):
    xarray, pandas = pytest.importorskip("xarray"), pytest.importorskip("pandas")
    pytest.importorskip("netCDF4"), pytest.importorskip("pyarrow")
    serial.to_xarray().to_netcdf(tmp_path / "study.nc")
    with xarray.open_dataset(tmp_path / "study.nc") as again:
        np.testing.assert_array_equal(again.coefficient, serial["coefficient"])
    serial.to_parquet(tmp_path / "study.parquet")
    assert pandas.read_parquet(tmp_path / "study.parquet")["coefficient"].tolist() == list(serial["coefficient"].flat)


def test_zarr_round_trip(serial, tmp_path):
    """Numbers, names of the axes, status and units, read by xarray alone."""
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr", "3")
    data = serial.to_xarray()
    data.to_zarr(tmp_path / "study.zarr", zarr_format=2)
    with xarray.open_zarr(tmp_path / "study.zarr") as again:
        assert again.sizes == data.sizes and set(again.variables) == set(data.variables)
        for name in data.variables:
            np.testing.assert_array_equal(again[name].values, data[name].values, err_msg=name)
            assert again[name].attrs == data[name].attrs
        assert again.attrs == data.attrs


def test_a_missing_tool_is_named_with_its_extra(serial, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(lubfric.InputError, match=r"needs the package xarray: pip install 'lubfric\[study\]'"):
        serial.to_xarray()


def test_the_store_is_plain_json(serial, tmp_path):
    lubfric.study(SCENE, {}, [0.01], store=tmp_path)
    plan = json.loads((tmp_path / "study.json").read_text())
    (path,) = (tmp_path / "points").iterdir()
    (line,) = path.read_text().splitlines()
    record = json.loads(line.split(" ", 1)[1])
    assert record["key"] == plan["keys"][0] and 0 < record["value"]["coefficient"] < 0.1


def test_folders_that_are_no_store(tmp_path):
    with pytest.raises(lubfric.InputError, match="holds no study.json"):
        lubfric.open_study(tmp_path)
    (tmp_path / "study.json").write_text('{"keys": ')
    with pytest.raises(lubfric.InputError, match="damaged"):
        lubfric.open_study(tmp_path)


def test_every_part_of_a_scene_makes_another_key():
    """Whatever is varied, no two points share a key: also parts that few scenes have."""
    for section, field, values in (
        ("motion", "slide_roll_ratio", [0.5, 1.0]),
        ("numerics", "tolerance", [0.01, 0.02]),
        ("contact", "region", ["hertz", "box"]),
        ("surface", "seed", [1, 2]),
        ("lubricant", "eyring_stress", [None, 5e6]),
        ("bodies", "conductivity", [(46.0, 46.0), (46.0, 3.0)]),
    ):
        plan = lubfric.plan_study(SCENE, {f"{section}.{field}": values}, SPEEDS)
        assert len(set(plan.keys().flat)) == plan.points, field
    both = lubfric.plan_study(SCENE, {"counterface": [None, {"sq": 1e-8, "correlation_length": 4e-6}]}, SPEEDS)
    assert len(set(both.keys().flat)) == both.points and len(both.batches) == 2
