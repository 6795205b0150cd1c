"""Both balances of an operating point, F_T = F_C + F_H and gap = film: in closed form, recomputed from the fields, in
the limits, and under what must not change f."""

import math
from dataclasses import replace

import numpy as np
import pytest
import rigid_cylinder as rigid
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_text import paper_scene
from toys import Spring

import lubfric
from lubfric.errors import ITERATION_LIMIT
from lubfric.models.load_sharing import Point

PATCH = paper_scene(
    contact={"shape": (96, 96), "spacing": 0.6e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "grid": "given", "tolerance": 1e-3},
)
SCALED = PATCH.with_(numerics={"film_deflection": "scaled"})
B = PATCH.bodies
SPRING = Spring(300e-9, 250e-9, 4.0)


@pytest.fixture(scope="module")
def patch():
    return lubfric.prepare(PATCH)


@pytest.fixture(scope="module")
def spring():
    return lubfric.prepare(PATCH, contact=SPRING)


def on(prepared, heights):
    """The same scene on other ``heights`` [m]."""
    surface = lubfric.Surface(heights, prepared.surface.spacing, periodic_axes=(False, True))
    return lubfric.prepare(prepared.scene, surface)


@settings(max_examples=12)
@given(st.floats(-5, 1.5), st.floats(0.3, 30))
def test_closes_both_balances_for_any_speed_and_contact(log_speed, stiffness):
    """The film of the load found, solved alone, is as thick as the contact's gap in closed form."""
    contact = replace(SPRING, stiffness=stiffness)
    result = lubfric.friction(lubfric.prepare(PATCH, contact=contact), 10**log_speed)
    assert result.report.converged and result.report.evaluations <= 45
    assert result.contact_load + result.film_load == pytest.approx(B.load, rel=1e-12)
    film = lubfric.solve_ehl(
        load_per_width=result.film_load / B.width,
        radius=B.radius,
        e_prime=B.e_prime,
        entrainment_speed=10**log_speed,
        viscosity=PATCH.lubricant.viscosity,
        pressure_viscosity_coefficient=PATCH.lubricant.pressure_viscosity_coefficient,
        tolerance=1e-3,
    )
    mean = film.film_at(contact.x).mean()
    if result.contact_load > 0:
        gap = contact.gap(result.contact_load)
        allowed = 0.5 * result.decision.film_tolerance + abs(result.volume_residual) + 1e-3
        assert (gap - mean) / (gap + mean) == pytest.approx(0, abs=allowed) and allowed < 0.03
        assert result.mean_gap == pytest.approx(gap, rel=1e-9)
    else:
        assert mean > contact.touching
    boundary = B.boundary_friction_coefficient * result.contact_load
    assert result.boundary_force == pytest.approx(boundary) and result.real_contact_area == 0
    assert result.coefficient == pytest.approx((boundary + result.shear_force) / B.load, rel=1e-12)


def test_an_unclosable_balance_is_reported(spring):
    class Apart(Spring):
        def close(self, film, load, start=None, shape=None):
            return self.state(film, 2 * float(np.mean(film)))  # the gap never meets the film

    apart = lubfric.prepare(PATCH, contact=Apart(3e-7, 1e-7, 1.0))
    with pytest.raises(lubfric.ConvergenceError) as caught:
        lubfric.friction(apart, 0.01)
    assert caught.value.report.status == ITERATION_LIMIT
    assert caught.value.report.residual == pytest.approx(1 / 3)


def test_a_film_of_the_whole_load_that_fails_does_not_hide_the_balance(spring, monkeypatch):
    """A balance in contact excludes separation."""
    speed = 0.03
    solve = Point.film

    def failing(self, film_load, start=None, cells=0):
        if film_load > 0.999 * B.load:
            raise lubfric.ConvergenceError("too heavy")
        return solve(self, film_load, start, cells)

    expected = lubfric.friction(spring, speed)
    monkeypatch.setattr(Point, "film", failing)
    result = lubfric.friction(spring, speed)
    assert 0 < expected.contact_load and result.film_load == pytest.approx(expected.film_load, rel=5e-3)
    assert any("too heavy" in note for note in result.decision.notes)


@pytest.mark.parametrize("scene", [PATCH, SCALED], ids=["hydrodynamic", "scaled"])
def test_both_balances_recomputed_from_the_fields(scene):
    prepared = lubfric.prepare(scene)
    point = lubfric.friction(prepared, 0.01, fields=True)
    film = point.balance.film
    contact = point.balance.contact_state.fields
    dx, dy = prepared.surface.spacing
    carried = contact.pressure.sum() * dx * dy / (contact.pressure.shape[1] * dy) * B.width
    fluid = np.sum(0.5 * (film.pressure[1:] + film.pressure[:-1]) * np.diff(film.x)) * B.width
    assert carried == pytest.approx(point.contact_load, rel=1e-4)
    assert fluid == pytest.approx(point.film_load, rel=2e-3)  # trapezoid, without the far inlet
    x = prepared.rough_contact.x
    share = np.clip((np.minimum(x + dx / 2, B.half_width) - np.maximum(x - dx / 2, -B.half_width)) / dx, 0, 1)
    gap = (share @ contact.gap.mean(axis=1)) / share.sum()
    smooth = (share @ film.film_at(x)) / share.sum()
    assert gap == pytest.approx(smooth, rel=3e-4)
    assert point.coefficient == pytest.approx((0.09 * carried + point.shear_force) / B.load, rel=1e-4)


