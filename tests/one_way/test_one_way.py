"""One-way load sharing: its film against closed forms, its balance, its limits, and the deterministic film."""

import numpy as np
import pytest
from scipy.optimize import brentq

import lubfric
from lubfric.deterministic import dry_contact, lay_out, layer
from lubfric.film import LineContact
from lubfric.film import rigid_cylinder as rigid
from lubfric.oil import Lubricant, viscosity
from lubfric.one_way.film import Kept, _order, _system, gap_film
from lubfric.one_way.lift import lifted, spots_of
from lubfric.one_way.limit import pressure_limit
from lubfric.one_way.point import solve_one_way
from lubfric.one_way.together import together
from lubfric.output import main
from lubfric.output.fields import vtk_bytes
from lubfric.sampling import Uncertainty
from lubfric.surface import Surface

SCENE = lubfric.load_scene("paper").with_(
    contact={"shape": (64, 64), "spacing": 90e-6 / 64}, numerics={"closure": "one-way", "grid": "given"}
)
MODEL = lubfric.prepare(SCENE)


def smooth(h0, n=512, load=900.0, oil=None, ends=(1.2e-4, 5e-5)):
    oil = oil or Lubricant(0.01, viscosity_law="constant")
    contact = LineContact(load, 2e-3, 1e13, 0.1, oil)
    flat = Surface(np.zeros((64, 1)), (sum(ends) / n,) * 2, periodic_axes=(True, True))
    return lay_out(flat, contact, sliding=0.2, boundary_friction=0.09, ends=ends)


def test_the_film_of_a_given_gap_is_martins():
    h0 = 1e-6
    problem = smooth(h0)
    found = gap_film(problem, problem.rigid_gap + h0)
    exact = rigid.pressure(problem.x, h0, radius=2e-3, entrainment_speed=0.1, viscosity=0.01)
    assert np.abs(found.reduced[:, 0] - exact).max() < 2e-3 * exact.max()
    carried = found.reduced.sum() * problem.spacing[0] + found.inlet.load
    assert carried == pytest.approx(4.8950 * 0.01 * 0.1 * 2e-3 / h0, rel=1e-3)


def test_a_smooth_rigid_film_is_lifted_to_its_load():
    load = 50.0
    found = solve_one_way(smooth(0, load=load))
    assert found.lifted and found.contact_load == 0
    h0 = 4.8950 * 0.01 * 0.1 * 2e-3 / load
    assert found.gap.min() == pytest.approx(h0, rel=5e-3)
    friction = rigid.couette_friction(h0, radius=2e-3, speed_difference=0.2, viscosity=0.01)
    assert found.couette == pytest.approx(friction, rel=1e-2)


def test_a_wall_stops_the_flow():
    """A gap of a nanometre across the whole width: what comes in goes back up the gap, at a higher pressure."""
    problem = smooth(1e-6)
    wall = np.abs(problem.x)[:, None] < 1e-6
    free = gap_film(problem, problem.rigid_gap + 1e-6)
    shut = gap_film(problem, np.where(wall, 1e-9, problem.rigid_gap + 1e-6))
    assert abs(shut.inlet.flow[0]) < 2e-3 * free.inlet.flow[0] and shut.reduced.max() > 2 * free.reduced.max()


def test_a_film_that_ruptures_keeps_its_mass():
    """Two humps: what flows through every section, ruptured or not, is what comes in; the second one makes a film of
    what the first one lets pass, so the film ahead of it is not that of a full gap."""
    problem = smooth(1e-6, ends=(1.2e-4, 9e-5))
    hump = 1.1e-6 * np.exp(-(((problem.x - 7e-5) / 4e-6) ** 2))[:, None]
    gap = problem.rigid_gap + 1e-6 - hump
    found = gap_film(problem, gap)
    assert found.ruptured.any() and (np.diff(np.flatnonzero(~found.ruptured[:, 0])) > 1).any()  # it fills again
    Q, h, dx = found.reduced[:, 0], gap[:, 0], problem.spacing[0]
    carried = found.fill[:, 0] * (h + 0.5 * np.diff(h, prepend=h[0])) * problem.speed
    pressed = (0.5 * (h[1:] + h[:-1])) ** 3 / (12 * 0.01) * np.diff(Q) / dx
    assert carried[1:-1] - pressed[1:] == pytest.approx(found.inlet.flow[0], rel=1e-3)
    assert found.fill.min() > 0 and found.fill.max() == 1 and (found.reduced[found.fill < 1] == 0).all()


