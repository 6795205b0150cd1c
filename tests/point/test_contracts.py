"""A film and a rough contact from outside run through `lubfric.friction` with no edit of lubfric."""

import ast
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from toys import EvenFilmLevel, Spring

import lubfric
from lubfric.errors import ITERATION_LIMIT, Report
from lubfric.film import LEVELS, FilmLevel, LeftOut, LineContact, higher, lowest_level

PAPER = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
B = PAPER.bodies
TOUCHING, SIGMA, STIFFNESS = 300e-9, 250e-9, 4.0  # m, m, N
FILM = EvenFilmLevel(stiffness=1e-4)  # 1e-4 U B/F_H: 100 nm of 5.5 N at 1 m/s


def closed_form(speed):
    """Film load [N] of the toys: k U B/F_H = touching - sigma ((F_T - F_H)/stiffness)^(2/3)."""

    def surplus(load):
        gap = TOUCHING - SIGMA * ((B.load - load) / STIFFNESS) ** (2 / 3)
        return FILM.stiffness * speed * B.width / load - gap

    return B.load if surplus(B.load) >= 0 else brentq(surplus, 1e-9, B.load, xtol=1e-15)


@pytest.fixture(scope="module")
def both():
    """Film and contact from outside."""
    return lubfric.prepare(PAPER, contact=Spring(TOUCHING, SIGMA, STIFFNESS), film_levels=(FILM,))


@pytest.mark.parametrize("closure", ["load", "separation"])
@pytest.mark.parametrize("speed", [0.01, 0.1, -0.5])
def test_a_film_and_a_contact_from_outside_balance_as_they_must(both, speed, closure):
    model = lubfric.prepare(PAPER.with_(numerics={"closure": closure, "tolerance": 1e-4}), like=both)
    point, film_load = lubfric.friction(model, speed), closed_form(abs(speed))
    assert point.film_load == pytest.approx(film_load, rel=1e-3)
    shear = PAPER.lubricant.viscosity * PAPER.motion.slide_roll_ratio * FILM.length * film_load / FILM.stiffness
    assert point.coefficient == pytest.approx(
        (B.boundary_friction_coefficient * (B.load - film_load) + shear) / B.load, rel=1e-3
    )
    assert point.decision.film == "even" and "film: even film; contact: a spring" == point.decision.text


def test_they_separate_and_run_dry(both):
    fast = lubfric.friction(both, 1e3)
    assert fast.film_load == B.load and "none" in fast.decision.contact and fast.clearance > 0
    dry = lubfric.friction(both, 0.0)
    assert dry.coefficient == pytest.approx(B.boundary_friction_coefficient) and dry.decision.contact == "a spring"


def test_a_sweep_warm_starts_them_and_finds_the_same(both):
    speeds = [1e-3, 0.02, 0.3, 30.0]
    curve = lubfric.stribeck(both, speeds)
    assert curve.film_load == pytest.approx([closed_form(u) for u in speeds], rel=2e-2)


def test_lubfrics_own_film_over_a_contact_from_outside():
    model = lubfric.prepare(PAPER, contact=Spring(TOUCHING, SIGMA, STIFFNESS))
    slow, fast = (lubfric.friction(model, u) for u in (1e-3, 0.03))
    assert slow.decision.film in [level.name for level in LEVELS] and 0 < slow.film_load < fast.film_load < B.load
    assert slow.mean_gap == pytest.approx(slow.balance.contact.mean_film, rel=2e-2)


def test_lubfrics_own_contact_under_a_film_from_outside():
    scene = PAPER.with_(contact={"shape": (96, 96), "spacing": 0.9e-6})
    point = lubfric.friction(lubfric.prepare(scene, film_levels=(FILM,)), 0.3, fields=True)
    assert point.decision.contact == "semi-periodic" and 0 < point.contact_load < B.load
    fields, (dx, dy) = point.balance.contact.fields, (0.9e-6, 0.9e-6)
    assert fields.pressure.sum() * dx * dy / (96 * dy) * B.width == pytest.approx(point.contact_load, rel=1e-6)


@dataclass(frozen=True)
class Failing(EvenFilmLevel):
    """Fails at the whole load."""

    def solve(self, line, **options):
        if line.load_per_width > 0.999 * B.load / B.width:
            raise lubfric.ConvergenceError("too heavy", Report("film", ITERATION_LIMIT, 1, 1.0, 0.1))
        return super().solve(line, **options)


