"""Studies: every point is what friction gives, on any executor and after any kill; lost workers, failures, tables."""

import csv
import math
import os
import signal
import time
import warnings
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scene_text import paper_scene
from small_study import SCENE, same, slowness

import lubfric
from lubfric._base import FolderLock
from lubfric.studies import points, pool

ROOT = Path(__file__).parents[2]
SPEEDS = (0.003, 0.03, 0.3)
VARY = {"bodies.load": [3.0, 5.5], "surface.seed": [1, 2]}


@pytest.fixture(scope="module")
def serial():
    return lubfric.study(SCENE, VARY, SPEEDS)


def records(folder):
    return [path for path in (folder / "points").glob("*.bin") if path.stem != "plan"]


# what is computed


def test_every_point_is_what_friction_gives(serial):
    """To the last bit: alone, in a curve, in a study."""
    assert serial.dims == ("bodies.load", "surface.seed", "speed") and serial.status.shape == (2, 2, 3)
    assert serial.failed == serial.missing == 0
    for i, load in enumerate(VARY["bodies.load"]):
        for j, seed in enumerate(VARY["surface.seed"]):
            scene = SCENE.with_(bodies={"load": load}, surface={"seed": seed})
            alone = [lubfric.friction(scene, speed).coefficient for speed in SPEEDS]
            np.testing.assert_array_equal(serial["coefficient"][i, j], alone)
    np.testing.assert_array_equal(lubfric.stribeck(scene, SPEEDS[::-1]).coefficient, alone[::-1])


@pytest.mark.parametrize("first", ["bodies.hertz_pressure", "bodies.radius"])
def test_keys_of_several_dimensions_act_together(first):
    """A Hertz pressure is that with the radius of the same point, w = 2 pi R p²/E', whichever key comes first."""
    vary = {"bodies.hertz_pressure": [1e8, 2e8], "bodies.radius": [2e-3, 4e-3]}
    plan = lubfric.plan_study(SCENE, {first: vary[first], **vary}, SPEEDS)
    for index, scene in zip(np.ndindex(*plan.shape[:-1]), plan.scenes):
        at = {axis.name: axis.values[i][0] for axis, i in zip(plan.axes, index)}
        bodies = scene.bodies
        assert bodies.radius == at["bodies.radius"]
        load = 2 * np.pi * bodies.radius * at["bodies.hertz_pressure"] ** 2 / bodies.e_prime * bodies.width
        assert bodies.load == pytest.approx(load, rel=1e-12)


@pytest.mark.parametrize(
    "vary, words",
    [
        ({"bodies.load": [3.0, 5.5], "bodies.hertz_pressure": [1e8]}, "give the same quantity"),
        ({"motion.slip_percent": [10.0], "motion.slide_roll_ratio": [0.1, 2.0]}, "give the same quantity"),
        ({"motion.surface_speeds": [(0.0, 0.1), (0.0, 0.2)]}, "give speeds"),
        ({"motion.speed_range": [(0.1, 1.0, 3)]}, "give speeds"),
        ({"lubricant.temperature_celsius": [40.0, 80.0]}, "does not change a viscosity"),
    ],
)
def test_keys_of_which_one_would_do_nothing_are_refused(vary, words):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.plan_study(SCENE, vary, [0.1])


