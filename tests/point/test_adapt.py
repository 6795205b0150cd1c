"""The parts of the adaptive loop, each alone, on toys whose answer is known."""

import math
import re
from dataclasses import dataclass, replace

import numpy as np
import pytest
from lubfric.sharing.grids import WORST_GRID, coarser_grids, grid_error, on_enough_cells
from lubfric.sharing.one_grid import Stage, needed_settings, on_grid
from lubfric.sharing.tolerances import (
    allowed_left_out,
    balance_tolerance,
    contact_tolerance,
    film_alone_tolerance,
    film_tolerance,
    first_film_tolerance,
    least_cells,
)
from toys import EvenFilmLevel, Spring

import lubfric
from lubfric.contact import Grid
from lubfric.errors import ITERATION_LIMIT
from lubfric.film import LeftOut
from lubfric.scene import budget
from lubfric.sharing import OperatingPoint, Settings, balanced, forces

PAPER = lubfric.load_scene("paper")
N = PAPER.numerics
FILM = EvenFilmLevel(stiffness=1e-4)


@dataclass(frozen=True)
class GriddedSpring(Spring):
    """A spring whose gap is too small by ``error`` (cell/finest)^2: second order, its limit known."""

    error: float = 0.0
    cell: int = 1
    coarsest: int = 8

    @property
    def grid(self):
        return Grid((64 // self.cell, 64 // self.cell), (self.cell * 1e-6, self.cell * 1e-6))

    @property
    def sq(self):
        return 1e-7

    def coarsened(self):
        return replace(self, cell=2 * self.cell) if self.cell < self.coarsest else None

    def close(self, film, load, start=None, shape=None):
        exact = super().close(film, load, start, shape)
        return replace(exact, mean_gap=exact.mean_gap - self.error * self.cell**2)


def model(contact=None, levels=(FILM,), **numerics):
    contact = contact or Spring(300e-9, 250e-9, 4.0)
    return lubfric.prepare(PAPER.with_(numerics=numerics), contact=contact, film_levels=levels)


def point(made, speed=0.1, **settings):
    given = {"level": made.film_levels[0], "film_tolerance": 0.03, "balance_tolerance": 1e-4} | settings
    return OperatingPoint(made, speed, made.contact, Settings(**given))


def stage(at, **changes):
    balance = balanced(at)
    return Stage(at, replace(balance, forces=replace(balance.forces, **changes)), LeftOut())


# ------------------------------------------------------------------ tolerances


@pytest.mark.parametrize("tolerance", [1e-3, 0.05])
@pytest.mark.parametrize("sensitivity", [0.05, 1.0, 3.0])
def test_tolerances_are_shares_of_that_on_f_by_what_reaches_it(tolerance, sensitivity):
    n = replace(N, tolerance=tolerance)
    assert film_tolerance(n, sensitivity) == pytest.approx(np.clip(0.3 * tolerance / sensitivity, 2e-4, 0.03))
    assert balance_tolerance(n, sensitivity) == pytest.approx(np.clip(0.05 * tolerance / sensitivity, 1e-7, 0.02))
    assert allowed_left_out(n, sensitivity) == pytest.approx(min(0.2 * tolerance / sensitivity, 0.3))
    assert film_alone_tolerance(n) == pytest.approx(min(0.6 * tolerance, 0.03))


def test_a_tolerance_that_is_given_is_taken():
    n = replace(N, film_tolerance=7e-4, balance_tolerance=3e-5)
    assert film_tolerance(n, 0.1) == film_alone_tolerance(n) == first_film_tolerance(n) == 7e-4
    assert balance_tolerance(n, 0.1) == 3e-5
    imposed = replace(N, closure="separation")  # an error of the load itself: not divided
    assert balance_tolerance(imposed, 1e-3) == imposed.tolerances.balance
    assert film_alone_tolerance(replace(N, model="full")) == N.tolerances.film


def test_a_gap_that_is_a_small_part_of_sq_asks_for_a_tighter_contact():
    made = lubfric.prepare(PAPER.with_(contact={"shape": (96, 96), "spacing": 0.9e-6}))
    at = point(made, level=made.film_levels[0])
    state = replace(balanced(at).contact, mean_gap=made.surface.sq)
    own = made.contact.tolerance
    assert contact_tolerance(at, state, 2 * own) is None  # enough as it is
    assert contact_tolerance(at, replace(state, mean_gap=0.01 * made.surface.sq), own) == pytest.approx(0.5e-2 * own)
    assert contact_tolerance(at, replace(state, fields=None), 1e-9) is None
    toy = point(model())
    assert contact_tolerance(toy, balanced(toy).contact, 1e-9) is None


def test_cells_are_doubled_where_the_sum_of_the_shear_stress_is_off():
    level = EvenFilmLevel(stiffness=1e-4, numerical=True)
    at = point(model(levels=(level,)))
    found = stage(at, quadrature=1.1 * 0.3 * N.tolerance).balance
    gridded = replace(found, film=replace(found.film, cells=192))
    assert least_cells(N, at.settings, gridded) == 384
    assert least_cells(N, at.settings, replace(gridded, film=replace(found.film, cells=4000))) == budget.MOST_CELLS
    assert least_cells(N, at.settings, stage(at, quadrature=0.9 * 0.3 * N.tolerance).balance) == 0
    assert least_cells(replace(N, film_tolerance=1e-3), at.settings, gridded) == 0
    assert least_cells(N, replace(at.settings, level=FILM), gridded) == 0


# ------------------------------------------------------------------ one grid


def test_settings_that_do_are_left_alone():
    at = point(model(), balance_tolerance=1e-6)
    assert needed_settings(stage(at)) is None


def test_a_level_that_leaves_out_too_much_is_raised_and_nothing_else():
    rough = EvenFilmLevel(name="rough", stiffness=1e-4, neglects=("a",), left=0.1)
    made = model(levels=(rough, FILM))
    at = point(made)
    raised = needed_settings(replace(stage(at), left_out=LeftOut({"a": 0.1})))
    assert raised.level is FILM and raised.balance_tolerance == at.settings.balance_tolerance
    assert needed_settings(replace(stage(at, sensitivity=1e-4), left_out=LeftOut({"a": 0.1}))) is None
    assert on_grid(at, made.contact, None).point.settings.level is FILM


def test_a_balance_looser_than_f_needs_is_found_again():
    at = point(model(tolerance=1e-4), balance_tolerance=0.02)
    found = on_grid(at, at.contact, None)
    allowed = balance_tolerance(at.scene.numerics, found.balance.forces.sensitivity)
    assert abs(found.balance.contact.volume_residual) <= budget.SLACK * allowed < 0.02


def fails_from(monkeypatch, number):
    """Balances of `on_grid`, of which all from ``number`` on are not closed: f jumps there."""
    found, close = [], balanced

    def jumping(at, *arguments):
        balance = close(at, *arguments)
        if len(found) >= number:
            balance = replace(balance, report=replace(balance.report, status=ITERATION_LIMIT))
        found.append(balance)
        return balance

    monkeypatch.setattr("lubfric.sharing.one_grid.balanced", jumping)
    return found


def test_the_last_balance_that_closed_stands(monkeypatch):
    """Asked again more closely it fails: f is known as closely as before, and that is an answer."""
    at = point(model(tolerance=1e-4), balance_tolerance=0.02)
    found = fails_from(monkeypatch, 1)
    stands = on_grid(at, at.contact, None)
    assert len(found) > 1 and stands.balance is found[0] and stands.balance.report.converged


def test_a_balance_that_fails_under_a_better_film_is_not_replaced_by_one_under_a_worse(monkeypatch):
    rough = EvenFilmLevel(name="rough", stiffness=1e-4, neglects=("a",), left=0.1)
    made = model(levels=(rough, FILM))
    found = fails_from(monkeypatch, 1)
    failed = on_grid(point(made), made.contact, None)
    assert len(found) > 1 and failed.point.settings.level is FILM and not failed.balance.report.converged


def test_a_balance_that_did_not_close_asks_for_a_contact_as_tight_as_it_was_asked_for():
    """f hardly feels the gap, so its own tolerance would not: but with a contact that scatters by more than the balance
    is asked for, no balance can close."""
    made = lubfric.prepare(PAPER.with_(contact={"shape": (96, 96), "spacing": 0.9e-6}))
    asked = 1e-2 * made.contact.tolerance
    at = stage(point(made, 0.01, balance_tolerance=0.02), sensitivity=1e-3, by_load=1e-3)
    at = replace(at, point=replace(at.point, settings=replace(at.point.settings, balance_tolerance=asked)))
    open_ = replace(at.balance, report=replace(at.balance.report, status=ITERATION_LIMIT))
    assert needed_settings(replace(at, balance=open_)).contact_tolerance < made.contact.tolerance


def test_a_part_that_does_not_hold_gives_way_to_the_whole():
    @dataclass(frozen=True)
    class Whole(Spring):
        def holds(self, part, shape, state):
            return False

    whole, part = Whole(300e-9, 250e-9, 4.0), Spring(100e-9, 250e-9, 4.0)
    at = replace(point(model(whole)), contact=part)
    found = on_grid(at, whole, None)
    assert found.point.contact is whole
    assert found.balance.film_load == pytest.approx(on_grid(point(model(whole)), whole, None).balance.film_load)


# ------------------------------------------------------------------ grids


def test_the_error_of_a_grid_is_the_rest_of_its_series():
    found = replace(stage(point(model()), sensitivity=0.5, by_load=math.inf).balance, slope=None)
    for ratio in (0.25, 0.5, 0.7):
        changes = [-1e-3, -1e-3 * ratio, -1e-3 * ratio**2]
        rest = 1e-3 * ratio**2 * ratio / (1 - ratio)
        assert grid_error(changes, found, 0.0) == pytest.approx(2 * 0.5 * max(rest, 1e-3 * ratio / 12))
    assert grid_error([1e-3], found, 0.0) == pytest.approx(2 * 0.5 * 1e-3)  # 1/2 where nothing else is known
    assert grid_error([1e-3, 5e-3], found, 0.0) == pytest.approx(2 * 0.5 * 5e-3 * 3)  # no more than 3/4
    assert grid_error([1e-3, 1e-9], found, 0.0) == pytest.approx(2 * 0.5 * 1e-3 / 12)  # small by chance
    assert grid_error([], found, 0.0) == math.inf
    assert grid_error([1e-3], found, WORST_GRID * 0.5) == WORST_GRID * 0.5  # so little of the film in f
    assert grid_error([1e-3], replace(found, contact_load=0.0), 1.0) == math.inf
    light = replace(found, slope=1e-3)  # ln(F_H/F_C) moves by 1: e times the load, not twice
    assert grid_error([1e-3], light, 0.0) == pytest.approx(2 * 0.5 * 1e-3 * (math.e - 1))
    film = found.contact.mean_film  # summits lower by a hundredth of it, which two grids do not show
    assert grid_error([1e-9], found, 0.0, 0.01 * film) == pytest.approx(2 * 0.5 * 0.3 * 0.005)


def test_a_contact_that_carries_little_is_felt_little():
    """What its gap is wrong by moves f by its share of the load: the measured change of f, where the gap is moved."""

    @dataclass(frozen=True)
    class Raised(Spring):
        higher: float = 1.0

        def state(self, film, gap):
            return super().state(film, self.higher * gap)

    shares = []
    for speed in (0.03, 0.3, 2.0):
        one, other = (
            balanced(point(model(Raised(300e-9, 250e-9, 4.0, higher=h)), speed, balance_tolerance=1e-10))
            for h in (1.0, 1.001)
        )
        moved = abs(other.forces.coefficient / one.forces.coefficient - 1) / 1e-3
        assert moved == pytest.approx(one.forces.by_load, rel=0.06) and one.forces.gap_sensitivity <= one.forces.by_load
        shares.append(one.contact_load / PAPER.bodies.load)
    assert 0 < shares[-1] < 0.1 and one.forces.by_load < 0.4 * one.forces.sensitivity


@pytest.mark.parametrize("area", [0.3, 0.9])
def test_the_shear_of_the_film_follows_the_area_that_the_contact_leaves_open(area):
    """An error of the film moves a share e of its load to the contact, whose area A grows in proportion: by how much
    the rest of A changes, by differences, beside the same film over a contact without area."""
    at = point(model(), 0.05)
    found = replace(balanced(at), contact_load=0.5, film_load=5.0)
    covered, bare = (
        forces(at.scene, FILM, replace(found, contact=replace(found.contact, real_contact_area_fraction=share)))
        for share in (area, 0.0)
    )
    e = 1e-6
    more = area * (1 + e * found.film_load / found.contact_load)
    open_ = (area - more) / (1 - area) / e
    moved = (covered.sensitivity - bare.sensitivity) * (bare.boundary + bare.shear.total)
    assert moved == pytest.approx((max(1.0, -open_) - 1) * bare.shear.felt, rel=1e-5)
    assert open_ < -1


def test_a_gap_is_felt_by_the_film_as_its_load_thickens_it():
    """Barus' law: beside what f feels of the film itself, half of alpha p of the film's friction, over the slope."""
    scene = PAPER.with_(numerics={"sampling": "patch"}, lubricant={"viscosity_law": "barus"})
    made = lubfric.prepare(scene.with_(contact={"shape": (64, 64), "spacing": 0.8e-6}))
    found = balanced(point(made, 0.03, level=made.film_levels[-1]))
    plain = forces(made.scene, made.film_levels[-1], found, None, 0.25)
    share, force = found.contact_load / scene.bodies.load, abs(plain.boundary + plain.shear.total)
    more = plain.by_load * 0.25 / (0.5 * share) - plain.sensitivity
    thicker = scene.lubricant.pressure_viscosity_coefficient * found.film.pressure.max()
    assert share > 0 and thicker > 0.1
    assert more * force == pytest.approx(0.5 * thicker * plain.shear.felt, rel=1e-9)


@pytest.mark.parametrize("speed", [0.14, 0.16, 0.18, 0.2])
def test_a_contact_read_from_a_curve_is_felt_as_little_at_the_first_trial(speed):
    """A balance that is met at once has no slope of its own, and that of the curve is enough. Against the change of f
    where the whole curve is raised."""
    scene = lubfric.load_scene("flat").with_(
        surface={"correlation_length": 1.2e-5}, contact={"shape": (128, 128)}, numerics={"sampling": "patch"}
    )
    made = lubfric.prepare(scene)
    settings = {"level": made.film_levels[-1], "film_tolerance": 1e-3, "balance_tolerance": 1e-10}
    before, curve = balanced(point(made, speed, **settings)), made.contact.curve
    at_once = balanced(point(made, speed, **settings | {"balance_tolerance": 1e-3}), before)
    assert at_once.report.evaluations == 1 and before.report.evaluations > 1
    higher = replace(curve, mean_gap=1.001 * curve.mean_gap, touching_gap=1.001 * curve.touching_gap)
    raised = balanced(replace(point(made, speed, **settings), contact=replace(made.contact, curve=higher)))
    moved = abs(raised.forces.coefficient / before.forces.coefficient - 1) / 1e-3
    assert moved <= before.gap_sensitivity <= at_once.gap_sensitivity <= 1.5 * before.gap_sensitivity
    assert at_once.gap_sensitivity < 0.6 * at_once.forces.sensitivity and moved > 0.4 * before.gap_sensitivity


def test_the_grids_end_at_the_given_one():
    spring = GriddedSpring(300e-9, 250e-9, 4.0)
    assert [g.cell for g in coarser_grids(spring, 1e-7)] == [8, 4, 2, 1]
    assert [g.cell for g in coarser_grids(spring, 2e-7)] == [2, 1]  # the roughness is lost, but one is tried
    plain = Spring(300e-9, 250e-9, 4.0)
    assert coarser_grids(plain, 1e-7) == [plain]


@pytest.mark.parametrize("tolerance", [0.05, 0.01, 1e-3, 2e-4])
def test_no_finer_grid_than_the_tolerance_needs(tolerance):
    """The gap of the coarser grids is too small by a known amount: the film load found is within the tolerance of that
    of no error, or the grid is the finest; and a tighter tolerance never takes a coarser one."""
    spring = GriddedSpring(300e-9, 250e-9, 4.0, error=0.05e-9)
    made = model(spring, tolerance=tolerance)
    found, index, error = on_enough_cells(point(made), coarser_grids(spring, 1e-7), None)
    exact = balanced(point(model(replace(spring, error=0.0), tolerance=1e-4), balance_tolerance=1e-7))
    miss = abs(found.balance.forces.coefficient / exact.forces.coefficient - 1)
    assert index == 3 or error <= budget.CONTACT_GRID * tolerance
    assert miss <= tolerance or index == 3
    looser = model(spring, tolerance=4 * tolerance)
    coarser = on_enough_cells(point(looser), coarser_grids(spring, 1e-7), None)[1]
    assert coarser <= index


def test_a_grid_too_coarse_to_hold_the_summits_is_passed_over():
    spring = GriddedSpring(300e-9, 250e-9, 4.0, error=4.7e-9, coarsest=8)  # 300 nm at the coarsest: no contact there
    made = model(spring, tolerance=0.01)
    found, index, _ = on_enough_cells(point(made, speed=0.3), coarser_grids(spring, 1e-7), None)
    assert index > 0 and found.balance.contact_load > 0


# ------------------------------------------------------------------ documentation


def test_the_page_on_levels_quotes_the_budget(root):
    text = (root / "docs" / "levels.md").read_text(encoding="utf-8")
    table = {row[1]: row[0] for row in re.findall(r"^\| ([\d., a-z]+) \| ([^|]+?) \|", text, re.M)}
    assert table["what the film level leaves out"] == f"{budget.FILM_LEVEL:g}"
    assert table["grid of the film"] == f"{budget.FILM_GRID:g}, without contact {budget.FILM_GRID_ALONE:g}"
    assert table["sum of its shear stress"] == f"{budget.SHEAR_SUM:g}"
    assert table["contact grid"] == f"{budget.CONTACT_GRID:g}"
    assert table["closing of load and volume"] == f"{budget.BALANCE:g}"
    assert table["contact solver"] == f"{budget.CONTACT:g}"