def test_kept_factors_lead_to_the_film_of_a_neighbouring_gap(monkeypatch):
    """One without a factorisation where the gap changes but not where it has ruptured; else the set is found anew. The
    oracle is the film of the same gap with nothing kept."""
    problem = layer(SCENE, MODEL.surface, 0.05)(MODEL.surface.shape)
    gap = problem.rigid_gap - problem.rigid_gap.min() + 60e-9
    near = gap_film(problem, gap).kept
    for factor in (1.02, 1.3):
        cold, warm = gap_film(problem, factor * gap), gap_film(problem, factor * gap, near)
        assert warm.reduced.sum() == pytest.approx(cold.reduced.sum(), rel=1e-3)
    same = near.ruptured
    with monkeypatch.context() as without:
        without.setattr("lubfric.one_way.film.splu", None)
        system = _system(problem.with_lubricant(Lubricant(0.36, viscosity_law="constant")), 1.02 * gap)
        iterated = system.solve(near)[0]
    exact = system.solve(Kept(same))[0]
    assert np.where(same, 0, iterated) == pytest.approx(np.where(same, 0, exact), abs=1e-4 * exact[~same].max())


def test_the_spots_of_a_contact_close_across_the_period():
    pressure = np.zeros((6, 8))
    pressure[2, [0, 1, 7]], pressure[4, 3] = [1.0, 2.0, 3.0], 4.0
    spots = spots_of(pressure)
    assert sorted(spots.load) == [4.0, 6.0]
    field = np.zeros((6, 8))
    field[2, 7], field[4, 3], field[0, 0] = 10.0, 5.0, 99.0
    assert spots.mean_of_largest(field) == pytest.approx((6 * 10 + 4 * 5) / 10)


def test_a_hertzian_contact_is_lifted_by_the_integral_of_ertel():
    """Smooth line contact: Q at the edge of the flat, 12 eta0 U ∫ (h - h0)/h³ dx up to -b over the gap of Hertz lifted
    by h0, is that of the pressure at which the film rubs like the contact."""
    radius, load, speed, eta, alpha = 2e-2, 2e5, 0.5, 0.05, 20e-9
    line = LineContact(load, radius, 2.3e11, speed, Lubricant(eta, alpha, viscosity_law="barus"))
    b = np.sqrt(8 * load * radius / (np.pi * 2.3e11))
    flat = Surface(np.zeros((64, 1)), (3.2 * b / 1600,) * 2, periodic_axes=(True, True))
    problem = lay_out(flat, line, sliding=2 * speed, boundary_friction=0.09, ends=(2 * b, 1.2 * b))
    dry = dry_contact(problem)
    gap = np.where(dry.pressure > 0, 0.0, np.maximum(dry.gap, 0.0))
    s = np.geomspace(1.0, 30.0, 200001)  # -x/b
    hertz = b**2 / (2 * radius) * (s * np.sqrt(s**2 - 1) - np.log(s + np.sqrt(s**2 - 1)))

    def surplus(h0):
        p = brentq(lambda p: eta * np.exp(alpha * p) * 2 * speed / h0 / (0.09 * p) - 1, 60e6, 2e9)
        return 12 * eta * speed * b * np.trapezoid(hertz / (hertz + h0) ** 3, s) - -np.expm1(-alpha * p) / alpha

    expected = brentq(surplus, 5e-8, 2e-6)
    assert lifted(problem, gap, spots_of(dry.pressure)).height == pytest.approx(
        expected, rel=0.08
    )  # some flows back along the flat