def test_a_failed_film_of_the_whole_load_does_not_hide_the_balance(both):
    """A load of 5.5 N with a film that is not certainly below the summits: the balance in contact excludes
    separation."""
    model = lubfric.prepare(PAPER, contact=both.contact, film_levels=(Failing(stiffness=FILM.stiffness),))
    speed = 2.0
    found, reference = lubfric.friction(model, speed), lubfric.friction(both, speed)
    assert 0 < reference.contact_load and found.film_load == pytest.approx(reference.film_load, rel=2e-2)
    assert "too heavy" in found.decision.notes[0]


@dataclass(frozen=True)
class Asked(EvenFilmLevel):
    """Counts how often it is asked for a film."""

    neglects: tuple[str, ...] = ("a", "b")
    calls: tuple = ()

    def solve(self, line, **options):
        self.count.append(line)
        return super().solve(line, **options)


def test_the_ladder_passes_over_a_level_that_leaves_out_what_is_too_much_already():
    line = LineContact(1e3, B.radius, B.e_prime, 0.1, PAPER.lubricant)
    for level in (Asked,):
        level.count = []
    first, second, last = Asked(left=0.2), Asked(name="second", neglects=("a",), left=1e-3), FILM
    assert lowest_level((first, second, last), line, 0.5) == (first, LeftOut({"a": 0.2, "b": 0.2}))
    Asked.count = []
    assert lowest_level((first, second, last), line, 0.3) == (second, LeftOut({"a": 1e-3}))
    assert len(Asked.count) == 2
    Asked.count = []
    assert lowest_level((first, second, last), line, 0.1)[0] is last and len(Asked.count) == 1
    assert higher((first, second, last), second, first) is second


def test_a_level_that_the_model_has_not_is_refused():
    with pytest.raises(lubfric.InputError, match="numerics.film_level = 'ehl'.*'even'"):
        lubfric.prepare(PAPER.with_(numerics={"film_level": "ehl"}), film_levels=(FILM,))
    with pytest.raises(lubfric.InputError, match="film_levels.*at least one"):
        lubfric.prepare(PAPER, film_levels=())


def test_no_module_of_the_balance_asks_what_kind_of_film_or_contact_it_holds(root: Path):
    """Nor do the callers: only the packages of films and contacts may look inside their own."""
    for path in [*(root / "lubfric" / "point").glob("*.py"), root / "lubfric" / "steady.py"]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("isinstance", "hasattr", "getattr"):
                assert "numerics" in ast.unparse(node), f"{path.name}: {ast.unparse(node)}"


def test_loads_and_gaps_along_the_line_come_from_the_fields():
    """What a longer line is judged by: load and mean gap of stretches of its width add up to those of all of it."""
    scene = PAPER.with_(contact={"shape": (96, 96), "spacing": 0.9e-6})
    model = lubfric.prepare(scene)
    state = lubfric.friction(model, 0.003, fields=True).balance.contact
    loads, gaps = state.along_y(model.contact.weight, 8)
    assert loads.sum() == pytest.approx(1.0) and gaps.mean() == pytest.approx(state.mean_gap, rel=1e-12)
    assert loads.size == gaps.size == 8 and np.ptp(loads) > 0


class Slower(FilmLevel):
    """The numerical film at half the speed. Its own speed is that of the line only where it is ``put_back``."""

    name, words, numerical = "slower", "full EHL at half the speed", True

    def __init__(self, put_back: bool):
        self.put_back = put_back

    def solve(self, line, *, tolerance, cells=0, imposed=None, start=None):
        slower = replace(line, entrainment_speed=0.5 * line.entrainment_speed)
        film = LEVELS[-1].solve(slower, tolerance=tolerance, cells=cells, imposed=imposed, start=start)
        return replace(film, contact=line) if self.put_back else film


def test_a_film_of_another_speed_is_refused():
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    with pytest.raises(lubfric.InputError, match=r"'slower' gives a film with entrainment_speed = 0.15 m/s; .*0.3 m/s"):
        lubfric.friction(lubfric.prepare(scene, film_levels=(Slower(False),)), 0.3)
    found = lubfric.friction(lubfric.prepare(scene, film_levels=Slower(True)), 0.3)
    half = lubfric.friction(scene, 0.15)
    assert found.min_film == pytest.approx(half.min_film, rel=2e-3)
    assert found.couette_force == pytest.approx(2 * half.couette_force, rel=0.02)  # of the whole sliding speed


@pytest.mark.parametrize("given", [Slower, "ehl", [LEVELS[-1], None]])
def test_what_is_no_film_level_is_refused(given):
    with pytest.raises(lubfric.InputError, match=r"film_levels\[\d\]"):
        lubfric.prepare(lubfric.load_scene("paper"), film_levels=given)
