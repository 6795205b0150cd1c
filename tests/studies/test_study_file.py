"""A study file is read into the plan that it says, and what it cannot say is refused by name, before any work."""

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric.studies import load_study

SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.01\n" + SMALL_PATCH


def read(folder, study, scene=SCENE):
    (folder / "small.toml").write_text(scene)
    (folder / "study.toml").write_text('scene = "small.toml"\n' + study)
    return load_study(folder / "study.toml")


def test_several_sampled_keys_go_together(tmp_path):
    keys = "bodies.load = { low = 2.0, high = 4.0 }\nlubricant.viscosity = { low = 0.1, high = 1.0, scale = 'log' }\n"
    plan = read(tmp_path, "speeds = [0.01, 0.1]\n[sample]\ncount = 4\nseed = 3\n" + keys)
    (axis,) = plan.axes
    assert axis.name == "case" and axis.keys == ("bodies.load", "lubricant.viscosity") and plan.points == 8
    ranges = [lubfric.Between(2.0, 4.0), lubfric.Between(0.1, 1.0, "log")]
    assert list(axis.values) == lubfric.sample(ranges, 4, seed=3)
    assert [scene.bodies.load for scene in plan.scenes] == [load for load, _ in axis.values]


def test_a_study_file_takes_units_as_a_scene_does(tmp_path):
    words, plain = (
        read(
            tmp_path,
            f"speed_range = [{slow}, 0.1, 3]\n[vary]\nbodies.width = [{width}]\n[sample]\ncount = 2\n"
            f"bodies.load = {{ low = {low}, high = 4.0 }}\n",
        )
        for slow, width, low in (("'1 cm/s'", "'6 mm', '7 mm'", "'2 N'"), (0.01, "0.006, 0.007", 2.0))
    )
    assert words == plain
    with pytest.raises(lubfric.InputError, match="low = '2 K' is in K, which does not convert to "):
        read(tmp_path, "speeds = [0.1]\n[sample]\ncount = 2\nbodies.load = { low = '2 K', high = 4.0 }\n")


def test_one_sampled_key_beside_whole_sections(tmp_path):
    np.save(tmp_path / "a.npy", np.random.default_rng(1).normal(size=(48, 48)) * 1e-8)
    text = '[vary]\nsurface = [{ file = "a.npy", spacing = 1.1e-6 }, { seed = 3 }]\n[sample]\ncount = 4\nseed = 2\n'
    plan = read(tmp_path, text + "lubricant.viscosity = { low = 0.1, high = 1.0, scale = 'log' }\n")
    assert plan.shape == (2, 4, 1) and plan.axes[1].keys == ("lubricant.viscosity",)
    measured, generated = (plan.scenes[i].surface for i in (0, 4))
    assert measured.file == str(tmp_path / "a.npy") and measured.correlation_length is None  # a file has its own
    assert (generated.file, generated.seed, generated.correlation_length) == (None, 3, 4e-6)


def test_maps_are_found_beside_the_file(tmp_path):
    for name in ("one.npy", "two.npy"):
        np.save(tmp_path / name, np.random.default_rng(1).normal(size=(8, 8)) * 1e-8)
    measured = SCENE.replace("sq = 1e-7\ncorrelation_length = 4e-6", 'file = "one.npy"\nspacing = 1e-6')
    plan = read(tmp_path, '[vary]\nsurface.file = ["one.npy", "two.npy"]\n', measured.split("[contact]")[0])
    files = [scene.surface.file for scene in plan.scenes]
    assert files == [str(tmp_path / "one.npy"), str(tmp_path / "two.npy")] and plan.speeds == (0.01,)


def test_maps_of_the_other_body_are_found_beside_the_file(tmp_path):
    np.save(tmp_path / "one.npy", np.random.default_rng(1).normal(size=(8, 8)) * 1e-8)
    plan = read(tmp_path, '[vary]\ncounterface = [{ file = "one.npy", spacing = 1e-6 }]\n')
    assert [scene.counterface.file for scene in plan.scenes] == [str(tmp_path / "one.npy")]
    facing = SCENE + '[counterface]\nfile = "one.npy"\nspacing = 1e-6\n'
    plan = read(tmp_path, '[vary]\ncounterface.file = ["one.npy"]\n', facing)
    assert [scene.counterface.file for scene in plan.scenes] == [str(tmp_path / "one.npy")]
    with pytest.raises(lubfric.InputError, match="counterface.file = 'none.npy': no such file"):
        read(tmp_path, '[vary]\ncounterface.file = ["none.npy"]\n', facing)


@pytest.mark.parametrize(
    "study, words",
    [
        ("speeds = [0.1]\nspeed_range = [0.1, 1.0, 3]\n", "study.toml has speeds and speed_range"),
        ("speed_rnage = [0.1, 1.0, 3]\n", "did you mean 'speed_range'"),
        ("speed_range = [0.1, 1.0]\n", "^speed_range = .* must be .lowest, highest, count"),
        ("speed_range = [0.1, 1.0, 1000000000000]\n", "speed_range count"),
        ("[[together]]\nbodies.load = [1.0]\nbodies.width = [1e-3, 2e-3]\n", "lists of one length"),
        ("[sample]\ncount = 3\nbodies.load = { low = 1.0, high = 2.0 }\n", "powers of two"),
        ("[sample]\ncount = 4\nbodies.load = 1\n", "low = "),
        ("[sample]\nbodies.load = { low = 1.0, high = 2.0 }\n", "needs count"),
        ('[vary]\nsurface.file = ["none.npy"]\n', "no such file"),
        ("speeds = [0.1\n", "not valid TOML"),
        ('[vary]\n"bodies.load" = [1.0]\nbodies.load = [2.0]\n', "bodies.load is given twice"),
        ("[vary]\nbodies.load = [1.0]\n[sample]\ncount = 2\nbodies.load = { low = 1.0, high = 2.0 }\n", "given twice"),
        ('speeds = "many"\n', "'auto'"),
    ],
)
def test_what_a_study_cannot_say_is_refused(tmp_path, study, words):
    with pytest.raises(lubfric.InputError, match=words):
        read(tmp_path, study)


def test_a_study_needs_a_scene_and_a_file(tmp_path):
    (tmp_path / "study.toml").write_text("speeds = [0.1]\n")
    with pytest.raises(lubfric.InputError, match="scene of .*toml = "):
        load_study(tmp_path / "study.toml")
    with pytest.raises(lubfric.InputError, match="study .*no such file"):
        load_study(tmp_path / "none.toml")


def test_a_plan_has_its_values_and_an_executor_can_submit(tmp_path):
    plan = read(tmp_path, "")
    with pytest.raises(lubfric.InputError, match="belong to the plan"):
        lubfric.study(plan, {"bodies.load": [1.0]})
    for call in (lambda: lubfric.study(plan, executor=3), lambda: lubfric.stribeck(plan.scene, [0.1], executor=3)):
        with pytest.raises(lubfric.InputError, match="executor = 3; allowed: None, a concurrent"):
            call()


def test_a_scene_in_place_of_a_study_is_named_as_one(tmp_path):
    (tmp_path / "s.toml").write_text(lubfric.load_scene("paper").to_toml())
    with pytest.raises(lubfric.InputError, match="is a scene, not a study.*--points"):
        load_study(tmp_path / "s.toml")


def test_a_table_in_place_of_a_study_is_named_as_one(tmp_path):
    (tmp_path / "points.csv").write_text("load [N],speed [m/s]\n5,0.1\n")
    with pytest.raises(lubfric.InputError, match="is a table, not a study.*--points points.csv"):
        load_study(tmp_path / "points.csv")