@pytest.mark.parametrize("film, sliding", [(20e-9, 0.02), (200e-9, 0.2), (1e-6, 0.02)])
def test_the_pressure_limit_is_where_the_film_rubs_like_the_contact(film, sliding):
    oil = Lubricant(0.36, 25e-9)
    p = float(pressure_limit(oil, np.array([film]), sliding, 0.09)[0])
    assert float(viscosity(oil, p)) * sliding / film == pytest.approx(0.09 * p, rel=1e-2)
    assert np.isinf(pressure_limit(Lubricant(0.36, viscosity_law="constant"), np.array([film]), sliding, 0.09)).all()


def test_loads_add_up_and_the_limits_are_those_of_film_and_contact():
    curve = lubfric.stribeck(MODEL, [0.3, 0.03, 0.003, 1e-5])
    assert curve.contact_load + curve.film_load == pytest.approx(SCENE.bodies.load, rel=2.1e-3)
    assert np.all(np.diff(curve.contact_load) >= 0) and curve.contact_load[0] == 0
    assert curve.coefficient[-1] == pytest.approx(0.09, rel=5e-3)
    assert curve.boundary_force == pytest.approx(0.09 * curve.contact_load)


def test_it_is_near_the_deterministic_film():
    for speed, within in ((0.3, 0.03), (0.003, 0.02)):
        whole = lubfric.friction(SCENE.with_(numerics={"closure": "load", "model": "deterministic"}), speed)
        assert lubfric.friction(MODEL, speed).coefficient == pytest.approx(whole.coefficient, rel=within)


def test_its_fields_are_where_those_of_other_models_are():
    """``fields=True`` kept them, and `pressure` said to solve it with ``fields=True``."""
    found = lubfric.friction(MODEL, 0.003, fields=True)
    (nx, ny), one = found.gap.shape, found.one_way[-1]
    assert found.x.shape == (nx,) and found.y.shape == (ny,) and found.pressure.shape == (nx, ny)
    assert found.y[1] * ny == pytest.approx(MODEL.surface.size[1])
    step = found.x[1] - found.x[0]
    load = found.pressure.mean(axis=1).sum() * step * SCENE.bodies.width
    assert load == pytest.approx(found.contact_load, rel=0.01) and found.gap[one.closed].max() < found.gap.max()
    vtk = vtk_bytes(MODEL, found)
    assert b"contact_pressure" in vtk and b"gap" in vtk


def test_the_command_writes_its_fields_and_picture(tmp_path):
    """Neither was written, whatever --fields said."""
    (tmp_path / "s.toml").write_text(SCENE.to_toml())
    arguments = ["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o"), "--speeds", "0.003,0.3"]
    assert main([*arguments, "--fields", "0.3,0.003"]) == 0
    fields = np.load(tmp_path / "o" / "fields.npz")
    found = lubfric.friction(MODEL, 0.003)
    assert fields["speed"].tolist() == [0.3, 0.003] and fields["gap_1"].shape == found.gap.shape
    assert fields["contact_pressure_1"].max() == pytest.approx(found.pressure.max(), rel=0.02)
    assert (tmp_path / "o" / "contact.png").stat().st_size > 10_000


def test_a_density_that_is_left_out_is_told():
    """Dowson and Higginson's law did nothing, without a word. Its ratio at the film's largest pressure, written out."""
    scene = SCENE.with_(lubricant={"density_law": "dowson-higginson"}, numerics={"accept": True})
    found = lubfric.friction(scene, 0.01)
    told = [entry for entry in found.validity if entry.what.startswith("compression")]
    pressure = found.one_way[-1].film_pressure.max()
    assert [entry.value for entry in told] == [pytest.approx(0.34 * pressure / (5.9e8 + pressure))]
    constant = lubfric.friction(scene.with_(lubricant={"density_law": "constant"}), 0.01)
    assert not any(entry.what.startswith("compression") for entry in constant.validity)
    assert "nan" not in found.uncertainty.text and "numerical not known" in Uncertainty().short(0.1)


