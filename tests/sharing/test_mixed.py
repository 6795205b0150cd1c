"""One operating point: limits, both balances recomputed from the fields, and what must not change f."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.film import rigid_cylinder as rigid
from lubfric.sharing import prepare

SCENE = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(
        contact={"shape": (96, 96), "spacing": 0.6e-6},
        surface={"correlation_length": 4e-6},
        numerics={"tolerance": 1e-3},
    )
)
MODEL = prepare(SCENE)
FLAT = lubfric.load_scene("flat").with_(contact={"shape": (128, 128), "spacing": 8e-6})


def with_heights(model, change):
    return replace(model, contact=replace(model.contact, heights=change(model.contact.heights)))


def test_without_entrainment_the_contact_carries_everything():
    point = lubfric.friction(MODEL, 0.0)
    assert point.coefficient == pytest.approx(SCENE.bodies.boundary_friction_coefficient, rel=1e-12)
    assert point.contact_load == SCENE.bodies.load and point.film_load == 0 and np.isnan(point.min_film)
    slow = lubfric.friction(MODEL, 1e-6, model="full")  # the tolerance holds for f; areas want the whole grid
    assert slow.coefficient == pytest.approx(0.09, rel=1e-3)
    assert slow.real_contact_area_fraction == pytest.approx(point.real_contact_area_fraction, rel=1e-2)


def test_a_thick_film_needs_no_contact_and_is_the_rigid_cylinder():
    point = lubfric.friction(MODEL, 1.0, fields=True)
    b, film = SCENE.bodies, point.balance.film
    assert point.contact_load == 0 and point.balance.contact.fields is None and point.real_contact_area_fraction == 0
    exact = rigid.couette_friction(
        film.min_film, radius=b.radius, speed_difference=2.0, viscosity=0.36
    ) + rigid.rolling_friction(film.min_film, radius=b.radius, entrainment_speed=1.0, viscosity=0.36)
    assert point.coefficient == pytest.approx(exact * b.width / b.load, rel=0.05)  # M = 0.05, L = 36: nearly rigid


def test_both_balances_recomputed_from_the_fields():
    point = lubfric.friction(MODEL, 0.01, fields=True)
    b, film, contact = SCENE.bodies, point.balance.film, point.balance.contact.fields
    dx, dy = MODEL.surface.spacing
    length = contact.pressure.shape[1] * dy
    carried = contact.pressure.sum() * dx * dy / length * b.width
    fluid = np.sum(0.5 * (film.pressure[1:] + film.pressure[:-1]) * np.diff(film.x)) * b.width
    assert carried == pytest.approx(point.contact_load, rel=1e-4)
    assert fluid == pytest.approx(point.film_load, rel=2e-3)  # trapezoid, without the far inlet
    assert carried + fluid == pytest.approx(b.load, rel=2e-3)
    x = MODEL.contact.x
    share = np.clip((np.minimum(x + dx / 2, b.half_width) - np.maximum(x - dx / 2, -b.half_width)) / dx, 0, 1)
    gap = (share @ contact.gap.mean(axis=1)) / share.sum()
    smooth = (share @ film.film_at(x)) / share.sum()
    assert gap == pytest.approx(smooth, rel=3e-4)
    assert abs(point.volume_residual) <= SCENE.numerics.tolerances.balance
    assert point.coefficient == pytest.approx((0.09 * carried + point.shear_force) / b.load, rel=1e-4)


def test_what_must_not_change_the_coefficient():
    reference = lubfric.friction(MODEL, 0.01).coefficient
    same = [
        lubfric.friction(with_heights(MODEL, lambda z: z + 3e-6), 0.01),  # datum of the map
        lubfric.friction(with_heights(MODEL, lambda z: np.roll(z, 31, axis=1)), 0.01),  # along the width
        lubfric.friction(with_heights(MODEL, lambda z: z[:, ::-1]), 0.01),
        lubfric.friction(with_heights(MODEL, lambda z: z[::-1]), -0.01),
    ]  # run backwards
    for point in same:
        assert point.coefficient == pytest.approx(reference, rel=1e-3)
    wide = prepare(SCENE.with_(bodies={"width": 12e-3, "load": 11.0}))
    assert lubfric.friction(wide, 0.01).coefficient == pytest.approx(reference, rel=1e-3)


def test_similar_contacts_have_the_same_coefficient():
    """All lengths x 3, load x 9, viscosity/3 at the same speed: every dimensionless group is kept."""
    k = 3.0
    bigger = prepare(
        SCENE.with_(
            bodies={"radius": 2e-3 * k, "width": 6e-3 * k, "load": 5.5 * k**2},
            lubricant={"viscosity": 0.36 * k, "viscosity_law": "barus"},
            motion={"entrainment_speed": 0.01},
            surface={"sq": 100e-9 * k, "correlation_length": 4e-6 * k},
            contact={"spacing": 0.6e-6 * k},
        )
    )
    barus = prepare(SCENE.with_(lubricant={"viscosity_law": "barus"}))
    assert lubfric.friction(bigger, 0.01).coefficient == pytest.approx(
        lubfric.friction(barus, 0.01).coefficient, rel=1e-3
    )


def test_a_warm_start_changes_the_time_not_the_answer():
    near = lubfric.friction(MODEL, 0.011, fields=True)
    cold, warm = lubfric.friction(MODEL, 0.01), lubfric.friction(MODEL, 0.01, start=near)
    assert warm.coefficient == pytest.approx(cold.coefficient, rel=5e-4)
    assert warm.report.evaluations <= cold.report.evaluations


def test_a_smooth_surface_is_pure_film():
    smooth = prepare(SCENE.with_(surface={"sq": 1e-12}))
    film = lubfric.friction(smooth, 0.01)
    assert film.contact_load == 0 and film.coefficient > 0


def test_the_strip_does_not_depend_on_the_box_and_the_box_does():
    """METHODS of Eq. (8): with the free-in-x kernel a mean over the whole patch depends on how wide it is."""
    rows = {}
    for region in ("hertz", "box"):
        loads = []
        for n in (64, 96):
            model = prepare(SCENE.with_(contact={"region": region}))
            keep = slice((96 - n) // 2, (96 + n) // 2)
            cut = prepare(SCENE.with_(contact={"region": region, "shape": (n, 96)}))
            cut = replace(cut, contact=replace(cut.contact, heights=model.contact.heights[keep]))
            loads.append(lubfric.friction(cut, 0.001).film_load)
        rows[region] = abs(loads[1] / loads[0] - 1)
    assert rows["hertz"] < 5e-3 < 0.02 < rows["box"]


def test_pure_rolling_has_no_boundary_friction():
    rolling = prepare(SCENE.with_(motion={"slide_roll_ratio": 0.0}))
    point = lubfric.friction(rolling, 0.01)
    assert point.boundary_force == 0 and point.couette_force == 0 and point.rolling_force > 0


def test_the_plastic_limit_carries_less_separation():
    elastic = lubfric.friction(prepare(SCENE.with_(bodies={"hardness": None})), 0.003)
    soft = lubfric.friction(prepare(SCENE.with_(bodies={"hardness": 1e9})), 0.003)
    assert elastic.plastic_area_fraction == 0 < soft.plastic_area_fraction
    assert soft.mean_gap < elastic.mean_gap and soft.film_load > elastic.film_load


def test_a_contact_at_the_edge_of_the_patch_is_an_error():
    ridge = np.zeros((96, 1))
    ridge[0] = 5e-6
    with pytest.raises(lubfric.LubfricError, match="edge columns"):
        lubfric.friction(with_heights(MODEL, lambda z: z + ridge), 1e-3)


@pytest.fixture(scope="module")
def flat():
    return prepare(FLAT)


def test_flat_contact_follows_its_curve(flat):
    from lubfric.contact.solve import solve_contact

    point = lubfric.friction(flat, 0.05)
    pressure = point.contact_load / flat.contact.area
    heights = flat.surface.heights
    direct = solve_contact(heights.max() - heights, flat.surface.spacing, FLAT.bodies.e_prime, mean_pressure=pressure)
    assert point.mean_gap == pytest.approx(direct.mean_gap, rel=2e-3)
    assert point.real_contact_area_fraction == pytest.approx(direct.contact_area_fraction, rel=2e-2)
    assert 0 < point.contact_load < FLAT.bodies.load


def test_flat_contact_ends(flat):
    assert lubfric.friction(flat, 0.0).coefficient == pytest.approx(0.09)
    assert lubfric.friction(flat, 10.0).contact_load == 0
    loads = [lubfric.friction(flat, u).contact_load for u in np.geomspace(1e-4, 1, 12)]
    assert np.all(np.diff(loads) < 0) or loads[-1] == 0


@pytest.mark.parametrize("speed", [np.nan, np.inf, "fast"])
def test_a_bad_speed_is_an_error(speed):
    with pytest.raises(lubfric.InputError, match="speed"):
        lubfric.friction(MODEL, speed)


def test_a_height_map_in_memory_is_used_as_it_is():
    surface = MODEL.surface
    same = lubfric.prepare(SCENE.with_(surface={"sq": 1e-6}), surface)
    assert lubfric.friction(same, 0.01).coefficient == pytest.approx(
        lubfric.friction(MODEL, 0.01).coefficient, rel=1e-6
    )
