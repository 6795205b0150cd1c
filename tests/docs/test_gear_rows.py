"""The rows of a gear flank that docs/studies.md states are those of two turning bodies that touch on the line of
action."""

import re

import numpy as np
import pytest
from pages import ROOT


@pytest.mark.parametrize("s", [-3e-3, 0.0, 4e-3])
def test_radii_and_speeds_of_a_spur_gear_follow_from_its_turning_bodies(s):
    """Centres on the y axis, the pitch point at the origin, the line of action at the angle α to the x axis. The speed
    of a body at the contact is ω x r; along the line of action both are equal, across it they are those of rolling and
    sliding."""
    alpha = np.radians(22.0)
    pitch_radii = {1: 0.03, 2: 0.05}
    turning = {1: 100.0, 2: 100.0 * 0.03 / 0.05}
    along = np.array([np.cos(alpha), np.sin(alpha)])
    across = np.array([-np.sin(alpha), np.cos(alpha)])
    contact = -s * along  # away from the tangent point of body 1
    names = {"s": s, "α": alpha, "tan": np.tan}
    names |= {f"r_b{i}": radius * np.cos(alpha) for i, radius in pitch_radii.items()}
    names |= {f"ω{i}": speed for i, speed in turning.items()}
    text = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    for name, formula in re.findall(r"`([Ru][12])=(\S+?)`", text):
        names[name] = eval(formula.replace("·", "*"), names)
    advance = {}
    for body, sign in ((1, 1.0), (2, -1.0)):  # body 1 above turns one way, body 2 below the other
        arm = contact - sign * np.array([0.0, pitch_radii[body]])
        speed = sign * turning[body] * np.array([-arm[1], arm[0]])
        tangent_point = (arm @ across) * across - arm  # foot of the centre on the line of action, from the contact
        assert names[f"R{body}"] == pytest.approx(np.linalg.norm(tangent_point), rel=1e-12)
        assert abs(speed @ across) == pytest.approx(names[f"u{body}"], rel=1e-12)
        advance[body] = speed @ along
    assert advance[1] == pytest.approx(advance[2])
    (takes,) = re.findall(r"a step ds\s+takes\s+`ds/\((\S+?)\)`", text)
    assert eval(takes.replace("·", "*"), names) == pytest.approx(abs(advance[1]))
