"""The effects that a report says are not modelled: those of the operating point, and those of other points alone."""

import math
import re
from types import SimpleNamespace

import numpy as np
from scene_text import BODIES_AND_OIL

import lubfric
from lubfric.models.shared import effect_in_words
from lubfric.output import curve_answer, main

MOTION = "[motion]\nentrainment_speed = 1e-4\nspeeds = [1e-4, 0.03, 0.3]\n"
SCENE = BODIES_AND_OIL.replace("= 0.09", "= [0.08, 0.1]") + MOTION
SCENE += "[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\n[contact]\nshape = [64, 64]\nspacing = 0.9e-6\n"
SCENE += '[numerics]\nsampling = "patch"\nmodel = "deterministic"\ntolerance = 0.05\n'


def test_a_report_at_boundary_lubrication_lists_the_effects_of_other_points(tmp_path):
    """At the operating point nothing changes f; elsewhere the film does. The list of no effects names its place."""
    (tmp_path / "scene.toml").write_text(SCENE)
    assert main(["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out"), "--accept"]) == 0
    page = (tmp_path / "out" / "report.html").read_text()
    section = page.partition("<h2>Effects not modelled</h2>")[2].partition("<h2>")[0]
    curve = lubfric.stribeck(lubfric.load_scene(tmp_path / "scene.toml").with_(numerics={"accept": True}))
    own, *others = curve.points
    assert (
        own.unmodelled_effects == ()
        and section.count("At U = 0.0001 m/s, at its asperity load ratio, each known effect changes f by less than")
        == 1
    )
    largest = {}
    for point in others:
        for effect in point.unmodelled_effects:
            size = 0.0 if math.isnan(effect.change) else abs(effect.change) * point.coefficient
            row = (size, point.speed, effect_in_words(effect))
            largest[effect.what] = max(largest.get(effect.what, (0.0,)), row)
    assert largest
    rows = [re.sub(r"<[^>]+>", "|", row) for row in re.findall(r"<tr>(.*?)</tr>", section)[1:]]
    assert len(rows) == len(largest)
    for what, (_, speed, words) in largest.items():
        (row,) = [row for row in rows if what[1:20] in row]
        changes = {
            point.speed: effect.change for point in others for effect in point.unmodelled_effects if effect.what == what
        }
        unknown = [at for at, change in changes.items() if math.isnan(change)]
        where = f"U = {speed:.4g} m/s"
        if len(unknown) == len(changes):
            where = f"{len(unknown)} speeds, {unknown[0]:g} and {unknown[-1]:g} m/s"
        assert f"|{where}|" in row.replace("|1 speeds, ", "|") and words.partition(": f ")[2].partition(";")[0] in row


def test_the_error_of_the_points_of_a_curve_is_that_of_its_longest_side():
    """0.024 is 49 % below 0.047, and 0.063 is 34 % above."""
    intervals = np.array([[0.047, 0.047], [0.024, 0.063]])
    curve = SimpleNamespace(
        points=(), coefficient=np.array([0.05, 0.047]), uncertainty=SimpleNamespace(interval=intervals)
    )
    assert curve_answer.largest_error_of_points(curve) == " (up to 49 % at 95 %)"
