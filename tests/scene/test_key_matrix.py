"""Every key of a scene reaches the number, in steady, sweep and transient: corners, undone one key at a time.

A corner is a scene with telling values of many keys. That each of them counts is seen by undoing it alone: f moves, or
the scene is refused. That its value counts as it should is an oracle of its own below, or a test elsewhere that is
named. That a sweep and a transient take all of them is seen by their answer to the corner being the steady one.

To add a key: put it into a corner (`CORNERS`), and write a test that shows its value by something that shares no code
with it: a closed form, a metamorphic relation, another solver.
"""

import dataclasses
import math
from functools import cache

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.estimate import inputs_to_quote
from lubfric.samples import contact_maps
from lubfric.scene import SECTIONS

NOT_NOTHING = 1e-3  # the same for keys of a map, which every way of asking takes from one place (`contact_maps`)
MOVES = 0.02  # least relative change of f by an undone key: twice the tolerance of a scene
BASE = lubfric.load_scene("flat").with_(
    lubricant={"viscosity_law": "barus", "pressure_viscosity_coefficient": 1e-8},
    motion={"entrainment_speed": 0.01, "speeds": ()},
    surface={"sq": 1e-7, "correlation_length": 8e-6, "acf": "gaussian"},
    contact={"shape": (48, 48), "spacing": 2e-6},
    numerics={"accept": True, "film_deflection": "hydrodynamic", "heat": "off", "tolerance": 0.01, "sampling": "patch"},
)
SPEED = BASE.motion.entrainment_speed


solved = cache(lubfric.friction)


@cache
def answer(scene, mode="steady"):
    """f of ``scene`` in one of the three ways to ask for it."""
    if mode == "steady":
        return solved(scene).coefficient
    if mode == "sweep":
        curve = lubfric.stribeck(scene, [2 * scene.motion.entrainment_speed, scene.motion.entrainment_speed])
        return float(curve.coefficient[1])
    plan = lubfric.Transient(1e-4, outputs=1)
    return float(lubfric.transient(scene.with_(transient=plan)).coefficient[-1])


def moved(corner, undone):
    """Relative change of f by what is undone; infinite where the scene is refused without it."""
    there = answer(corner)
    try:
        return abs(answer(undone()) / there - 1)
    except lubfric.InputError:
        return math.inf


# --- corners --------------------------------------------------------------------------------------

