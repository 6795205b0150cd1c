"""``numerics.max_work`` in every kind of run: what was reached, a status that says so, or a refusal; by counted
work."""

from functools import partial

import numpy as np
import pytest

import lubfric
from lubfric._base import limited_work
from lubfric.errors import ConvergenceError, WorkLimitError
from lubfric.scene import Harmonic, Transient
from lubfric.time.load_sharing_solver import ContactOfMoment

PAPER = lubfric.load_scene("paper").with_(numerics={"model": "paper"})
# A smooth load of half a period: cheap, with contact.
IN_TIME = PAPER.with_(
    motion={"entrainment_speed": 0.03},
    surface={"sq": 30e-9},
    contact={"shape": (48, 32), "spacing": 1.8e-6},
    transient=Transient(duration=4e-3, outputs=8, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=125.0)),
    numerics={"sampling_tolerance": 0.5},
)
SOFT = PAPER.with_(
    bodies={"hardness": 2e9},
    contact={"shape": (48, 32), "spacing": 0.9e-6},
    surface={"correlation_length": 5e-6},
    numerics={"sampling": "patch"},
)


def counted(run):
    """Return the result of ``run()`` and the counted work [s] that it takes."""
    with limited_work(np.inf) as meter:
        result = run()
    return result, meter.spent


def test_a_run_in_time_ends_with_its_outputs_so_far_and_goes_on_from_a_checkpoint(tmp_path):
    """The outputs are those of the whole run to the bit, and a larger limit goes on to its end."""
    full, work = counted(lambda: lubfric.transient(IN_TIME))
    begun = counted(lambda: lubfric.transient(IN_TIME, [0.0, 1e-9]))[1]
    assert full.report.converged and work > begun > 0.01
    short = IN_TIME.with_(numerics={"max_work": begun + 0.5 * (work - begun)})
    folder = tmp_path / "state"
    part = lubfric.transient(short, raise_on_failure=False, checkpoint=folder)
    solved = part.time.size
    assert 0 < solved < full.time.size
    assert np.array_equal(part.coefficient, full.coefficient[:solved], equal_nan=True)
    assert part.report.status == "work_limit"
    for words in (f"{solved} of 9 outputs are solved", "numerics.max_work = ", "raise numerics.max_work"):
        assert words in part.report.message
    with pytest.raises(ConvergenceError, match="numerics.max_work") as caught:
        lubfric.transient(short)
    assert np.array_equal(caught.value.result.coefficient, part.coefficient, equal_nan=True)
    more = IN_TIME.with_(numerics={"max_work": 2 * work})
    rest, taken = counted(lambda: lubfric.transient(more, checkpoint=folder))
    assert rest.report.converged and taken < begun + 0.7 * (work - begun)
    assert np.array_equal(rest.coefficient, full.coefficient, equal_nan=True)


@pytest.mark.parametrize("error", [ConvergenceError("no contact"), WorkLimitError(1.0)])
def test_a_contact_without_a_solution_makes_a_step_shorter_but_a_limit_ends_the_run(error):
    class Patch:
        def close(self, *_):
            raise error

    contact = ContactOfMoment(patch=Patch(), to_patch=np.eye(3))
    step = partial(contact.closed, np.ones(3), 1.0, None)
    if isinstance(error, WorkLimitError):
        with pytest.raises(WorkLimitError):
            step()
    else:
        assert step() is None


def test_a_run_in_time_that_cannot_begin_says_so():
    with pytest.raises(WorkLimitError, match="numerics.max_work = 0.001 s"):
        lubfric.transient(IN_TIME.with_(numerics={"max_work": 0.001}))


def test_running_in_ends_with_the_passes_so_far():
    full, work = counted(lambda: lubfric.run_in(SOFT))
    assert full.deepest.size > 2
    with pytest.raises(WorkLimitError, match="passes are done; .result of this error contains them") as caught:
        lubfric.run_in(SOFT.with_(numerics={"max_work": 0.7 * work}))
    part = caught.value.result
    passes = part.deepest.size
    assert 0 < passes < full.deepest.size and not part.shaken_down
    assert np.array_equal(part.surface.heights, lubfric.run_in(SOFT, passes=passes).surface.heights)


@pytest.mark.slow
def test_wear_ends_with_the_distance_so_far():
    keys = {"distance": 1e3, "wear_coefficient": 1e-6}
    scene = SOFT.with_(motion={"entrainment_speed": 0.003}, numerics={"accept": True})
    dents = counted(lambda: lubfric.run_in(scene))[1]
    full, work = counted(lambda: lubfric.run_in(scene, **keys))
    limit = dents + 0.6 * (work - dents)
    with pytest.raises(WorkLimitError, match="m of wear are done") as caught:
        lubfric.run_in(scene.with_(numerics={"max_work": limit}), **keys)
    wear = caught.value.result.wear
    assert 0 < wear.distance.size < full.wear.distance.size
    assert np.allclose(wear.distance, full.wear.distance[: wear.distance.size])
    assert "numerics.max_work" in wear.stopped


def test_points_of_studies_traction_and_fits_have_the_limit():
    scene = PAPER.with_(numerics={"max_work": 0.002})
    with pytest.raises(ConvergenceError, match="max_work = 0.002 s"):
        lubfric.traction(scene, [0.1, 0.5], speed=0.03)
    study = lubfric.study(scene, {"bodies.load": [5.0, 6.0]}, speeds=[0.03])
    assert all("max_work = 0.002 s" in text for text in study.failures)
    measured = lubfric.Measured(x=[0.01, 0.03, 0.1], coefficient=[0.08, 0.05, 0.02])
    _, work = counted(
        lambda: pytest.raises(ConvergenceError, lubfric.fit, scene, measured, {"surface.sq": (5e-8, 2e-7)})
    )
    assert work < 1.0