def test_warnings_and_accepted_points_are_marked(tmp_path):
    """A turbulent film: refused, or accepted and marked, in every table."""
    thin = SCENE.with_(surface={"sq": 0.0}, lubricant={"viscosity": 0.005})
    vary = {"numerics.accept": [False, True], "motion.slide_roll_ratio": [1.0, 2.0]}
    result = lubfric.study(thin, vary, [1.0, 1000.0], store=tmp_path)
    point = lubfric.friction(thin.with_(numerics={"accept": True}), 1000.0)
    assert any(entry.severe for entry in point.validity)
    assert result.status[0, 1, 1].startswith("ValidityError") and result.status[1, 1, 1] == "converged"
    assert (result.model[0, 1, 1], result.model[1, 1, 1]) == ("", "paper")
    assert result.validity[1, 1, 1] == " | ".join(entry.text for entry in point.validity)
    assert "not valid" in result.validity[1, 1, 1] and result.validity[1, 0, 0] == ""
    assert result.with_warnings == np.count_nonzero(result.validity != "") and "with warnings" in repr(result)
    same(lubfric.open_study(tmp_path), result)
    assert (lubfric.open_study(tmp_path).validity == result.validity).all()
    result.to_csv(tmp_path / "t.csv")
    rows = list(csv.DictReader((tmp_path / "t.csv").read_text().splitlines()))
    assert [row["validity"] for row in rows] == result.validity.ravel().tolist()
    assert {name for name in rows[0] if "[" not in name} == {"numerics.accept", "status", "model", "validity"}
    assert {"line_length [m]", "numerical_error [-]", "speed [m/s]"} <= set(rows[0])


def test_all_tables_have_one_name_for_one_number(tmp_path):
    """A point of a Stribeck curve, of a traction curve and of a study is a row of the same numbers, whose headings
    agree but for what each table is over."""
    lines = {
        "stribeck": lubfric.studies.csv_bytes(lubfric.stribeck(SCENE, [0.03])),
        "traction": lubfric.studies.csv_bytes(lubfric.traction(SCENE, [SCENE.motion.slide_roll_ratio], speed=0.03)),
    }
    study = lubfric.study(SCENE, {}, [0.03])
    study.to_csv(tmp_path / "study.csv")
    lines["study"] = (tmp_path / "study.csv").read_bytes()
    rows = {name: next(csv.DictReader(text.decode().splitlines())) for name, text in lines.items()}
    texts = {"status", "model", "validity", "uncertainty", "ratio [-]"}
    assert {row["model"] for row in rows.values()} == {"paper"}
    numbers = {name: {key: float(cell) for key, cell in row.items() if key not in texts} for name, row in rows.items()}
    assert set(numbers["study"]) == set(numbers["stribeck"]) == set(numbers["traction"])
    assert {"interval_low [-]", "model_error_high [-]", "input_error_low [-]"} <= set(numbers["study"])
    for key, number in numbers["stribeck"].items():
        assert numbers["traction"][key] == pytest.approx(number, nan_ok=True), key
        assert numbers["study"][key] == pytest.approx(number, nan_ok=True), key


def test_a_study_takes_the_earlier_names_of_its_columns(serial):
    for old, column in {"low": "interval_low", "sampling": "sampling_error", "length": "line_length"}.items():
        assert serial[f"uncertainty_{old}"] is serial[column]
    with pytest.raises(lubfric.InputError, match="no column"):
        serial["uncertainty_of_all"]


def test_temperatures_are_varied_with_a_viscosity():
    keys = ("lubricant.temperature", "lubricant.viscosity")
    numbers = lubfric.plan_study(SCENE, {keys: [(313.15, 0.2), (353.15, 0.05)]}, [0.1])
    assert [scene.lubricant.viscosity for scene in numbers.scenes] == [0.2, 0.05]
    oil = {"lubricant.nu40": 68e-6, "lubricant.nu100": 8.6e-6, "lubricant.temperature": 313.15}
    oils = lubfric.plan_study(SCENE.with_keys(oil), {"lubricant.temperature_celsius": [40.0, 100.0]}, [0.1])
    cold, hot = (scene.lubricant.viscosity for scene in oils.scenes)
    assert hot < 0.2 * cold


