"""The time of a fit is processor time wherever it is stated beside an estimate, and its starts are one number
everywhere."""

import re
import time

import numpy as np
from small_study import SCENE

import lubfric
from lubfric.output import main
from lubfric.studies import estimated_fit

BOUNDS = {"lubricant.viscosity": (0.1, 0.5)}
MEASURED = lubfric.Measured(np.array([0.05, 0.5]), np.array([0.05, 0.04]))


def test_time_that_the_caller_takes_is_no_time_of_the_fit():
    """A curve takes some hundredths of a second; the caller waits .4 s after each."""
    stated = []

    def on_progress(done, total, left, *_):
        stated.append((total - done, left))
        time.sleep(0.4)

    lubfric.fit(SCENE, MEASURED, BOUNDS, starts=2, on_progress=on_progress)
    assert all(left <= 0.3 * to_come for to_come, left in stated[1:])


def test_the_console_and_the_report_state_the_same_starts_and_the_same_kind_of_time(tmp_path, capsys):
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    (tmp_path / "rig.csv").write_text("U [m/s],mu\n0.05,0.05\n0.5,0.04\n")
    named = ["--measured", str(tmp_path / "rig.csv"), "--speed", "U [m/s]", "--coefficient", "mu", "--starts", "2"]
    out = ["--out", str(tmp_path / "out"), "--parameter", "lubricant.viscosity=0.1:0.5"]
    assert main(["fit", str(tmp_path / "scene.toml"), *named, *out]) == 0
    said = " ".join(capsys.readouterr().err.split())
    page = (tmp_path / "out" / "report.html").read_text()
    starts = "from the start and 2 further starts over the complete bounds"
    assert f"search: {starts}" in said and f"A search by the load-sharing model, {starts}" in page
    assert re.search(r"time: about \S+ \S+ of processor time", said)
    assert re.search(r"; \d+ s of processor time, (about|the last)", said)
    assert "processor time, all processes together" in page


def test_points_of_a_traction_curve_share_one_reference_point():
    """Twice as many ratios are expected to take less than twice as long."""
    scene = lubfric.load_scene("paper").with_(
        motion={"entrainment_speed": 0.03}, numerics={"model": "paper", "sampling_tolerance": 0.2}
    )
    f_b = {"bodies.boundary_friction_coefficient": (0.05, 0.15)}

    def expected(ratios):
        measured = lubfric.Measured(ratios, [0.05] * len(ratios), over="slide_roll_ratio")
        return estimated_fit(scene, measured, f_b, starts=0)

    assert expected([0.1, 0.2, 0.3, 0.4]) < 1.8 * expected([0.1, 0.2])
