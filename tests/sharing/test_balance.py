"""Load sharing against models whose balance is known in closed form."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from toys import EvenFilmLevel, Spring

import lubfric
from lubfric.contact.hertz_strip import strip_weight
from lubfric.errors import ITERATION_LIMIT
from lubfric.sharing import OperatingPoint, Settings, Start, balanced, divided, separated

SCENE = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(bodies={"load": 1.0, "width": 1.0, "hardness": None})
)
ROUGH = lubfric.generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=3e-6, seed=1)


def point(speed, stiffness=1.0, *, tolerance=1e-6, guess=0.0, level=None, closure="load"):
    """film = speed/F_H [m], gap = 3 - (F_C/stiffness)^(2/3) [m], of 1 N."""
    scene = SCENE.with_(numerics={"closure": closure})
    model = lubfric.Prepared(scene, ROUGH, Spring(3.0, 1.0, stiffness))
    return Guessed(model, speed, model.contact, Settings(level or EvenFilmLevel(), 1e-3, tolerance), guess)


@dataclass(frozen=True)
class Guessed(OperatingPoint):
    guess: float = 0.0

    def guessed_split(self):
        return self.guess


def shared(at):
    """All on the film where it clears the summits, else the balance."""
    whole = separated(at)
    return whole if whole.contact.volume_residual <= 0 else balanced(at)


@settings(max_examples=80)
@given(st.floats(1e-9, 1e3), st.floats(0.3, 30))
def test_closes_both_balances_for_any_speed(speed, stiffness):
    balance = shared(point(speed, stiffness))
    assert balance.report.converged and balance.report.evaluations <= 45
    assert balance.film_load + balance.contact_load == pytest.approx(1.0, rel=1e-14)
    if balance.contact_load > 0:
        assert balance.contact.mean_gap == pytest.approx(balance.film.thickness, rel=3e-6)
    else:
        assert speed >= 3.0  # film at full load clears the summits


@pytest.mark.parametrize("speed", [0.01, 0.3, 2.0])
def test_both_closures_find_the_one_balance(speed):
    load, separation = (shared(point(speed, tolerance=1e-9, closure=c)) for c in ("load", "separation"))
    assert separation.film_load == pytest.approx(load.film_load, rel=1e-6)


def test_an_imposed_film_finds_the_division_where_the_load_hardly_tells_it():
    """Over the whole patch the mean gap is many films thick: what the contact gains the film loses."""
    scene = lubfric.load_scene("paper").with_(
        bodies={"radius": 0.005034811870123, "width": 0.004010034878559, "load": 732.49, "hardness": 4.674e9},
        lubricant={
            "viscosity": 0.33863375416467817,
            "pressure_viscosity_coefficient": 1.9102448901951204e-08,
            "density_law": "dowson-higginson",
            "eyring_stress": 5e6,
            "limiting_stress_coefficient": 0.05,
            "limiting_stress_offset": 2e6,
        },
        motion={"entrainment_speed": -3.0228334218e-4, "slide_roll_ratio": 0.02},
        surface={"sq": 2.4961498e-8, "correlation_length": 3.328283219e-5, "seed": 748477722},
        contact={"region": "box", "shape": (48, 64), "spacing": 6.71260919e-6},
        numerics={"sampling": "patch", "film_deflection": "auto", "heat": "off"},
    )
    load, separation = (lubfric.friction(scene.with_(numerics={"closure": c})) for c in ("load", "separation"))
    assert separation.mean_gap > 20 * separation.central_film
    assert separation.coefficient == pytest.approx(load.coefficient, rel=0.015)


@pytest.mark.parametrize("hardness, level, speed", [(2e9, "ehl", 0.003), (1e9, "auto", 0.04)])
def test_the_imposed_film_finds_a_contact_whose_few_spots_yield(hardness, level, speed):
    """A start in which all that touches has yielded leads nowhere by itself."""
    scene = lubfric.load_scene("paper").with_(
        bodies={"hardness": hardness},
        surface={"correlation_length": 4e-6},
        contact={"shape": (48, 48), "spacing": 1.1e-6},
        numerics={"sampling": "patch", "film_deflection": "auto", "film_level": level},
    )
    load, separation = (lubfric.friction(scene.with_(numerics={"closure": c}), speed) for c in ("load", "separation"))
    assert separation.coefficient == pytest.approx(load.coefficient, rel=0.015)


def test_film_share_grows_with_speed():
    shares = [shared(point(u, tolerance=1e-8)).film_load for u in np.geomspace(1e-4, 10, 30)]
    assert np.all(np.diff(shares) >= 0) and shares[0] < 1e-3 and shares[-1] == 1.0


def test_a_neighbour_as_start_saves_evaluations_and_changes_nothing():
    cold = balanced(point(0.1, tolerance=1e-9, guess=10.0))
    warm = balanced(point(0.101, tolerance=1e-9, guess=10.0), cold)
    again = balanced(point(0.101, tolerance=1e-9, guess=10.0))
    assert warm.film_load == pytest.approx(again.film_load, rel=1e-7)
    assert warm.report.evaluations < again.report.evaluations


def test_an_unclosable_balance_is_reported():
    class Apart(Spring):
        def close(self, film, load, start=None, shape=None):
            return self.state(film, 2 * float(np.mean(film)))  # the gap never meets the film

    apart = replace(point(1.0), contact=Apart(3.0, 1.0, 1.0))
    balance = balanced(apart)
    assert balance.report.status == ITERATION_LIMIT and balance.report.residual == pytest.approx(1 / 3)


def test_the_strip_counts_cut_cells_by_their_share():
    x = (np.arange(10) - 4.5) * 0.1
    for b in (0.05, 0.12, 0.33, 0.5):
        assert strip_weight(x, 0.1, b).sum() * 0.1 == pytest.approx(2 * b)
    assert math.isclose(strip_weight(x, 0.1, 9.0).sum(), 10)


def test_the_loads_of_a_split_add_up_and_give_it_back():
    for split in (-35.0, -1.0, 0.0, 2.0, 25.0):
        film, contact = divided(7.0, split)
        assert film + contact == pytest.approx(7.0, rel=1e-14) and math.log(film / contact) == pytest.approx(split)
    balance = balanced(point(0.1))
    assert balance.moved(0.3).split == pytest.approx(balance.split + 0.3)


def test_films_keep_to_one_grid_from_the_second_on():
    """Cells of the film of the whole load, or of the first trial, bind no other: the root would have a jump."""
    assert Start().least_cells == Start(solved=(512,)).least_cells == 0
    assert Start(solved=(512, 96)).least_cells == 96 and Start(solved=(48, 96, 192)).least_cells == 192