def test_oils_and_whole_sections_are_named_in_the_tables(tmp_path):
    oils = [lubfric.oil.from_grade("ISO VG 68", index) for index in (60, 160)]
    warm = SCENE.with_(lubricant={"oil": oils[0], "temperature": 330.0}, surface={"sq": 0.0})
    warm = warm.with_(counterface={"sq": 0.0, "correlation_length": 4e-6})
    vary = {"lubricant.oil": oils, "surface": [warm.surface, replace(warm.surface, seed=5)], "counterface.sq": [0.0]}
    result = lubfric.study(warm, vary, [1.0], store=tmp_path / "study")
    result.to_csv(tmp_path / "table.csv")
    lines = (tmp_path / "table.csv").read_text().splitlines()
    assert len(lines) == 5 and result.failed == 0 and "counterface.sq [m],speed [m/s],coefficient [-]" in lines[0]
    assert "ISO VG 68, VI 60" in lines[1] and "ISO VG 68, VI 160" in lines[-1] and "seed=5" in lines[2]
    same(lubfric.open_study(tmp_path / "study"), result)


def test_paths_and_numbers_of_numpy_are_kept_with_the_plan(tmp_path):
    """Inside a section too; a TypeError and a plan that could not be read, once."""
    np.save(tmp_path / "map.npy", lubfric.prepare(SCENE).surface.heights)
    sections = [{"file": tmp_path / "map.npy", "spacing": np.float32(1e-6)}]
    study = lubfric.study(SCENE.with_(numerics={"accept": True}), {"surface": sections}, [0.3], store=tmp_path)
    same(lubfric.open_study(tmp_path), study)


def test_any_number_of_processes_gives_the_same_bits(serial):
    """Of a study, of a curve whose speeds they share, and of one with fewer speeds than processes."""
    same(lubfric.study(SCENE, VARY, SPEEDS, workers=2), serial)
    for speeds in (SPEEDS, SPEEDS[:1]):
        one, two = (lubfric.stribeck(SCENE, speeds, workers=workers) for workers in (1, 2))
        np.testing.assert_array_equal(one.coefficient, two.coefficient)
        np.testing.assert_array_equal(one.uncertainty.interval, two.uncertainty.interval)
    with ThreadPoolExecutor(1) as executor, pytest.raises(lubfric.InputError, match="workers"):
        lubfric.stribeck(SCENE, SPEEDS, executor, workers=2)


@pytest.mark.parametrize("kind", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_gives_the_same_bits(serial, kind, tmp_path):
    with kind(2) as executor:
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=executor, store=tmp_path), serial)
    same(lubfric.open_study(tmp_path), serial)


def test_a_longer_study_takes_over_what_is_known(serial, tmp_path, monkeypatch):
    lubfric.study(SCENE, {"bodies.load": [5.5], "surface.seed": [1, 2]}, SPEEDS[1:], store=tmp_path)
    solved = []
    real = points.friction
    monkeypatch.setattr(points, "friction", lambda *args, **kw: solved.append(args) or real(*args, **kw))
    same(lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path), serial)
    assert len(solved) == len(records(tmp_path)) - 4 == 8


# kept through everything


def test_two_writers_are_refused(tmp_path):
    with FolderLock(tmp_path):
        with pytest.raises(lubfric.InputError, match="another run"):
            lubfric.study(SCENE, VARY, SPEEDS, store=tmp_path)
        with pytest.raises(lubfric.InputError, match="another run"):
            lubfric.stribeck(SCENE, SPEEDS, store=tmp_path)


def suicidal(model, speed, **options):
    """Kills the process of an executor that has solved one point of the first curve."""
    if speed == SPEEDS[1] and model.scene.surface.seed == 1 and os.getpid() != PARENT:
        os.kill(os.getpid(), signal.SIGKILL)
    return FRICTION(model, speed, **options)


PARENT = os.getpid()
FRICTION = lubfric.friction


@pytest.mark.parametrize("stored", [False, True])
def test_a_killed_worker_loses_nothing(serial, tmp_path, monkeypatch, stored):
    monkeypatch.setattr(points, "friction", suicidal)
    with ProcessPoolExecutor(2) as executor:
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=executor, store=tmp_path if stored else None), serial)
    assert len(records(tmp_path)) == (serial.status.size if stored else 0)


