"""Measured points beside a curve: their error bars are the 95 % intervals of the stated deviations, and they are
named."""

import json

import numpy as np
import pytest
from matplotlib.container import ErrorbarContainer
from pictures import put_back
from scene_text import paper_scene

import lubfric
from lubfric._base.figures import new_figure
from lubfric.output import main

RIG = "U [m/s],mu,sd\n0.05,0.08,0.004\n0.5,0.03,0.002\n"
SPEED = ["--speed", "U [m/s]", "--coefficient", "mu"]


def bars(axes):
    """Of the only measured points: their label, and the lower and upper end of each bar."""
    (container,) = (each for each in axes.containers if isinstance(each, ErrorbarContainer))
    (lines,) = container.lines[2]
    return container.get_label(), np.array(lines.get_segments())


@pytest.mark.parametrize("is_signed", [False, True])
def test_bars_have_the_95_percent_interval_of_a_normal_deviation(is_signed):
    measured = lubfric.Measured([-0.1, 0.2], [0.05, 0.03], [0.002, 0.001], over="slide_roll_ratio", legend="rig 7")
    axes = new_figure(figsize=(3, 3)).subplots()
    measured.draw(axes, is_signed=is_signed)
    label, ends = bars(axes)
    assert label == "rig 7 (bars: 95 %)"
    np.testing.assert_allclose(ends[:, 0, 0], [-0.1 if is_signed else 0.1, 0.2])
    np.testing.assert_allclose((ends[:, 1, 1] - ends[:, 0, 1]) / 2, [0.00392, 0.00196])


def test_a_file_names_its_points_by_its_stem_and_takes_one_deviation_for_all(tmp_path):
    (tmp_path / "rig.7.csv").write_text(RIG)
    read = lubfric.read_measured(tmp_path / "rig.7.csv", speed="U [m/s]", coefficient="mu", deviation=0.003)
    assert read.legend == "rig.7" and read.source == "rig.7.csv"
    np.testing.assert_array_equal(read.deviation, [0.003, 0.003])
    with pytest.raises(lubfric.InputError, match="deviation"):
        lubfric.read_measured(tmp_path / "rig.7.csv", speed="U [m/s]", coefficient="mu", deviation=0.0)


@pytest.mark.parametrize(
    "options, label, deviation",
    [
        (["--deviation", "sd"], "rig", [0.004, 0.002]),
        (["--deviation", "0.01", "--measured-label", "MTM"], "MTM", [0.01, 0.01]),
        (["--deviation", "10 %"], "rig", [0.008, 0.003]),
    ],
)
def test_a_run_draws_the_deviations_that_its_command_names(options, label, deviation, tmp_path, monkeypatch):
    def draw(path, columns, title, violations, measured, *_, **__):
        path.write_text(json.dumps([measured.legend, *measured.deviation]))

    monkeypatch.setattr("lubfric.output.curve_picture.plot_stribeck", draw)
    put_back(monkeypatch.setattr)
    numerics = {"sampling": "patch", "model": "paper", "tolerance": 0.2}
    scene = paper_scene(contact={"shape": (32, 48), "spacing": 1.8e-6}, numerics=numerics)
    (tmp_path / "s.toml").write_text(scene.to_toml())
    (tmp_path / "rig.csv").write_text(RIG)
    command = ["run", str(tmp_path / "s.toml"), "--speeds", "0.5", "--out", str(tmp_path / "out")]
    assert main([*command, "--measured", str(tmp_path / "rig.csv"), *SPEED, *options]) == 0
    shown, *deviations = json.loads((tmp_path / "out" / "stribeck.png").read_text())
    assert shown == label
    np.testing.assert_allclose(deviations, deviation)


def test_a_label_without_points_is_refused(tmp_path, capsys):
    assert main(["plot", str(tmp_path), "--measured-label", "MTM"]) == 2
    assert "--measured-label labels the measured curve; give --measured as well" in capsys.readouterr().err
