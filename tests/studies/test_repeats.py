"""Speeds and ratios that repeat, or differ in the last bits, are one point in curves, studies, fits and files."""

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric.output import main
from lubfric.studies.choose import each_once

ULP = float(np.nextafter(0.1, 1.0))
FAST = SCENE.with_(surface={"sq": 0.0})


def test_values_are_kept_once_in_their_order():
    assert each_once([0.3, 0.1, ULP, 0.3, 0.1 * (1 + 2e-6), -0.1, 0.0, -0.0]) == (0.3, 0.1, 0.1 * (1 + 2e-6), -0.1, 0.0)
    many = np.random.default_rng(0).uniform(1.0, 2.0, 3000)
    kept = np.sort(each_once([*many, *(many * (1 + 1e-9))]))
    assert np.diff(kept).min() > 1e-6 and kept.size <= 3000


@pytest.mark.parametrize("repeat", [0.1, ULP, 0.1 + 1e-12])
def test_a_curve_has_a_repeated_speed_once_and_can_be_interpolated(repeat):
    curve = lubfric.stribeck(FAST, [0.1, repeat, 0.2, 0.4, 0.8], fields=[repeat])
    np.testing.assert_array_equal(curve.speed, [0.1, 0.2, 0.4, 0.8])
    assert curve.at(0.15) > 0 and curve.points[0].balance is not None
    study = lubfric.study(FAST, {}, [0.1, repeat, 0.2])
    assert study["coefficient"].shape == (2,)
    traction = lubfric.traction(FAST, [repeat, 0.1], speed=0.5)
    assert traction.ratio.shape == (1,)


def test_the_command_writes_a_repeated_speed_once(tmp_path):
    (tmp_path / "scene.toml").write_text(FAST.to_toml())
    speeds = f"0.1,{ULP!r},0.2,0.2,0.4,0.8"
    out = tmp_path / "out"
    assert main(["run", str(tmp_path / "scene.toml"), "--speeds", speeds, "--out", str(out)]) == 0
    rows = (out / "stribeck.csv").read_text().splitlines()
    speeds = np.sort([float(row.split(",")[0]) for row in rows[1:]])
    assert {0.1, 0.2, 0.4, 0.8} <= set(speeds) and (np.diff(speeds) > 1e-3).all() and (out / "report.html").exists()
    assert main(["run", str(tmp_path / "scene.toml"), "--ratios", f"0.1,{ULP!r}", "--out", str(tmp_path / "r")]) == 0
    assert len((tmp_path / "r" / "traction.csv").read_text().splitlines()) == 2
