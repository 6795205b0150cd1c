"""The closure of load sharing is three functions: others of these hold in a point and in time."""

import re
import sys

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.load_sharing import closure

FACTOR = 1.3  # mean gap over mean film that this closure demands
SMALL = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.1e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "model": "paper"},
)


@pytest.fixture
def demand(monkeypatch):
    """Make the gap that the closure demands wider by `FACTOR` and narrower by some length [m], wherever it is
    imported."""

    def narrower_by(length):
        others = {
            "gap_under": lambda mean_film: FACTOR * mean_film - length,
            "film_under": lambda mean_gap: (mean_gap + length) / FACTOR,
            "gap_per_film": lambda mean_film: FACTOR * mean_film,
        }
        for name, function in others.items():
            old = getattr(closure, name)
            for module in [module for key, module in sys.modules.items() if key.startswith("lubfric.")]:
                if vars(module).get(name) is old:
                    monkeypatch.setattr(module, name, function)

    return narrower_by


def test_another_closure_holds_in_a_point_and_in_time(demand):
    """In steady motion both have one f, though they find it by different rules."""
    demand(0.0)
    speed = SMALL.motion.entrainment_speed
    point = lubfric.friction(SMALL, speed)
    state = point.balance.contact_state
    assert state.mean_gap == pytest.approx(FACTOR * state.mean_film, rel=1e-3)
    assert abs(point.volume_residual) < 1e-3 and point.uncertainty.numerical < 0.01
    run = lubfric.transient(SMALL, times=[1e-5])
    assert run.mean_gap[-1] == pytest.approx(FACTOR * run.mean_film[-1], rel=1e-3)
    assert run.coefficient[-1] == pytest.approx(point.coefficient, rel=1e-3)


def test_the_film_that_clears_the_summits_at_a_start_is_that_of_the_closure(demand):
    """A run that begins with a film in the air is refused while summits touch: the film that clears them is thinner
    where the closure demands a wider gap."""

    def allowed():
        touching = SMALL.with_(transient=lubfric.Transient(1e-4, initial_film=1e-9))
        with pytest.raises(lubfric.InputError) as refused:
            lubfric.transient(touching)
        return float(re.search(r"above (\S+) m", str(refused.value))[1])

    by_paper = allowed()
    demand(0.0)
    assert allowed() == pytest.approx(by_paper / FACTOR, rel=1e-5)


def test_the_response_is_the_change_of_the_load_ratio_by_the_gap(demand):
    """Which two solves show, of a closure that demands a gap narrower and wider by a known length."""
    ratios = []
    lengths = (0.0, 2e-9, -2e-9)
    for length in lengths:
        demand(length)
        ratios.append(lubfric.friction(SMALL, 0.03, tolerance=1e-3).balance)
    middle, narrower, wider = ratios
    change = (narrower.log_load_ratio - wider.log_load_ratio) / (lengths[1] - lengths[2])
    assert middle.response.log_load_ratio_per_gap == pytest.approx(change, rel=0.03)


def test_the_error_of_the_mean_gap_is_that_of_the_film_through_the_closure(demand):
    """Two films that differ by 0.1 % show by how much more the gap does that is demanded under them."""
    length = 1e-6
    demand(length)
    point = lubfric.friction(SMALL, 2.0)
    assert point.contact_load == 0.0
    film = point.balance.contact_state.mean_film
    low, high = (FACTOR * (1 + change) * film - length for change in (-5e-4, 5e-4))
    per_film = (high / low - 1) / 1e-3
    assert per_film > 1.05
    assert point.errors.mean_gap / point.errors.central_film == pytest.approx(per_film, rel=1e-3)
