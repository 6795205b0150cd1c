"""A scene whose points take a moment, what two studies have to have in common, and how slow this machine is now."""

import time

import numpy as np
from scene_text import paper_scene

from lubfric.studies import StudyResult

SCENE = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.1e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "tolerance": 0.03},
)

REFERENCE = 0.06  # s


def same(one, other):
    """Equal to the last bit but for the time taken."""
    assert one.dims == other.dims and one.columns.keys() == other.columns.keys()
    np.testing.assert_array_equal(one.status, other.status)
    for name in one.columns.keys() - {"seconds"}:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def violations_at(shape, *at_points):
    """The violations of the points of a study of this shape: a tuple of each point, or none anywhere."""
    violations = np.empty(shape, dtype=object)
    violations.fill(())
    for index, of_point in zip(np.ndindex(violations.shape), at_points):
        violations[index] = of_point
    return violations


def made_study(plan, columns):
    """A solved study of ``plan`` with made numbers: nothing is solved."""
    shape = columns["coefficient"].shape
    texts = [np.full(shape, text, dtype=object) for text in ("converged", "paper")]
    (status, model) = texts
    return StudyResult(plan=plan, columns=columns, status=status, model=model, violations=violations_at(shape))


def slowness() -> float:
    """Processor seconds that a fixed piece of work of the kind that points do takes at this moment over what it took
    where forecasts were measured: in this unit, times of slow and of busy machines are those that are foretold."""
    field = np.linspace(0.0, 1.0, 52 * 800).reshape(52, 800)
    begun = time.process_time()
    for _ in range(100):
        np.fft.irfft(np.fft.rfft(field))
    sum(i % 7 for i in range(1_000_000))
    return (time.process_time() - begun) / REFERENCE
