"""What a finite-element solver refuses, and what it says when it stops short."""

import math
import pickle

import numpy as np
import pytest

from verification.fem.parts import case_of
from verification.fem.solvers import contact, ehl, layer3d, reynolds, sharing
from verification.fem.solvers.compliance import Elastic
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.harmonic import HarmonicStrip, compliance, press
from verification.fem.solvers.report import InputError, SolveError
from verification.fem.studies.reynolds import PARABOLA, parabola_mesh

UNIT = Elastic(1.0, 0.3)
STEEL = Elastic.from_e_prime(231e9, 0.3)
OIL = Fluid(0.1)
BRICKS = layer3d.Layer3D(body=UNIT, size=(1.0, 1.0), levels=layer3d.graded_levels(1.0, 2, 4.0), shape=(8, 8), degree=1)
STRIP = HarmonicStrip((24, 12), (1e-6, 1e-6), STEEL)
LINE = ehl.LineContact.of(case_of(20, 5))
FLAT = sharing.FlatBodies(
    contact=LINE,
    width=6e-3,
    pressed=lambda p: (3e-7 * math.exp(-p / 5e7), p / 5e9),
    boundary_friction=0.09,
    sliding=0.04,
)


@pytest.fixture(scope="module")
def strip():
    return compliance(STRIP)


@pytest.mark.parametrize(
    "shape, load, limit", [((3, 12), 1.0, math.inf), ((24, 12), -1.0, math.inf), ((24, 12), 1e9, 1e9)]
)
def test_an_impossible_load_on_the_strip_is_refused(strip, shape, load, limit):
    with pytest.raises(InputError, match="load_per_width"):
        press(strip, np.zeros(shape), load, hardness=limit)


def cut_short(name, strip):
    """A solver with too few steps, and where its result is."""
    heights = np.random.default_rng(5).standard_normal((24, 12)) * 1e-7
    parabola = reynolds.ReynoldsProblem(
        mesh=parabola_mesh(200), film=PARABOLA.film, fluid=OIL, speed=1.0, cavitation=True
    )
    return {
        "film": lambda: reynolds.solve_reynolds(parabola, max_iterations=2),
        "contact": lambda: contact.solve_contact(lambda f: f, np.ones(9), np.arange(9.0), 1.0, max_iterations=1),
        "bricks": lambda: layer3d.solve(layer3d.multigrid(BRICKS), BRICKS.weights * BRICKS.x[0], max_iterations=1),
        "ehl": lambda: ehl.solve_ehl(LINE, refinements=0, max_iterations=1),
        "strip": lambda: press(strip, heights, 100.0, max_iterations=1),
        "sharing": lambda: sharing.share_load(FLAT, refinements=0, max_evaluations=1, guess=3.0),
    }[name]


@pytest.mark.parametrize("name", ["film", "contact", "bricks", "ehl", "strip", "sharing"])
def test_a_solve_cut_short_raises_with_report_and_result(name, strip):
    solve = cut_short(name, strip)
    with pytest.raises(SolveError, match="iteration_limit") as caught:
        solve()
    report = caught.value.report
    assert not report.converged and report.residual > report.tolerance and report.history
    copy = pickle.loads(pickle.dumps(SolveError("message", report)))
    assert copy.report.residual == report.residual
    assert caught.value.result.report is report
