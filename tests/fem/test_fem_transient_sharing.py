"""Load sharing in time by finite elements: a steady state stays, and the film remembers a higher speed."""

from itertools import islice

import pytest

pytest.importorskip("skfem")

from verification.fem.solvers.report import InputError
from verification.fem.solvers.transient_sharing import share_in_time
from verification.fem.studies.load_sharing import cylinder, rough, scene, strip

SPEED = 0.03  # m/s


@pytest.fixture(scope="module")
def bodies():
    return cylinder(scene(), SPEED, strip(16, 0), rough(32, 16))


@pytest.mark.slow  # the study sharing_in_time starts from one
def test_a_steady_state_stays_as_it_is(bodies):
    step = 0.3 * bodies.contact.half_width / SPEED
    first, *_, last = islice(share_in_time(bodies, lambda time: SPEED, step), 4)
    assert last.contact_load == pytest.approx(first.contact_load, rel=2e-3)
    assert first.contact_load + first.film_load == pytest.approx(bodies.load)


def test_a_film_that_slows_down_at_once_keeps_most_of_its_load_at_first(bodies):
    step = 0.05 * bodies.contact.half_width / SPEED
    first, then = islice(share_in_time(bodies, lambda time: SPEED if time == 0 else 0.5 * SPEED, step), 2)
    assert abs(then.mean_gap / first.mean_gap - 1) < 0.01


def test_a_speed_that_is_not_that_of_the_contact_is_refused(bodies):
    with pytest.raises(InputError, match="speed"):
        next(share_in_time(bodies, lambda time: 2 * SPEED, 1e-4))