def test_a_piece_that_is_handed_out_again_solves_nothing_again(tmp_path, monkeypatch):
    """As by a cluster that lost its rows with the worker that held them."""

    class Twice(ThreadPoolExecutor):
        def submit(self, work, *arguments):
            return super().submit(lambda: [work(*arguments) for _ in range(2)][1])

    solved = []
    monkeypatch.setattr(points, "friction", lambda *args, **kw: solved.append(args) or FRICTION(*args, **kw))
    with Twice(1) as executor:
        result = lubfric.study(SCENE, {}, SPEEDS, executor=executor, store=tmp_path)
    assert result.missing == result.failed == 0 and len(solved) == len(records(tmp_path)) == result.status.size


# failures


def test_a_scene_that_cannot_be_made_ready_is_a_row_too():
    result = lubfric.study(SCENE, {"contact.spacing": [1.1e-6, 1e-4]}, SPEEDS)
    assert (result.status[0] == "converged").all() and "InputError: correlation_length" in result.status[1, 0]


def test_an_interrupt_keeps_what_is_done_and_progress_counts_it(tmp_path):
    stated = []

    def on_progress(done, total):
        stated.append((done, total))
        if len(stated) == 5:
            os.kill(os.getpid(), signal.SIGINT)

    vary = {"lubricant.viscosity": [0.2, 0.3]}
    with pytest.raises(KeyboardInterrupt):
        lubfric.study(SCENE, vary, SPEEDS, store=tmp_path, on_progress=on_progress)
    result = lubfric.open_study(tmp_path)
    assert (result.status[0] == "converged").all() and result.missing == 2
    with ThreadPoolExecutor(2) as executor:
        lubfric.study(SCENE, vary, SPEEDS, store=tmp_path, executor=executor, on_progress=on_progress)
    assert stated == [(done, 6) for done in (0, 1, 2, 3, 4, 4, 5, 6)]


def test_an_interrupt_waits_until_all_processes_have_begun(monkeypatch):
    """Else one of them ends with a traceback, before it leaves interrupts to the command."""
    begun = []
    submit = ProcessPoolExecutor.submit
    send = signal.raise_signal
    monkeypatch.setattr(ProcessPoolExecutor, "submit", lambda *a: begun.append(submit(*a)) or send(signal.SIGINT))
    with pytest.raises(KeyboardInterrupt), pool(3):
        pass
    assert len(begun) == 3


# what can be varied


def test_a_range_with_units_is_that_of_its_key():
    drawn = lubfric.sample([lubfric.Between("1 N", "0.01 kN"), lubfric.Between("20 °C", "60 °C")], 4, seed=3)
    plain = lubfric.sample([lubfric.Between(1.0, 10.0), lubfric.Between(20.0, 60.0)], 4, seed=3)
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 40}
    scene = SCENE.with_(lubricant=oil)
    keys = ("bodies.load", "lubricant.temperature_celsius")
    (axis,), (same,) = (lubfric.plan_study(scene, {keys: values}, [0.1]).axes for values in (drawn, plain))
    assert np.array(axis.values) == pytest.approx(np.array(same.values), rel=1e-12)
    with pytest.raises(lubfric.InputError, match="does not convert"):
        lubfric.Between("1 N", "2 m")
    with pytest.raises(lubfric.InputError, match="does not convert"):
        lubfric.plan_study(SCENE, {"bodies.radius": [v for v, _ in drawn]}, [0.1])


