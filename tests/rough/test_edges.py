"""A patch too short for its contact is refused before anything is solved; one that is long enough never."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.contact.edges import ALLOWED, clear, within_reach

BASE = lubfric.load_scene("paper").with_(
    bodies={"load": 40.0, "hardness": None, "width": 2e-3},
    motion={"entrainment_speed": 1e-3, "speeds": ()},
    surface={"sq": 2e-7, "correlation_length": 6e-6, "acf": "gaussian"},
    contact={"shape": (64, 64), "spacing": 2e-6},
    lubricant={"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
    numerics={"sampling": "patch"},
)


def patch(cells):
    return BASE.with_(contact={"shape": (cells, 64)})


BLIND = "lubfric.contact.half_space.HalfSpaceContact.foretell"


@pytest.mark.parametrize("hardness", [None, 2.5e9])
def test_a_short_patch_is_refused_before_any_film_or_balance(monkeypatch, hardness):
    """One dry contact, loosely solved, is all that is done; what it says leads to a patch that is accepted."""
    half, solves = BASE.bodies.half_width, []
    short = lubfric.prepare(patch(int(2.04 * half / 2e-6) + 1).with_(bodies={"hardness": hardness}))
    solve = lubfric.contact.half_space.solve_contact
    for module in ("lubfric.film.imposed.line_pressure", "lubfric.film.rigid._film"):
        monkeypatch.setattr(module, lambda *a, **k: 1 / 0)
    monkeypatch.setattr(
        "lubfric.contact.half_space.solve_contact", lambda *a, **k: solves.append(k["tolerance"]) or solve(*a, **k)
    )
    with pytest.raises(lubfric.InputError, match="(?s)foretold, no film was solved.*longer in x: contact.shape"):
        lubfric.friction(short)
    assert solves == [1e-2]


def test_what_is_foretold_is_found_where_it_is_solved(monkeypatch):
    """Random patches that end near their contact, elastic and with a hardness: what is foretold fails by the solve too,
    and most of what fails is foretold."""
    refused = {seed: message for seed in range(16) if (message := _fails(random_patch(seed)))}
    foretold = [seed for seed, message in refused.items() if "foretold" in message]
    assert 5 <= len(refused) <= 12 and len(foretold) >= 0.8 * len(refused)
    monkeypatch.setattr(BLIND, lambda self, bodies, film: None)
    assert all(_fails(random_patch(seed)) for seed in foretold)


def random_patch(seed):
    rng = np.random.default_rng([5, seed])
    load = float(np.exp(rng.uniform(np.log(20.0), np.log(500.0))))
    scene = BASE.with_(
        bodies={"load": load},
        numerics={"tolerance": 0.05, "film_deflection": "hydrodynamic"},
        motion={"entrainment_speed": float(np.exp(rng.uniform(np.log(1e-4), np.log(0.03)))), "speeds": ()},
    )
    if rng.random() < 0.5:
        scene = scene.with_(bodies={"hardness": max(rng.uniform(1e9, 4e9), 1.4 * scene.bodies.mean_hertz_pressure)})
    cells = int(rng.choice((28, 36, 48)))
    step = 2 * scene.bodies.half_width * rng.uniform(1.03, 1.5) / cells
    return scene.with_(
        surface={"sq": min(rng.uniform(1e-7, 6e-7), 0.05 * step), "correlation_length": 3 * step, "seed": seed},
        contact={"shape": (cells, 48), "spacing": step},
    )


def _fails(scene):
    try:
        lubfric.friction(scene)
    except (lubfric.InputError, lubfric.ValidityError) as error:
        assert "edge columns" in str(error)
        assert isinstance(error, lubfric.InputError) == ("foretold" in str(error))
        return str(error)
    return ""


def test_the_share_on_the_ends_does_not_depend_on_the_cells_that_were_enough():
    """Every pressure spread evenly: the edge columns of the map's own cells carry two of them, however coarse the
    contact was solved."""
    contact = lubfric.prepare(patch(64)).contact
    for there in (contact, contact.coarsened()):
        state = there.close(there.x**2 / (2 * BASE.bodies.radius), 1.0)
        even = replace(state, pressure=np.ones(there.heights.shape))
        assert contact.on_the_ends(even) == pytest.approx(2 / 64, rel=1e-12)
    part = contact.between(float(contact.x[8]), float(contact.x[40]))
    assert contact.on_the_ends(replace(part.close(0.0 * part.x, 1.0), pressure=np.ones(part.heights.shape))) == 0


def test_a_gap_that_rises_fast_rules_it_out():
    """Half a half-width beyond the strip the gap is a third of b²/R: far for a smooth surface, near for a rough
    one."""
    radius, e_prime, load = 8e-3, 231e9, 2e5
    half = np.sqrt(8 * load * radius / (np.pi * e_prime))
    x = np.linspace(-1.5, 1.5, 60) * half
    near, far = 0.4 * half**2 / radius, 0.02 * half**2 / radius
    assert within_reach(x, near, load, radius, e_prime) and not within_reach(x, far, load, radius, e_prime)
    assert within_reach(0.6 * x, far, load, radius, e_prime) and not within_reach(x[:2], near, load, radius, e_prime)
    assert clear(1.01 * ALLOWED, 0.0) and not clear(1.9 * ALLOWED, 1.0) and clear(2.1 * ALLOWED, 1.0)


UNFORETOLD = 38  # of `random_patch`: the ends are reached under a film, which no dry contact tells


def test_what_only_the_solve_can_tell_is_refused_with_its_result_or_kept_and_marked():
    """Not an error of input, which comes before any work: the whole result goes with it, and the share on the ends is
    that of its pressures."""
    scene = random_patch(UNFORETOLD)
    apart = f"{scene.contact.shape[0] * scene.contact.spacing:.3g} m apart"
    assert scene.contact.shape[0] != scene.contact.shape[1]
    with pytest.raises(lubfric.ValidityError, match=f"edge columns.*{apart}.*longer in x: contact.shape") as refused:
        lubfric.friction(scene)
    kept = lubfric.friction(scene.with_(numerics={"accept": True}), fields=True)
    pressure = kept.pressure
    share = (pressure[0].sum() + pressure[-1].sum()) / pressure.sum()
    (entry,) = [entry for entry in kept.validity if entry.severe]
    assert entry.value == pytest.approx(100 * share, rel=1e-9) and entry.value > 100 * ALLOWED
    assert refused.value.result.coefficient == pytest.approx(kept.coefficient, rel=0.1)
    curve = lubfric.stribeck(scene, [abs(scene.motion.entrainment_speed), 30.0], raise_on_failure=False)
    assert isinstance(curve.errors[0], lubfric.ValidityError) and curve.points[1] is not None


def test_a_line_and_a_run_in_time_tell_the_ends_too(tmp_path):
    """A line of a map that is long along y only, and every output of a run."""
    scene = random_patch(UNFORETOLD)
    (nx, ny), step = scene.contact.shape, scene.contact.spacing
    rough = scene.surface
    long = lubfric.generate_surface(
        (nx, 32 * ny), step, sq=rough.sq, correlation_length=rough.correlation_length, acf="gaussian", seed=1
    )
    np.save(tmp_path / "map.npy", long.heights)
    line = scene.with_(numerics={"sampling": "line", "sampling_tolerance": 0.5})
    line = line.with_(surface={"file": str(tmp_path / "map.npy"), "spacing": step}, contact={"shape": None})
    with pytest.raises(lubfric.ValidityError, match="edge columns") as refused:
        lubfric.friction(line)
    assert refused.value.result.line is not None
    in_time = scene.with_(transient=lubfric.Transient(duration=3e-3))
    with pytest.raises(lubfric.ValidityError, match="edge columns") as refused:
        lubfric.transient(in_time)
    run = refused.value.result
    assert run.columns["edge_load"].max() > ALLOWED and all(any(e.severe for e in found) for found in run.entries)
    apart = f"{nx * step:.3g} m apart"
    assert all(apart in entry.text for found in run.entries for entry in found if entry.severe)
    told = [[entry.value for entry in found if "edge columns" in entry.what] for found in run.entries]
    assert told == [[pytest.approx(100 * share)] for share in run.columns["edge_load"]]