def test_without_entrainment_the_contact_carries_everything(patch, spring):
    for prepared in (patch, spring):
        point = lubfric.friction(prepared, 0.0)
        assert point.coefficient == pytest.approx(B.boundary_friction_coefficient, rel=1e-12)
        assert point.contact_load == B.load and point.film_load == 0 and np.isnan(point.min_film)
        assert math.isnan(point.steepness)


@pytest.mark.parametrize("load", [5.5, 110.0])
def test_the_slower_the_nearer_to_boundary_lubrication(load):
    """With a film that the whole load deflects, f tends to f_b and the contact to the dry one."""
    prepared = lubfric.prepare(SCALED.with_(bodies={"load": load}, numerics={"accept": True}))
    dry, *slow = (lubfric.friction(prepared, speed) for speed in (0.0, 1e-7, 1e-6, 1e-5))
    left = [1 - point.coefficient / 0.09 for point in slow]
    assert 0 < left[0] < left[1] < left[2] < 1e-3 and left[0] < 0.2 * left[1]
    assert slow[0].real_contact_area_fraction == pytest.approx(dry.real_contact_area_fraction, rel=1e-3)
    assert slow[0].mean_gap == pytest.approx(dry.mean_gap, rel=5e-3)


def test_johnsons_modulus_keeps_the_strip_and_matters_not_where_the_film_carries_all(patch):
    point = lubfric.friction(SCALED, 1e-2, fields=True)
    alone = lubfric.friction(patch, 1e-2)
    film = point.balance.film
    assert film.half_width == pytest.approx(B.half_width, rel=1e-12)
    assert film.e_prime == pytest.approx(B.e_prime * point.film_load / B.load, rel=1e-12)
    assert point.film_load > alone.film_load  # a flatter gap carries more
    full = [lubfric.friction(scene, 1.0).coefficient for scene in (SCALED, patch)]
    assert full[0] == pytest.approx(full[1], rel=1e-9)


def test_a_thick_film_needs_no_contact_and_is_the_rigid_cylinder(patch):
    point = lubfric.friction(patch, 1.0, fields=True)
    film = point.balance.film
    assert (
        point.contact_load == 0 and point.balance.contact_state.fields is None and point.real_contact_area_fraction == 0
    )
    exact = rigid.couette_friction(
        film.min_film, radius=B.radius, speed_difference=2.0, viscosity=0.36
    ) + rigid.rolling_friction(film.min_film, radius=B.radius, entrainment_speed=1.0, viscosity=0.36)
    assert point.coefficient == pytest.approx(exact * B.width / B.load, rel=0.05)  # M = 0.05, L = 36: nearly rigid
    smooth = lubfric.friction(PATCH.with_(surface={"sq": 1e-12}), 0.01)
    assert smooth.contact_load == 0 and smooth.coefficient > 0


def test_what_must_not_change_the_coefficient(patch):
    expected = lubfric.friction(patch, 0.01).coefficient
    heights = patch.surface.heights
    same = [
        lubfric.friction(on(patch, heights + 3e-6), 0.01),  # datum of the map
        lubfric.friction(on(patch, np.roll(heights, 31, axis=1)), 0.01),  # along the width
        lubfric.friction(on(patch, heights[:, ::-1]), 0.01),
        lubfric.friction(on(patch, heights[::-1]), -0.01),  # run backwards
        lubfric.friction(PATCH.with_(bodies={"width": 12e-3, "load": 11.0}), 0.01),
    ]
    for point in same:
        assert point.coefficient == pytest.approx(expected, rel=1e-3)


def test_the_strip_does_not_depend_on_the_box_and_the_box_does(patch):
    """METHODS of Eq. (8): with the free-in-x kernel a mean over the whole patch depends on how wide it is."""
    change = {}
    for region in ("hertz", "box"):
        made = lubfric.prepare(PATCH.with_(contact={"region": region}), patch.surface)
        cut = on(made, patch.surface.heights[16:80])
        loads = [lubfric.friction(each, 0.001).film_load for each in (cut, made)]
        change[region] = abs(loads[1] / loads[0] - 1)
    assert change["hertz"] < 5e-3 < 0.02 < change["box"]


def test_the_plastic_limit_carries_less_separation():
    elastic, soft = (lubfric.friction(PATCH.with_(bodies={"hardness": h}), 0.003) for h in (None, 1e9))
    assert elastic.plastic_area_fraction == 0 < soft.plastic_area_fraction
    assert soft.mean_gap < elastic.mean_gap and soft.film_load > elastic.film_load


@pytest.mark.parametrize("speed", [0.002, 0.03])
def test_the_steepness_of_a_point_is_that_between_its_neighbours(patch, speed):
    curve = lubfric.stribeck(patch, speed * np.array([0.9, 1.0, 1.1]))
    split = np.log(curve.film_load / curve.contact_load)
    assert curve.points[1].steepness == pytest.approx((split[2] - split[0]) / math.log(1.1 / 0.9), rel=0.08)
    assert math.isnan(lubfric.friction(patch, 1.0).steepness)


def test_a_contact_that_was_given_stays_with_another_tolerance():
    """Also one that lubfric has made, of a rougher surface than that of the scene."""
    rough = lubfric.prepare(PATCH.with_(surface={"sq": 3 * PATCH.surface.sq})).rough_contact
    given = lubfric.prepare(PATCH, contact=rough)
    mean_gap = lubfric.friction(given, 0.003).mean_gap
    assert lubfric.friction(given, 0.003, tolerance=0.02).mean_gap == pytest.approx(mean_gap, rel=0.02)
    assert mean_gap > 1.5 * lubfric.friction(PATCH, 0.003).mean_gap