def test_it_is_turned_with_the_speed_and_warm_starts_change_nothing():
    from dataclasses import replace

    turned = lubfric.prepare(SCENE, surface=replace(MODEL.surface, heights=MODEL.surface.heights[::-1]))
    forward = lubfric.friction(MODEL, 0.01)
    assert lubfric.friction(turned, -0.01).coefficient == pytest.approx(forward.coefficient, rel=1e-9)
    warm = lubfric.friction(MODEL, 0.01, start=lubfric.friction(MODEL, 0.02))
    assert warm.coefficient == pytest.approx(forward.coefficient, rel=4e-3)


@pytest.mark.parametrize("change", [{"contact": {"geometry": "flat"}}, {"motion": {"slide_roll_ratio": 0.5}}])
def test_what_it_does_not_take_is_refused(change):
    with pytest.raises(lubfric.InputError, match="one-way"):
        lubfric.prepare(SCENE.with_(**change))


def test_a_transient_is_refused():
    with pytest.raises(lubfric.InputError, match="one-way"):
        lubfric.transient(SCENE, [0.0, 1e-3])


def test_two_conditions_are_met_at_once_or_the_second_unknown_at_its_bound():
    def f(x, last):
        return np.array([np.sinh(x[0]) + 0.5 * x[1] - 1.0, 1.5 * x[1] + 0.2 * x[0] ** 2 - 0.7]), (last or 0) + 1

    found = together(f, np.array([-2.0, 2.0]), None, lowest=-9.0, tolerances=np.array([1e-3, 1e-3]))
    assert found.converged and found.payload == len(found.history) and np.abs(found.values).max() <= 1e-3
    y = brentq(lambda y: 1.5 * y + 0.2 * np.arcsinh(1.0 - 0.5 * y) ** 2 - 0.7, -1, 2)
    assert found.unknowns == pytest.approx([np.arcsinh(1 - 0.5 * y), y], abs=2e-3)
    held = together(f, np.array([-2.0, 2.0]), None, lowest=1.0, tolerances=np.array([1e-3, 1e-3]))
    assert held.converged and held.unknowns == pytest.approx([np.arcsinh(0.5), 1.0], abs=2e-3) and held.values[1] > 0


@pytest.mark.parametrize("speed", [0.01, 0.003])
def test_one_condition_nested_in_the_other_gives_the_same(speed, monkeypatch):
    at_once = lubfric.friction(MODEL, speed)
    monkeypatch.setattr("lubfric.one_way.together.MOST", 1)
    nested = lubfric.friction(MODEL, speed)
    assert at_once.coefficient == pytest.approx(nested.coefficient, rel=3e-3)
    assert at_once.one_way[-1].spot_film == pytest.approx(nested.one_way[-1].spot_film, rel=1e-2)


def test_the_order_of_elimination_has_every_cell_once():
    for shape in ((1, 1), (5, 2), (7, 3), (12, 8)):
        assert sorted(_order(*shape)) == list(range(shape[0] * shape[1]))


def test_a_contact_that_a_film_carries_is_told():
    """110 N, limiting stress: at 0.3 m/s the film on the spots is nearly the whole gap, and the deterministic film
    counts next to nothing as asperities; at 0.003 m/s they carry."""
    heavy = SCENE.with_(
        bodies={"load": 110.0},
        lubricant={"limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2e6},
        numerics={"grid": "auto"},
    )
    fast, slow = (lubfric.friction(heavy, speed) for speed in (0.3, 0.003))
    assert any("a film carries what is counted as contact" in note for note in fast.report.notes)
    assert not any("counted as contact" in note for note in slow.report.notes)
    assert fast.one_way[-1].spot_film > 0.5 * fast.mean_gap and slow.one_way[-1].spot_film < 0.5 * slow.mean_gap
