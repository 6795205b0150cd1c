"""A patch too short for its contact is refused before anything is solved; one that is long enough never."""

import numpy as np
import pytest

import lubfric
from lubfric.rough.edges import ALLOWED, SURE, edge_share

BASE = lubfric.load_scene("paper").with_(
    bodies={"load": 40.0, "hardness": None, "width": 2e-3},
    motion={"entrainment_speed": 1e-3, "speeds": ()},
    surface={"sq": 2e-7, "correlation_length": 6e-6, "acf": "gaussian"},
    contact={"shape": (64, 64), "spacing": 2e-6},
    numerics={"sampling": "patch", "accept": True},
)


def patch(cells):
    return BASE.with_(contact={"shape": (cells, 64)})


def test_a_short_patch_is_refused_before_anything_is_solved(monkeypatch):
    half = BASE.bodies.half_width
    short = lubfric.prepare(patch(int(2.04 * half / 2e-6) + 1))
    for module in ("lubfric.rough.half_space", "lubfric.ehl.solve"):
        monkeypatch.setattr(f"{module}.solve_{'contact' if 'rough' in module else 'ehl'}", lambda *a, **k: 1 / 0)
    with pytest.raises(lubfric.InputError, match="nothing was solved.*contact.shape"):
        lubfric.friction(short)
    with pytest.raises(lubfric.InputError, match="nothing was solved"):
        lubfric.friction(short, 0.0)


def test_what_is_foretold_is_found_where_it_is_solved(monkeypatch):
    """The same patches without foresight: those foretold fail by the solve, the others are as before."""
    told, found = [], []
    half = BASE.bodies.half_width
    for cells in (int(2.04 * half / 2e-6) + 1, int(2.3 * half / 2e-6), int(4 * half / 2e-6)):
        told.append(_fails(patch(cells)))
        with monkeypatch.context() as blind:
            blind.setattr("lubfric.rough.half_space.HalfSpaceContact.foretell", lambda self, bodies, film: None)
            found.append(_fails(patch(cells)))
    assert found[0] and not found[-1] and all(f or not t for t, f in zip(told, found))
    assert told[0] and not told[-1]


def _fails(scene):
    try:
        lubfric.friction(scene)
    except lubfric.InputError as error:
        assert "edge columns" in str(error)
        return True
    return False


def test_springs_carry_the_load_where_the_gap_is_small():
    """Of an even gap every column carries its share; a gap that rises like Hertz's beyond 2.5 half-widths none."""
    radius, e_prime, load = 8e-3, 231e9, 2e5
    half = np.sqrt(8 * load * radius / (np.pi * e_prime))
    rough = np.random.default_rng(1).normal(0, 1e-7, (50, 64))
    inside = edge_share(rough, (half / 30, half / 30), np.linspace(-0.8, 0.8, 50) * half, load, radius, e_prime)
    assert inside == pytest.approx(2 / 50, rel=0.4) and inside > SURE * ALLOWED
    assert edge_share(rough, (half / 8, half / 8), np.linspace(-3, 3, 50) * half, load, radius, e_prime) == 0
