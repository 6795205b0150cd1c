"""What a point leaves out, of a known size: how much larger its errors are told, in closed form."""

from dataclasses import replace

import pytest
from lubfric.sampling.patch_error import of_patch

import lubfric
from lubfric.sampling import line_friction, of_line
from lubfric.sharing import Heat, solved_as_deflected

PATCH = lubfric.load_scene("paper").with_(
    contact={"shape": (64, 64), "spacing": 0.8e-6},
    surface={"correlation_length": 5e-6},
    numerics={"sampling": "patch"},
)


@pytest.fixture(scope="module", params=[0.02, 3.0], ids=["mixed", "full film"])
def patch(request):
    prepared, point = solved_as_deflected(lubfric.prepare(PATCH), request.param, None)
    assert (point.balance.contact_load > 0) == (request.param < 1)
    return prepared, request.param, point


def with_heat(point, **heat):
    balance = point.balance
    return replace(point, balance=replace(balance, forces=replace(balance.forces, heat=Heat(**heat))))


def more(before, after, name):
    return getattr(after[1], name) - getattr(before[1], name)


def test_heat_left_out_is_as_much_friction(patch):
    """5 % of f is 5 % of the force, all of it on the sheared film. No film changes; what is modelled is no error."""
    prepared, speed, point = patch
    none, left_out, modelled = (
        of_patch(prepared, speed, with_heat(point, **heat), {})
        for heat in ({}, {"change": 0.05}, {"change": 0.05, "heated": object()})
    )
    forces = point.balance.forces
    force = 0.05 * abs(forces.boundary + forces.shear.total)
    assert left_out[0].numerical - none[0].numerical == pytest.approx(0.05, rel=1e-9)
    assert more(none, left_out, "shear_force") == pytest.approx(force / abs(forces.shear.total), rel=1e-9)
    assert more(none, left_out, "couette_force") == pytest.approx(force / abs(forces.shear.couette), rel=1e-9)
    assert more(none, left_out, "min_film") == more(none, left_out, "rolling_force") == 0
    assert modelled[0].numerical == none[0].numerical and modelled[1] == none[1]


def test_heat_left_out_of_a_line_is_as_much_friction():
    scene = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.5, "tolerance": 0.05})
    chosen, line = line_friction(lubfric.prepare(scene), 0.02)
    none, left_out = (
        of_line(chosen.scene, replace(line, point=with_heat(line.point, **heat))) for heat in ({}, {"change": 0.05})
    )
    assert left_out[0].numerical - none[0].numerical == pytest.approx(0.05, rel=1e-9)


@pytest.mark.parametrize("patch", [0.02], indirect=True)
def test_a_film_deflected_by_another_pressure(patch):
    """The film is thinner by a share d, and sheared by d more beside what the division of the load does to every force
    of the film. The gap follows the load of the contact, in proportion: not the film itself."""
    prepared, speed, point = patch
    share = 1e-5
    none, left_out = (
        of_patch(prepared, speed, replace(point, decision=replace(point.decision, deflection_left_out=d)), {})
        for d in (0.0, share)
    )
    sensitivity = point.balance.forces.sensitivity
    assert left_out[0].numerical - none[0].numerical == pytest.approx(sensitivity * share, rel=1e-6)
    by_load = more(none, left_out, "contact_load")
    assert by_load > 0.1 * share
    assert more(none, left_out, "mean_gap") == pytest.approx(by_load, rel=1e-6)
    assert more(none, left_out, "couette_force") - more(none, left_out, "film_load") == pytest.approx(share, rel=1e-6)
