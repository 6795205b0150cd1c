"""The study of the model's error: what it gathers, and that it sees a wrong model."""

import numpy as np

from verification.model.measure import METHODS, REFERENCE, Point, Setting, points
from verification.model.summary import deviations

SETTING = Setting(1, "gaussian", 5.5, "Newtonian", (0.01, 0.003), 32)


def made(speed, method, f, share=0.5):
    return Point(SETTING, speed, method, f, share, 1e-7, 1.0, 0.1)


def test_mean_rms_and_failures_are_against_the_reference():
    other = "one-way"
    found = deviations(
        [made(0.01, REFERENCE, 0.1), made(0.01, other, 0.11, 0.6), made(0.003, REFERENCE, 0.1),
         made(0.003, other, float("nan"))]
    )  # fmt: skip
    good = next(d for d in found if d.method == other and d.speed == 0.01)
    failed = next(d for d in found if d.method == other and d.speed == 0.003)
    assert np.isclose(good.mean, 0.1) and np.isclose(good.rms, 0.1) and np.isclose(good.share_mean, 0.1)
    assert failed.failures == 1 and np.isnan(failed.mean)


def test_every_model_answers_the_same_scene():
    found = points(SETTING, tuple(m for m in METHODS if m != "hertz, total"))
    assert not any(p.failure for p in found) and len(found) == 10
    f = {p.method: p.coefficient for p in found if p.speed == 0.003}
    assert max(f.values()) < 1.2 * min(f.values()) and len(set(f.values())) == 5