def test_samples_fill_their_ranges():
    ranges = [lubfric.Between(1.0, 10.0), lubfric.Between(0.01, 1.0, "log")]
    sobol = np.array(first := lubfric.sample(ranges, 64, seed=3))
    for column in ((sobol[:, 0] - 1) / 9, np.log(sobol[:, 1] / 0.01) / np.log(100)):  # one point in each of 64 parts
        assert sorted((column * 64).astype(int)) == list(range(64))
    assert lubfric.sample(ranges, 64, seed=3) == first != lubfric.sample(ranges, 64, seed=4)
    spread = np.array(lubfric.sample(ranges, 4000, "random", seed=1))
    assert np.log10(spread[:, 1]).mean() == pytest.approx(-1.0, abs=0.05)
    assert spread[:, 0].mean() == pytest.approx(5.5, abs=0.2)


def test_normal_samples_have_their_moments_and_no_correlation():
    """Of the value, also where its logarithm is normal; between limits those of the normal distribution cut off there,
    sd φ(0)/(Φ(1) - Φ(0)) (1 - exp(-1/2)) above the mean."""
    ranges = [
        lubfric.studies.Normal(mean=5.0, standard_deviation=0.8),
        lubfric.studies.Normal(mean="30 mm/s", standard_deviation="15 mm/s", scale="log"),
        lubfric.studies.Normal(mean=5.0, standard_deviation=0.8, low=5.0, high=5.8),
    ]
    drawn = lubfric.sample(ranges, 2**12, seed=2)
    assert drawn == lubfric.sample(ranges, 2**12, seed=2) != lubfric.sample(ranges, 2**12, seed=3)
    values = np.array([(load, float(speed.removesuffix(" m/s")), cut) for load, speed, cut in drawn])
    assert values.mean(axis=0)[:2] == pytest.approx([5.0, 0.03], rel=1e-3)
    assert values.std(axis=0)[:2] == pytest.approx([0.8, 0.015], rel=0.01)
    assert np.log(values[:, 1]).std() == pytest.approx(math.sqrt(math.log(1.25)), rel=0.01)
    assert np.corrcoef(values.T) == pytest.approx(np.eye(3), abs=0.01)
    above = 0.8 * (1 - math.exp(-0.5)) / math.sqrt(2 * math.pi) / (0.5 * math.erf(math.sqrt(0.5)))
    assert values[:, 2].mean() == pytest.approx(5.0 + above, rel=1e-4)
    assert 5.0 <= values[:, 2].min() and values[:, 2].max() <= 5.8
    assert abs(np.corrcoef(np.array(lubfric.sample(ranges[:1] * 2, 4096, "random")).T)[0, 1]) < 0.05
    assert lubfric.studies.Normal(mean="60 °C", standard_deviation="5 °C") == lubfric.studies.Normal(
        mean="333.15 K", standard_deviation="5 K"
    )


@pytest.mark.parametrize(
    "values, words",
    [
        ({"mean": 1.0, "standard_deviation": 0.0}, "standard_deviation = 0"),
        ({"mean": -1.0, "standard_deviation": 1.0, "scale": "log"}, "mean = -1"),
        ({"mean": 1.0, "standard_deviation": 0.1, "low": 2.0}, "contain 0 % of the normal"),
        ({"mean": "1 N", "standard_deviation": "1 m"}, "convert to N and m"),
    ],
)
def test_what_is_no_normal_distribution_is_refused(values, words):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.studies.Normal(**values)