SIZES = BASE.with_(
    bodies={"radius": 3e-3, "width": 5e-3, "load": 7.0, "e_prime": 150e9, "boundary_friction_coefficient": 0.12},
    lubricant={"viscosity": 0.45, "pressure_viscosity_coefficient": 2.5e-8},
    motion={"entrainment_speed": 0.015, "slide_roll_ratio": -1.2},
    surface={"sq": 1.3e-7, "correlation_length": 6e-6, "acf": "exponential", "decay_level": 0.75, "seed": 6},
    contact={"spacing": 3e-6, "shape": (64, 64)},
)
LAWS = BASE.with_(
    bodies={"load": 200.0},
    lubricant={
        "viscosity": 0.1,
        "viscosity_law": "roelands",
        "pressure_viscosity_coefficient": 1.8e-8,
        "density_law": "dowson-higginson",
        "eyring_stress": 5e6,
    },
    motion={"entrainment_speed": 0.06, "slide_roll_ratio": 0.5},
)
LIMITS = LAWS.with_(
    lubricant={"eyring_stress": None, "limiting_stress_coefficient": 1e-3, "limiting_stress_offset": 2e5},
    motion={"entrainment_speed": 0.3, "slide_roll_ratio": 2.0},
    surface={"sq": 1e-8},
)
CYLINDER = paper_scene(
    bodies={"load": 40.0, "hardness": None, "width": 2e-3},
    motion={"entrainment_speed": 0.003, "speeds": ()},
    lubricant={"pressure_viscosity_coefficient": 1e-8},  # no pressure spike, whose shear a transient does not resolve
    surface={"sq": 1.5e-7, "correlation_length": 12e-6, "oversize": 2},
    contact={"region": "box", "shape": (64, 24), "spacing": (2e-6, 2.5e-6)},
    numerics={"accept": True, "film_deflection": "hydrodynamic", "heat": "off", "sampling": "patch"},
)
WARM = BASE.with_(
    bodies={"load": 3000.0, "radius": 1e-2, "width": 1e-2, "conductivity": (12.0, 12.0), "volumetric_heat": (2e6, 2e6)},
    lubricant={"viscosity_law": "roelands", "grade": "ISO VG 68", "viscosity_index": 95, "temperature": 330.0}
    | {"conductivity": 0.2, "eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
    motion={"entrainment_speed": 2.0, "slide_roll_ratio": 0.6},
    surface={"sq": 2e-7},
    numerics={"heat": "on"},
)
WARM_UNDONE = {  # key: what it is instead
    ("bodies", "conductivity"): (46.0, 46.0),
    ("bodies", "volumetric_heat"): (3.6e6, 3.6e6),
    ("lubricant", "conductivity"): 0.12,
    ("lubricant", "temperature"): 360.0,
    ("lubricant", "temperature_coefficient"): 0.02,
    ("lubricant", "oil"): "mineral-220",
    ("numerics", "heat"): "off",
}
ASPERITIES = BASE.with_(contact={"model": "summits", "asperity_separation": "mean-plane"})


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """A map that needs every key of a file: barrelled, in µm with decimal commas, holes as -99, a spike, long and short
    waves, its lay across; and another body's."""
    folder = tmp_path_factory.mktemp("maps")
    for name, seed in (("a.txt", 1), ("b.txt", 2)):
        rough = lubfric.generate_surface(
            (64, 36), 2e-6, sq=1e-7, correlation_length=(12e-6, 4e-6), acf="gaussian", seed=seed
        )
        x = np.linspace(-1, 1, 64)[:, None]
        waves = 1.5e-7 * np.sin(9 * x) + 6e-8 * np.random.default_rng(seed).standard_normal((64, 36))
        z = (rough.heights + waves + 2e-6 * x**2) * 1e6
        z[20, 11] += 6.0
        z[40:42, 20] = -99.0
        text = "\n".join(", ".join(f"{v:.6f}".replace(".", ",") for v in row) for row in z.tolist())
        (folder / name).write_text(text)
    return folder


FILE = {"spacing": (2e-6, 2.5e-6), "unit": "um", "decimal": ",", "missing_value": -99.0, "form": "quadratic"}
FILE |= {"outliers": "mask", "s_filter": 1.5e-5, "l_filter": 6e-5, "motion_axis": "y", "extension": "mirror"}
PLAIN = {"spacing": None, "unit": None, "decimal": None, "missing_value": None, "form": "plane", "outliers": "keep"}
PLAIN |= {"s_filter": None, "l_filter": None, "motion_axis": "x", "extension": "none"}


def file_corner(folder, section):
    """A cylinder under a measured map; the other body smooth, or the measured one the second."""
    wide = CYLINDER.with_(
        bodies={"load": 300.0, "radius": 8e-3}, contact={"region": "hertz", "shape": None, "spacing": None}
    )
    keys = {"file": str(folder / "a.txt"), **FILE}
    if section == "surface":
        return wide.with_(surface=keys)
    flat = {"sq": 0.0, "correlation_length": 1e-5, "oversize": 1}
    grid = {"shape": (96, 32), "spacing": 2.5e-6}
    return wide.with_(surface=flat, contact=grid, counterface=keys)


CORNERS = {  # a scene, and what is put in the place of each of its keys
    "sizes": (
        SIZES,
        {
            (section, key): getattr(getattr(BASE, section), key)
            for section, keys in {
                "bodies": ("radius", "width", "load", "e_prime", "boundary_friction_coefficient"),
                "lubricant": ("viscosity", "pressure_viscosity_coefficient"),
                "motion": ("entrainment_speed", "slide_roll_ratio"),
                "surface": ("sq", "correlation_length", "acf", "decay_level", "seed"),
                "contact": ("spacing", "shape"),
            }.items()
            for key in keys
        },
    ),
    "laws": (
        LAWS,
        {("lubricant", "viscosity_law"): "barus", ("lubricant", "density_law"): "constant"}
        | {("lubricant", "eyring_stress"): None},
    ),
    "limits": (
        LIMITS,
        {("lubricant", "limiting_stress_coefficient"): None, ("lubricant", "limiting_stress_offset"): 1e6},
    ),
    "cylinder": (
        CYLINDER,
        {("contact", "geometry"): "flat", ("contact", "region"): "hertz", ("surface", "oversize"): 3},
    ),
    "warm": (WARM, WARM_UNDONE),
    "asperities": (ASPERITIES, {("contact", "model"): "half-space", ("contact", "asperity_separation"): "volume"}),
}


@pytest.mark.parametrize("corner, key", [(c, k) for c, (_, keys) in CORNERS.items() for k in keys])
def test_each_key_of_a_corner_moves_the_number(corner, key):
    scene, undone = CORNERS[corner]
    section, name = key
    assert moved(scene, lambda: scene.with_(**{section: {name: undone[key]}})) > MOVES


# Keys that the inputs to quote do not state by themselves, or whose value a corner is refused without.
NOT_QUOTED = {("motion", "entrainment_speed"), ("contact", "geometry"), ("contact", "model")}


@pytest.mark.parametrize(
    "corner, key", [(c, k) for c, (_, keys) in CORNERS.items() for k in keys if k not in NOT_QUOTED]
)
def test_the_inputs_to_quote_state_each_key_of_a_corner(corner, key):
    """What moves f is in the paragraph, so that another can repeat the calculation."""
    scene, undone = CORNERS[corner]
    section, name = key
    stated = {*inputs_to_quote(scene, takes_boundary_film=False)}
    assert stated != {*inputs_to_quote(scene.with_(**{section: {name: undone[key]}}), takes_boundary_film=False)}


def test_the_inputs_to_quote_state_the_kind_of_contact():
    kinds = [{"geometry": "cylinder"}, {"geometry": "flat"}, {"model": "summits"}, {"model": "patches"}]
    assert len({inputs_to_quote(BASE.with_(contact=kind)) for kind in kinds}) == len(kinds)


@pytest.mark.parametrize("key", [key for key in FILE if key not in ("unit", "decimal", "missing_value")])
def test_the_inputs_to_quote_state_how_a_map_was_prepared(measured, key):
    scene = file_corner(measured, "surface")
    assert inputs_to_quote(scene) != inputs_to_quote(scene.with_(surface={key: PLAIN[key]}))


@pytest.mark.parametrize("model", ["paper", "deterministic"])
@pytest.mark.parametrize("inlet", [{"inlet_length": 1e-5}, {"inlet_film": 1.5e-7}])
def test_a_starved_inlet_reaches_the_number(model, inlet):
    """More of it gives the flooded number; films and flows are held against published laws in tests/film. A run in time
    takes inlet_length (tests/time/test_starved_in_time.py), and refuses inlet_film."""
    flooded = lubfric.load_scene("paper").with_(
        motion={"entrainment_speed": 0.1, "speeds": ()},
        surface={"sq": 2e-8, "correlation_length": 4e-6},
        contact={"shape": (32, 16), "spacing": 1.5e-6},
        numerics={"model": model, "sampling": "patch", "grid": "given", "tolerance": 0.03, "accept": True},
    )
    starved = flooded.with_(lubricant=inlet)
    assert moved(starved, lambda: flooded) > MOVES
    stated = [[e for e in solved(s).validity if "flooded inlet" in e.what] for s in (starved, flooded)]
    assert stated[0] and not stated[1]
    assert all(each.is_note for each in stated[0])  # what the scene gives is meant
    assert stated[0][0].recommendation.startswith(f"keep lubricant.{next(iter(inlet))}")
    assert answer(starved, "sweep") == pytest.approx(answer(starved), rel=0.6 * MOVES)
    enough = flooded.with_(lubricant={key: 3e3 * value for key, value in inlet.items()})
    assert answer(enough) == pytest.approx(answer(flooded), rel=2e-3)
    if "inlet_film" in inlet:
        with pytest.raises(lubfric.InputError, match="inlet"):
            starved.with_(transient=lubfric.Transient(1e-4))


def test_carreaus_law_reaches_the_number():
    """With an exponent near 1 it is Newtonian; a smaller one moves film and shear."""
    scene = LAWS.with_(lubricant={"eyring_stress": None}, surface={"sq": 1e-8}, bodies={"load": 50.0})
    thinned, nearly = (scene.with_(lubricant={"carreau": (2e6, n)}) for n in (0.6, 0.999))
    assert moved(thinned, lambda: scene) > MOVES
    assert answer(nearly) == pytest.approx(answer(scene), rel=0.01)


@pytest.mark.parametrize("mode", ["sweep", "transient"])
@pytest.mark.parametrize("corner", CORNERS)
def test_a_sweep_and_a_transient_take_every_key_of_a_corner(corner, mode):
    scene = CORNERS[corner][0]
    assert answer(scene, mode) == pytest.approx(answer(scene), rel=0.6 * MOVES)


@pytest.mark.parametrize("section", ["surface", "counterface"])
def test_each_key_of_a_measured_map_moves_the_map_and_so_the_number(measured, section):
    """Every way of asking takes its map from one place (`contact_maps`)."""
    corner = file_corner(measured, section)
    unfiltered = {"s_filter": None, "l_filter": None}
    beside = {"missing_value": {"outliers": "keep"}, **dict.fromkeys(("motion_axis", "form", "outliers"), unfiltered)}
    for key in FILE:  # holes told as numbers are outliers too, and filters leave little of form and lay
        scene = corner.with_(**{section: beside.get(key, {})})
        assert moved_map(scene, {section: {key: PLAIN[key]}}) > NOT_NOTHING, key
    assert moved_map(corner, {section: {"sq": 3e-7}}) > MOVES
    other = {section: {"file": str(measured / "b.txt")}}
    assert moved_map(corner, other) > MOVES and moved(corner, lambda: corner.with_(**other)) > MOVES
    for mode in ("sweep", "transient"):
        assert answer(corner, mode) == pytest.approx(answer(corner), rel=0.6 * MOVES)


def moved_map(scene, change):
    """Largest change of the heights over Sq by ``change``; infinite where the scene is refused or has another grid."""
    there = contact_maps(scene)[0]
    try:
        here = contact_maps(scene.with_(**change))[0]
    except lubfric.InputError:
        return math.inf
    if here.shape != there.shape or here.spacing != there.spacing:
        return math.inf
    return float(np.abs(here.heights - there.heights).max() / there.sq)


# --- oracles of the values ------------------------------------------------------------------------


def test_similar_contacts_have_one_coefficient():
    """Lengths times 2, pressures times 3: f stays (Barus has no pressure of its own)."""
    a = 2.0
    b = 3.0
    scaled = {
        "bodies": {"radius": a, "width": a, "load": a * a * b, "e_prime": b, "hardness": b},
        "lubricant": {
            "viscosity": a * b,
            "pressure_viscosity_coefficient": 1 / b,
            "eyring_stress": b,
            "limiting_stress_offset": b,
        },
        "surface": {"sq": a, "correlation_length": a},
        "contact": {"spacing": a},
    }
    scene = BASE.with_(
        bodies={"hardness": 2e9},
        lubricant={"eyring_stress": 1e6, "limiting_stress_coefficient": 0.04, "limiting_stress_offset": 2e6},
        motion={"entrainment_speed": 0.05},
    )
    similar = scene.with_(
        **{s: {k: getattr(getattr(scene, s), k) * factor for k, factor in keys.items()} for s, keys in scaled.items()}
    )
    assert answer(similar) == pytest.approx(answer(scene), rel=1e-3)
    one = solved(similar).contact_load / solved(scene).contact_load
    assert one == pytest.approx(a * a * b, rel=1e-3)


@pytest.mark.parametrize("mode", ["steady", "sweep", "transient"])
def test_only_the_product_of_speed_and_viscosity_counts(mode):
    twin = BASE.with_(lubricant={"viscosity": 2 * BASE.lubricant.viscosity}, motion={"entrainment_speed": SPEED / 2})
    assert answer(twin, mode) == pytest.approx(answer(BASE), rel=5e-3)


@pytest.mark.parametrize("mode", ["steady", "sweep", "transient"])
def test_boundary_friction_is_its_share_of_the_load(mode):
    more = BASE.bodies.boundary_friction_coefficient + 0.05
    share = solved(BASE).contact_load / BASE.bodies.load
    other = BASE.with_(bodies={"boundary_friction_coefficient": more})
    assert answer(other, mode) - answer(BASE, mode) == pytest.approx(0.05 * share, rel=0.01)


def test_couette_force_is_the_ratio_times_that_of_one():
    """Newtonian: linear in the slide-roll ratio, and along the sliding whichever way that is."""
    forces = [solved(BASE.with_(motion={"slide_roll_ratio": r})).couette_force for r in (0.5, 2.0, -2.0)]
    assert forces[1] == pytest.approx(4 * forces[0], rel=5e-3) and forces[2] == pytest.approx(forces[1], rel=5e-3)


def own_stress(oil, p, rate):
    """Shear stress by the laws as they are written, apart from `lubfric.oil.lubricant`."""
    if oil.viscosity_law == "barus":
        log = oil.pressure_viscosity_coefficient * p
    else:
        z = oil.pressure_viscosity_coefficient * 1.96e8 / (math.log(oil.viscosity) + 9.67)
        log = (math.log(oil.viscosity) + 9.67) * ((1 + p / 1.96e8) ** z - 1)
    tau = oil.viscosity * np.exp(log * (oil.viscosity_law != "constant")) * rate
    if oil.eyring_stress:
        tau = oil.eyring_stress * np.arcsinh(tau / oil.eyring_stress)
    if oil.limiting_stress_coefficient:
        tau = np.minimum(tau, oil.limiting_stress_offset + oil.limiting_stress_coefficient * p)
    return tau


FILM = BASE.with_(
    bodies={"load": 300.0},
    motion={"entrainment_speed": 0.3, "slide_roll_ratio": 0.2},
    lubricant={"viscosity": 0.08, "pressure_viscosity_coefficient": 1.5e-8},
    surface={"sq": 0.0},
    numerics={"tolerance": 2e-3},
)


FILM_IN_CONTACT = FILM.with_(surface={"sq": 1e-7}, motion={"entrainment_speed": 0.03}, numerics={"tolerance": 0.02})
NEWTONIAN = FILM.with_(
    bodies={"load": 1000.0},
    lubricant={"viscosity_law": "roelands", "pressure_viscosity_coefficient": 2e-8},
    surface={"sq": 2e-8},
    numerics={"accept": False, "tolerance": 0.05},
)


@pytest.mark.parametrize(
    "law",
    [
        {"viscosity_law": "roelands"},
        {"viscosity_law": "roelands", "eyring_stress": 4e6},
        {"limiting_stress_coefficient": 0.02, "limiting_stress_offset": 4e6},
        {"density_law": "dowson-higginson", "viscosity_law": "roelands"},
    ],
)
def test_shear_and_flow_of_a_film_obey_the_laws_requested(law):
    """Couette force by quadrature of the law; and the mass flow rho (U h - h³ p'/12 eta) the same everywhere."""
    scene = FILM.with_(lubricant=law)
    result = solved(scene)
    film = result.balance.film
    oil = scene.lubricant
    speed = scene.motion.entrainment_speed
    assert result.contact_load == 0
    x = film.x
    p = film.pressure
    h = film.film_thickness
    wet = x <= film.rupture
    tau = own_stress(oil, p, scene.motion.slide_roll_ratio * speed / h)[wet]
    inlet = oil.viscosity * scene.motion.slide_roll_ratio * speed * 2 * scene.bodies.radius / abs(x[0])
    force = scene.bodies.width * (np.trapezoid(tau, x[wet]) + inlet)
    assert result.couette_force == pytest.approx(force, rel=0.01)
    pm = (p[1:] + p[:-1]) / 2
    hm = (h[1:] + h[:-1]) / 2
    slope = np.diff(p) / np.diff(x)
    newtonian = dataclasses.replace(oil, eyring_stress=None, limiting_stress_coefficient=None)
    eta = own_stress(newtonian, pm, 1.0)
    rho = 1 + (0.6e-9 * pm / (1 + 1.7e-9 * pm) if oil.density_law != "constant" else 0 * pm)
    inside = (pm > 0.05 * p.max()) & (x[1:] < 0)  # the inlet, which sets the flow
    flow = (rho * (speed * hm - hm**3 * slope / (12 * eta)))[inside]
    centre = np.interp(0.0, x[1:], rho * speed * hm)
    assert np.median(flow) == pytest.approx(centre, rel=0.01) and np.ptp(flow) < 0.05 * centre


def test_flat_contact_is_the_periodic_contact_at_the_mean_pressure_of_the_strip():
    """Hardness and geometry: gap and area from a dry contact solved here, at F_C over the Hertz strip; the gap within
    its stated error, which is below two percent."""
    scene = BASE.with_(bodies={"hardness": 4e8})
    result = solved(scene)
    surface = contact_maps(scene)[0]
    pressure = result.contact_load / (2 * scene.bodies.half_width * scene.bodies.width)
    dry = lubfric.solve_contact(
        surface.heights.max() - surface.heights,
        surface.spacing,
        scene.bodies.e_prime,
        mean_pressure=pressure,
        hardness=scene.bodies.hardness,
    )
    assert result.errors.mean_gap < 2e-2
    assert result.mean_gap == pytest.approx(np.maximum(dry.gap, 0).mean(), rel=result.errors.mean_gap)
    assert result.real_contact_area_fraction == pytest.approx((dry.pressure > 0).mean(), rel=0.05)
    assert result.plastic_area_fraction == pytest.approx((dry.pressure >= 4e8 * (1 - 1e-9)).mean(), rel=0.1)
    elastic = solved(BASE)
    assert result.real_contact_area_fraction > 1.05 * elastic.real_contact_area_fraction


def test_a_measured_map_is_prepared_as_its_keys_say(measured):
    """The same steps by hand with NumPy: unit, holes, quadratic form; then turned, scaled to sq."""
    keys = {
        **PLAIN,
        "file": str(measured / "a.txt"),
        "spacing": 2e-6,
        "unit": "um",
        "decimal": ",",
        "missing_value": -99.0,
    }
    keys |= {"form": "quadratic", "motion_axis": "y", "sq": 3e-7}
    scene = BASE.with_(surface=keys, contact={"shape": None, "spacing": None})
    rows = (measured / "a.txt").read_text().splitlines()
    z = 1e-6 * np.array([[float(v.replace(",", ".")) for v in row.split(", ")] for row in rows])
    hole = np.abs(z + 99e-6) < 1e-9
    x, y = np.meshgrid(*(np.linspace(-1, 1, n) for n in z.shape), indexing="ij")
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
    fit = np.linalg.lstsq(terms[~hole], z[~hole], rcond=None)[0]
    rest = z - terms @ fit
    rest[hole] = np.nan
    result = contact_maps(scene)[0].heights[: z.shape[1], : z.shape[0]].T
    known = ~hole
    factor = np.polyfit(rest[known], result[known], 1)
    assert np.corrcoef(rest[known], result[known])[0, 1] > 1 - 1e-9
    assert factor[0] == pytest.approx(3e-7 / rest[known].std(), rel=1e-6)


def test_the_counterface_adds_its_square():
    two = BASE.with_(
        counterface={"sq": 2e-7, "correlation_length": 8e-6, "acf": "gaussian", "seed": 0}, surface={"seed": 0}
    )
    squares = [contact_maps(two.with_(surface={"seed": s}, counterface={"seed": s}))[0].sq ** 2 for s in range(24)]
    assert math.sqrt(np.mean(squares)) == pytest.approx(math.sqrt(1 + 4) * 1e-7, rel=0.04)
    smooth = BASE.with_(counterface={"sq": 0.0, "correlation_length": 8e-6})
    assert answer(smooth) == pytest.approx(answer(BASE), rel=1e-9)
    for mode in ("sweep", "transient"):
        assert answer(two, mode) == pytest.approx(answer(two), rel=0.6 * MOVES)


SOLVED_OTHERWISE = (
    [{"workers": 2}, {"model": "paper"}, {"grid": "given"}, {"film_tolerance": 1e-3}]
    + [{"contact_tolerance": 1e-6}, {"balance_tolerance": 1e-5}, {"tolerance": 1e-3}, {"heat": "auto"}]
    + [{"sampling": "strips"}, {"sampling_tolerance": 0.1}, {"accept": False}]
)
STEADY_ONLY = [  # a run in time refuses them by name
    {"model": "deterministic"},
    {"cavitated_shear": "striated"},
]


@pytest.mark.parametrize("mode", ["steady", "transient"])
@pytest.mark.parametrize("numerics", SOLVED_OTHERWISE, ids=str)
def test_how_it_is_solved_does_not_change_the_answer(numerics, mode):
    """Another method, more cells, tighter tolerances: within the tolerance of the scene."""
    scene = BASE.with_(numerics=numerics)
    if mode == "transient" and numerics in STEADY_ONLY:
        return
    assert answer(scene, mode) == pytest.approx(answer(BASE), rel=0.01)
    if mode == "steady":
        result = solved(scene)
        assert abs(result.volume_residual) <= 1.5 * numerics.get("balance_tolerance", 1e-3)


@pytest.mark.parametrize("mode", ["steady", "sweep", "transient"])
def test_tolerances_and_grid_reach_the_solvers(mode):
    """Tighter ones bring a residual or the number of cells where they ask for it; a looser tolerance on f costs
    cells."""
    cells = {}
    for film in (2e-2, 2e-3):
        scene = FILM_IN_CONTACT.with_(numerics={"film_tolerance": film})
        cells[film] = _cells(scene, mode)
    assert cells[2e-3] > cells[2e-2]
    tight = BASE.with_(numerics={"balance_tolerance": 1e-6, "contact_tolerance": 1e-7})
    assert abs(_volume(tight, mode)) <= 1.5e-6
    with pytest.raises(lubfric.ValidityError):
        _volume(NEWTONIAN, mode)
    assert np.isfinite(answer(NEWTONIAN.with_(numerics={"accept": True}), mode))


def _cells(scene, mode):
    if mode == "transient":
        return lubfric.transient(scene.with_(transient=lubfric.Transient(1e-5, outputs=1))).x.size
    return _point(scene, mode).balance.film.cells


def _volume(scene, mode):
    if mode == "transient":
        result = lubfric.transient(scene.with_(transient=lubfric.Transient(1e-5, outputs=1)))
        return float(result.volume_residual[-1])
    return _point(scene, mode).volume_residual


def _point(scene, mode):
    if mode == "steady":
        return solved(scene)
    return lubfric.stribeck(scene, [scene.motion.entrainment_speed], fields=True).points[0]


@pytest.mark.parametrize("numerics", STEADY_ONLY, ids=str)
def test_what_a_transient_does_not_do_it_refuses(numerics):
    plan = lubfric.Transient(1e-4, outputs=1)
    cylinder = "model" in numerics
    with pytest.raises(lubfric.InputError, match=f"numerics.{next(iter(numerics))}|{next(iter(numerics))} "):
        lubfric.transient((CYLINDER if cylinder else BASE).with_(numerics=numerics, transient=plan))


def test_a_line_and_its_tolerance_reach_the_sweep_and_the_run_in_time():
    """A looser tolerance on the line is met by a shorter one, in a sweep as at a point; a run in time has the pilot of
    the line, told with its standard error, and lies within three of them of the steady answer."""
    line = CYLINDER.with_(
        bodies={"load": 20.0},
        motion={"entrainment_speed": 0.05},
        numerics={"sampling": "strips", "sampling_tolerance": 0.2},
        contact={"region": "hertz"},
        surface={"oversize": 1},
    )
    point = solved(line)
    swept = lubfric.stribeck(line, [line.motion.entrainment_speed]).points[0]
    assert swept.coefficient == point.coefficient and point.uncertainty.sampling > 0
    tight = line.with_(numerics={"sampling_tolerance": point.uncertainty.sampling / 1.5})
    for longer in (solved(tight), lubfric.stribeck(tight, [tight.motion.entrainment_speed]).points[0]):
        assert longer.uncertainty.length > point.uncertainty.length
    run = lubfric.transient(line.with_(transient=lubfric.Transient(1e-4, outputs=1)))
    assert run.sampling_error[-1] > 0
    assert abs(run.coefficient[-1] / point.coefficient - 1) < 3 * run.sampling_error[-1] + 0.012


@pytest.mark.parametrize(
    "name, section, value",
    [("load", "bodies", 4.0), ("radius", "bodies", 1.5e-3), ("viscosity", "lubricant", 0.5), ("speed", "motion", 0.02)],
)
def test_histories_of_a_transient_are_the_values_of_a_steady_scene(name, section, value):
    """A history that is constant answers as the steady scene of that value (the area A is that of bodies.load)."""
    plan = lubfric.Transient(1e-4, outputs=1, **{name: value})
    result = float(lubfric.transient(BASE.with_(transient=plan)).coefficient[-1])
    key = "entrainment_speed" if name == "speed" else name
    steady = answer(BASE.with_(**{section: {key: value}}))
    if name in ("load", "radius"):  # another Hertz strip: the number moves the right way and by about as much
        assert (result - answer(BASE)) / (steady - answer(BASE)) == pytest.approx(1.0, abs=0.4)
    else:
        assert result == pytest.approx(steady, rel=0.01)


def test_the_boundary_film_is_the_gap_below_which_the_bodies_rub():
    """In every way to ask: by sums over the fields, which do not depend on it."""
    scene = paper_scene(
        motion={"entrainment_speed": 0.01, "speeds": ()},
        bodies={"boundary_film": 3e-8},
        contact={"shape": (24, 24), "spacing": 90e-6 / 24},
        numerics={"model": "deterministic", "grid": "given", "accept": True, "sampling": "patch"},
        lubricant={"limiting_stress_coefficient": 0.03},
    )
    result = solved(scene)
    fields = result.deterministic
    share = fields.pressure[fields.gap < 3e-8].sum() / fields.pressure.sum()
    carried = 1 - fields.inlet_load / fields.load
    assert result.contact_load == pytest.approx(scene.bodies.load * share * carried, rel=1e-4)
    assert answer(scene, "sweep") == result.coefficient
    other = scene.with_(bodies={"boundary_film": 6e-8})
    assert solved(other).coefficient == pytest.approx(fields.at_twice_film, rel=1e-6)
    with pytest.raises(lubfric.InputError, match="bodies.boundary_film.*30 nm"):
        scene.with_(bodies={"boundary_film": 30.0})


@pytest.mark.parametrize("mode", ["steady", pytest.param("sweep", marks=pytest.mark.slow)])
def test_the_friction_of_the_paper_is_not_the_calibrated_one(mode):
    """Friction is f_b F_C and the shear of the film in both; "paper" shears the smooth film of Eq. (9)."""
    scene = lubfric.load_scene("paper").with_(
        motion={"entrainment_speed": 0.05, "speeds": ()}, numerics={"sampling_tolerance": 0.3, "tolerance": 0.05}
    )
    load = scene.bodies.load
    answers = []
    for model in ("paper", "quick"):
        variant = scene.with_(numerics={"model": model})
        result = solved(variant)
        boundary = scene.bodies.boundary_friction_coefficient * result.contact_load
        answers.append(answer(variant, mode))
        assert answers[-1] * load == pytest.approx(boundary + result.shear_force, rel=1e-6)
    assert abs(answers[1] / answers[0] - 1) > MOVES


@pytest.mark.parametrize("mode", ["steady", "sweep", "transient"])
def test_a_stated_limit_of_f_b_leaves_f_and_narrows_what_is_not_known(mode):
    """Films of a Newtonian oil are limited to f_b p anyway: the statement changes no f, and takes the unknown limit out
    of the model-form uncertainty."""
    rough_gap = paper_scene(
        motion={"entrainment_speed": 0.01, "speeds": ()},
        contact={"shape": (24, 24), "spacing": 90e-6 / 24},
        numerics={"model": "deterministic", "grid": "given", "accept": True, "sampling": "patch"},
    )
    scene = BASE if mode == "transient" else rough_gap
    stated = scene.with_(lubricant={"limiting_stress_coefficient": "f_b"})
    assert answer(stated, mode) == answer(scene, mode)
    if mode == "transient":
        return
    uncertain, certain = (
        lubfric.stribeck(s, [0.01]).points[0] if mode == "sweep" else solved(s) for s in (scene, stated)
    )
    assert certain.uncertainty.by_limit == 0 < uncertain.uncertainty.by_limit
    assert certain.uncertainty.model < uncertain.uncertainty.model


# --- the list -------------------------------------------------------------------------------------

ELSEWHERE = {  # keys that no corner undoes; the tests above, or those named, show their values
    "bodies": {"hardness", "boundary_film", "boundary_friction_table"},  # the last: tests/scene/test_ranges.py
    "motion": {"speeds"},
    "contact": set(),
    "lubricant": {
        "inlet_length",
        "inlet_film",
        "shear_modulus",
    }  # the last: tests/film/test_elastic_shear.py; and, in tests/oil/test_shear_laws.py, the shear laws
    | {law.key for law in (*lubfric.oil.FLOW_LAWS, *lubfric.oil.LIMIT_LAWS)},
    "surface": {
        "file",
        *FILE,
        "sk",
        "spk",
        "svk",
        "honing_angle",
        "groove_width",
    },  # the last five: surface/test_honed.py
    "counterface": set(lubfric.Roughness.__dataclass_fields__),
    "numerics": {
        *("tolerance", "film_tolerance", "contact_tolerance", "balance_tolerance", "workers", "model", "grid"),
        *("cavitated_shear", "film_deflection"),  # tests/film/test_shear.py, tests/sharing/test_balance.py
        *("sampling", "sampling_tolerance", "model_tolerance"),  # tests/sampling
        "accept",  # tests/sharing/test_validity.py
        "max_work",  # tests/scene/test_max_work.py
    },
    "transient": set(lubfric.Transient.__dataclass_fields__),  # tests/time/test_transient_mixed.py, test_angle.py
}


def test_every_key_is_shown_to_count():
    """Fails when a key is added without a test; see the top of this file for what to add."""
    undone = {key for _, keys in CORNERS.values() for key in keys}
    for section, elsewhere in ELSEWHERE.items():
        keys = {(section, field.name) for field in dataclasses.fields(SECTIONS[section])}
        assert keys <= undone | {(section, key) for key in elsewhere}, section
