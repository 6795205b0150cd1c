"""What a finite-element solver refuses, and what it says when it stops short."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
import skfem

from verification.fem import contact, ehl, layer3d, reynolds, sharing
from verification.fem.compliance import Elastic
from verification.fem.fluid import Fluid
from verification.fem.harmonic import Strip, compliance, press
from verification.fem.layer import graded_mesh, make_layer
from verification.fem.report import InputError, SolveError
from verification.parts import case_of
from verification.studies.reynolds import PARABOLA, parabola_mesh

UNIT, STEEL = Elastic(1.0, 0.3), Elastic.from_e_prime(231e9, 0.3)
OIL = Fluid(0.1)
BRICKS = layer3d.Layer3D(UNIT, (1.0, 1.0), layer3d.graded_levels(1.0, 2, 4.0), (8, 8), 1)
STRIP = Strip((24, 12), (1e-6, 1e-6), STEEL)
LINE = ehl.LineContact(
    *(case_of(20, 5)[k] for k in ("load_per_width", "radius", "e_prime", "entrainment_speed")),
    Fluid(0.0358, "roelands", 2.2e-8),
)
FLAT = sharing.FlatBodies(LINE, 6e-3, lambda p: (3e-7 * math.exp(-p / 5e7), p / 5e9), 0.09, 0.04)


def film(**change):
    return reynolds.Problem(
        **{"mesh": skfem.MeshLine(), "film": lambda x: 1 + 0 * x[0], "fluid": OIL, "speed": 1.0} | change
    )


def touch(**change):
    def never(force):
        raise AssertionError("work was done")

    asked = {"weights": np.ones(2), "gap0": np.zeros(2), "load": 1.0} | change
    return contact.solve_contact(never, asked.pop("weights"), asked.pop("gap0"), asked.pop("load"), **asked)


def skewed():
    mesh = skfem.MeshTri.init_tensor(np.linspace(-0.5, 0.5, 5), np.linspace(-0.5, 0, 3))
    mesh.p[1, (mesh.p[0] > 0.49) & (mesh.p[1] < -0.1) & (mesh.p[1] > -0.4)] += 0.03
    make_layer(mesh, UNIT, sides="free")
    return mesh


REFUSED = {
    "degree = 3": lambda: film(degree=3),
    "MeshTet": lambda: film(mesh=skfem.MeshTet()),
    "speed = -1.0 m/s": lambda: film(speed=-1.0),
    "'more'": lambda: film(stabilisation="more"),
    "needs degree = 1": lambda: film(stabilisation="supg", degree=2),
    "film_thickness has a minimum of -0.5 m": lambda: film(film=lambda x: x[0] - 0.5),
    "viscosity = 0.0": lambda: Fluid(0.0),
    "viscosity_law = 'baros'": lambda: Fluid(0.1, "baros"),
    "density_law = 'x'": lambda: Fluid(0.1, density_law="x"),
    "pressure_viscosity_coefficient = -1e-08": lambda: Fluid(0.1, "barus", -1e-8),
    "roelands_index = -1.0": lambda: Fluid(0.1, "roelands", 1e-8, -1.0),
    "young = 0.0": lambda: Elastic(0.0, 0.3),
    "poisson = 0.5": lambda: Elastic(1.0, 0.5),
    "load = 0.0": lambda: touch(load=0.0),
    "cannot be carried below limit = 0.2": lambda: touch(limit=0.2),
    "tolerance = 0.0; allowed: .0, 1.": lambda: touch(tolerance=0.0),
    r"gap0 has shape .2,. or is not finite": lambda: touch(gap0=np.array([0.0, np.nan])),
    "weights": lambda: touch(weights=np.array([1.0, 0.0])),
    "same depths": lambda: make_layer(skewed(), UNIT),
    "degree = 3, sides": lambda: make_layer(skfem.MeshTri(), UNIT, degree=3),
    "surface lies at z = 1": lambda: make_layer(skfem.MeshTri(), UNIT),
    "strip 0.7": lambda: graded_mesh(1.0, 1.0, 0.7, 0.1),
    "shape = .8, 8., degree = 3": lambda: replace(BRICKS, degree=3),
    "shape = .7, 8., degree = 2": lambda: replace(BRICKS, shape=(7, 8), degree=2),
    r"levels = .-1.  -0.5": lambda: replace(BRICKS, levels=np.array([-1.0, -0.5])),
    "size = .1.0, 0.0": lambda: replace(BRICKS, size=(1.0, 0.0)),
    "force has shape .8, 8.": lambda: layer3d.solve(layer3d.multigrid(BRICKS), np.zeros((8, 8))),
    "shape = .23, 12.": lambda: Strip((23, 12), (1e-6, 1e-6), STEEL),
    "side = 4": lambda: Strip((24, 12), (1e-6, 1e-6), STEEL, side=4),
    "load_per_width = -1.0": lambda: replace(LINE, load_per_width=-1.0),
    "radius = nan": lambda: replace(LINE, radius=math.nan),
    "entrainment_speed = 0.0": lambda: replace(LINE, entrainment_speed=0.0),
    "refinements = -1": lambda: ehl.solve_ehl(LINE, refinements=-1),
    "tolerance = 0.0; allowed: > 0": lambda: ehl.solve_ehl(LINE, tolerance=0.0),
}


@pytest.mark.parametrize("words", REFUSED)
def test_an_impossible_input_is_refused_in_words(words):
    with pytest.raises(InputError, match=words):
        REFUSED[words]()


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
    parabola = reynolds.Problem(parabola_mesh(200), PARABOLA.film, OIL, 1.0, cavitation=True)
    return {
        "film": lambda **o: reynolds.solve_reynolds(parabola, max_iterations=2, **o),
        "contact": lambda **o: contact.solve_contact(
            lambda f: f, np.ones(9), np.arange(9.0), 1.0, max_iterations=1, **o
        ),
        "bricks": lambda **o: layer3d.solve(
            layer3d.multigrid(BRICKS), BRICKS.weights * BRICKS.x[0], max_iterations=1, **o
        ),
        "ehl": lambda **o: ehl.solve_ehl(LINE, refinements=0, max_iterations=1, **o),
        "strip": lambda **o: press(strip, heights, 100.0, max_iterations=1, **o),
        "sharing": lambda **o: sharing.share_load(FLAT, refinements=0, max_evaluations=1, guess=3.0, **o),
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
    kept = solve(raise_on_failure=False)
    kept = kept[-1] if isinstance(kept, list) else kept
    assert type(caught.value.result) is type(kept) and kept.report.status == "iteration_limit"