@pytest.mark.parametrize(
    "vary, speeds, words",
    [
        ({"bodies.laod": [1]}, None, "did you mean 'load'"),
        ({"bodies.load": 5.0}, None, "a list of values"),
        ({"bodies.load": lubfric.Between(1, 2)}, None, "lubfric.sample"),
        ({"bodies.load": [-1.0]}, None, "bodies.load = -1 N"),
        ({("bodies.load", "bodies.radius"): [(1.0,)]}, None, "go together"),
        ({"bodies.load": [1.0], ("bodies.load", "bodies.width"): [(1, 2)]}, None, "given twice"),
        ({"motion.speeds": [(1.0,)]}, None, "speeds = "),
        ({"transient.duration": [1.0]}, None, "unknown key 'transient' in vary"),
        ([1], None, "a dict"),
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


# what is said before


def test_explain_counts_before_anything_is_solved(monkeypatch):
    monkeypatch.setattr(points, "friction", None)
    many = VARY | {"lubricant.viscosity": [0.1, 0.2, 0.3, 0.4, 0.5]}
    plan = lubfric.plan_study(SCENE, many, np.geomspace(1e-3, 1, 60))
    text = plan.explain()
    for words in ("1200 points", "2 x bodies.load 3 N, 5.5 N", "viscosity 100 mPa s to 500 mPa s", "60 speeds"):
        assert words in text, text
    assert "cannot be solved: correlation_length" in lubfric.plan_study(SCENE, {"contact.spacing": [1e-4]}).explain()
    moving = SCENE.with_(transient=lubfric.Transient(duration=0.1))
    assert "[transient]) are ignored" in lubfric.plan_study(moving, {}, [0.1]).explain()
    assert "about 12 speeds that each curve chooses" in lubfric.plan_study(SCENE, {}, "auto").explain()


@pytest.mark.parametrize(
    "scene, speeds",
    [(SCENE, np.geomspace(1e-3, 1.0, 7)), (paper_scene(), (0.003, 0.3)), (lubfric.load_scene("paper"), (0.1,))],
    ids=["patch", "strips", "both models"],
)
def test_the_time_is_estimated_within_a_factor_of_three(scene, speeds):
    """In processor seconds of the machine that the forecast was made on: between two measurements of this one."""
    plan = lubfric.plan_study(scene.with_(numerics={"sampling_tolerance": 0.05}), {}, speeds)
    plan.explain()  # the packages that making a map needs are loaded
    number, unit = plan.explain().partition("time     about ")[2].split()[:2]
    before = slowness()
    begun = time.process_time()
    lubfric.study(plan)
    took = (time.process_time() - begun) / (0.5 * (before + slowness()))
    assert unit == "s" and 1 / 3 < float(number) / took < 3, (number, took)


@pytest.mark.parametrize("speeds", [(0.003, 0.03, 0.3, 1.0), pytest.param("auto", marks=pytest.mark.slow)])
def test_explain_omits_what_the_store_holds(tmp_path, speeds):
    both = lubfric.plan_study(SCENE, {"lubricant.viscosity": [0.1, 0.3]}, speeds)
    lubfric.study(SCENE, {"lubricant.viscosity": [0.1]}, speeds, store=tmp_path)
    count, what = (1, "curves") if isinstance(speeds, str) else (len(speeds), "points")
    assert f"{count} of {2 * count} {what} are in {tmp_path}" in both.explain(tmp_path)
    lubfric.study(both, store=tmp_path)
    assert "nothing is left to solve" in both.explain(tmp_path)
    assert "kept" not in both.explain(tmp_path / "nowhere") and not (tmp_path / "nowhere").exists()


# tables


def test_tables_hold_the_same_numbers(serial, tmp_path):
    pytest.importorskip("xarray"), pytest.importorskip("pandas")
    data = serial.to_xarray()
    frame = serial.to_frame()
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
    xarray = pytest.importorskip("xarray")
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("netCDF4"), pytest.importorskip("pyarrow")
    serial.to_xarray().to_netcdf(tmp_path / "study.nc")
    with xarray.open_dataset(tmp_path / "study.nc") as again:
        np.testing.assert_array_equal(again.coefficient, serial["coefficient"])
    serial.to_parquet(tmp_path / "study.parquet")
    assert pandas.read_parquet(tmp_path / "study.parquet")["coefficient"].tolist() == list(serial["coefficient"].flat)


def test_folders_that_are_no_store(tmp_path):
    with pytest.raises(lubfric.InputError, match="has no study"):
        lubfric.open_study(tmp_path)
    (tmp_path / "points").mkdir()
    (tmp_path / "points" / "plan.bin").write_text("[]")
    with pytest.raises(lubfric.InputError, match="damaged"), pytest.warns(UserWarning, match="damaged"):
        lubfric.open_study(tmp_path)
    lubfric.study(SCENE, {}, [0.01], store=tmp_path)
    assert lubfric.open_study(tmp_path).plan.speeds == (0.01,)


def test_records_of_another_scene_are_named(tmp_path):
    """A folder that another scene was solved into: its points stay, do not count, and are reported."""
    lubfric.study(SCENE, {"bodies.load": [1.0, 2.0]}, [0.01, 0.02], store=tmp_path)
    same_plan = lubfric.plan_study(SCENE, {"bodies.load": [1.0, 2.0]}, [0.01, 0.02])
    assert "of other scenes" not in same_plan.explain(tmp_path)
    other = lubfric.plan_study(SCENE.with_(bodies={"width": 0.02}), {"bodies.load": [1.0, 2.0]}, [0.01, 0.02])
    assert f"4 points of other scenes, or of another version of lubfric, are in {tmp_path}" in other.explain(tmp_path)


@pytest.mark.parametrize(
    "model, words",
    [("quick", "model    quick model (numerics.model = 'quick')"), ("paper", "model    load-sharing model (numerics")],
)
def test_the_plan_of_a_study_names_the_model_that_answers(model, words):
    scene = SCENE.with_(numerics={"model": model})
    assert words in lubfric.plan_study(scene, {"bodies.load": [3.0, 5.5]}, [0.01]).explain()
    result = lubfric.friction(scene, 0.01)
    assert result.decision.model == model


@pytest.mark.parametrize("tolerance, speed", [(0.3, 0.03), (0.3, 0.3), (0.05, 0.3)])
def test_the_plan_names_the_model_whose_error_is_within_the_tolerance(tolerance, speed):
    """Where asperities carry load, load sharing does not answer, however wide the tolerance."""
    scene = SCENE.with_(numerics={"model": "auto", "model_tolerance": tolerance})
    answering = lubfric.friction(scene, speed).decision.model
    assert lubfric.study(scene, {}, [speed])["model"].tolist() == [answering]
    title = {"paper": "load-sharing model", "quick": "quick model"}[answering]
    assert f"model    {title} (numerics" in lubfric.plan_study(scene, {}, [speed]).explain()
    assert answering == ("quick" if speed == 0.03 else "paper")


def test_records_that_do_not_count_are_one_warning(tmp_path):
    """And they are solved again."""
    lubfric.study(SCENE, {"bodies.load": [3.0, 4.0, 5.0]}, [0.3], store=tmp_path)
    damaged = [path for path in (tmp_path / "points").iterdir() if path.stat().st_size > 3000]
    for path in damaged:
        path.write_bytes(path.read_bytes()[:-9])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        again = lubfric.study(SCENE, {"bodies.load": [3.0, 4.0, 5.0]}, [0.3], store=tmp_path)
    assert len(damaged) == 3 and again.failed == again.missing == 0
    (text,) = (str(each.message) for each in caught)
    assert "is damaged, as 2 others in that folder, and is not used: their points are solved again" in text


@pytest.mark.parametrize("count, jobs", [(4, 4), (128, 64)])
def test_few_points_are_jobs_of_their_own(monkeypatch, count, jobs):
    """Points that one process solves one after the other leave the other processes idle."""
    monkeypatch.setattr(points, "outcome_of", lambda *_, **__: lubfric.InputError("not solved"))
    sent = []

    class Counting(ThreadPoolExecutor):
        def submit(self, *what):
            sent.append(what)
            return super().submit(*what)

    with Counting(1) as executor:
        lubfric.study(SCENE, {"bodies.load": [3.0]}, np.linspace(0.1, 1.0, count), executor=executor)
    assert len(sent) == jobs
