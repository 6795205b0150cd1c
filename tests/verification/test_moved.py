"""The judge of moving roughness: fields that are solved pass, fields that were spoiled do not."""

from dataclasses import replace

import numpy as np

import lubfric
from lubfric.models.deterministic import RoughBody, solve_strip
from verification.campaigns.model.moved import balances, passed
from verification.campaigns.model.random_moving import ALLOWED, drawn

SCENE = lubfric.load_scene("paper").with_(
    bodies={"radius": 5e-3, "load": 20.0, "width": 1e-3, "e_prime": 2.2e11, "hardness": None},
    lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 15e-9, "eyring_stress": 5e6},
    motion={"slide_roll_ratio": 0.5},
)
MAP = lubfric.generate_surface((24, 12), 4e-6, sq=5e-8, correlation_length=12e-6, acf="gaussian", seed=3)


def test_a_steady_film_balances_and_a_spoiled_one_does_not():
    strip = solve_strip(SCENE, MAP, 0.3)

    def off(**fields):
        return balances(strip.problem, replace(strip.result, **fields), [], 0.0)

    assert all(value <= ALLOWED[name] for name, value in off().items())
    result = strip.result
    bump = 1 + 0.05 * np.cos(np.arange(strip.problem.x.size))[:, None]
    assert off(gap=result.gap * bump)["gap"] > ALLOWED["gap"]
    assert off(pressure=1.01 * result.pressure)["load"] > ALLOWED["load"]
    assert off(flow_film=1.1 * result.flow_film)["mass"] > ALLOWED["mass"]
    assert off(fill=np.full_like(result.fill, 0.9))["bounds"] > ALLOWED["bounds"]


def test_a_pass_keeps_its_mass():
    result = passed(SCENE, [RoughBody(MAP, 0.225)], 0.3)
    assert all(value <= ALLOWED[name] for name, value in result["off"].items())
    assert result["steps"] > 24 and result["f"] != result["rest"]["f"] and len(result["shares"]) == 5


def test_a_random_point_is_the_same_every_time():
    first = drawn(5)
    again = drawn(5)
    assert first[3] == again[3] and np.array_equal(first[1][0].surface.heights, again[1][0].surface.heights)
    assert 5e3 <= first[0].bodies.load / first[0].bodies.width and -2 <= first[3]["slip"] <= 2
