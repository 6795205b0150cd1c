"""What the paper leaves open about the film: which pressure deforms its gap."""

from __future__ import annotations

import numpy as np

import lubfric

from ..check import AT_MOST, Check
from ..kept import Run
from ..plotting import axes
from .page import PaperFigure

OIL = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.05}
PATCH = {"sampling": "patch"}  # the paper's own
SCENES = {
    "cylinder": lubfric.load_scene("paper").with_(numerics=PATCH),
    "flat strip, 500 MPa": lubfric.load_scene("flat").with_(
        bodies={"load": 132.3}, contact={"shape": (256, 256)}, lubricant=OIL
    ),
    "cylinder, 1 GPa": lubfric.load_scene("paper").with_(
        numerics=PATCH,
        bodies={"load": 550.0, "hardness": None},
        contact={"spacing": 1.2e-6, "shape": (320, 160)},
        lubricant=OIL,
    ),
}
SPEEDS = {"cylinder": (1e-3, 1), "flat strip, 500 MPa": (1e-3, 10), "cylinder, 1 GPa": (1e-5, 1)}
DEFLECTIONS = {
    "hydrodynamic": "own pressure (paper)",
    "scaled": "whole load, E' $F_H/F_T$ (Johnson)",
}


def curve(case) -> tuple[list[float], list[float]]:
    """(coefficient, film load share) of a scene with a deflection over speed."""
    name, deflection, speeds = case
    scene = SCENES[name].with_(numerics={"film_deflection": deflection, "accept": True})  # also beyond the oil laws
    found = lubfric.stribeck(scene, speeds)
    return found.coefficient.tolist(), (found.film_load / scene.bodies.load).tolist()


def film_deflection(quick: bool, run: Run) -> PaperFigure:
    """Friction and film load with the film deformed by its own pressure or by the whole load."""
    speeds = {name: np.geomspace(*ends, 4 if quick else 13) for name, ends in SPEEDS.items()}
    cases = {f"{name}, {key}": (name, key, speeds[name]) for name in SCENES for key in DEFLECTIONS}
    found = {case[:2]: np.array(row, dtype=float) for case, row in run.solved(cases, curve)}
    canvas, grid = axes(2, 3, width=12.5, height=6.2, sharex="col")
    rows, most = [], {}
    for column, name in zip(grid.T, SCENES):
        for (key, label), style in zip(DEFLECTIONS.items(), ("o-", "s--")):
            f, share = found[name, key]
            column[0].semilogx(speeds[name], f, style, ms=4, label=label)
            column[1].loglog(speeds[name], share, style, ms=4, label=label)
            rows += [(name, key, float(u), float(a), float(b)) for u, a, b in zip(speeds[name], f, share)]
        f, share = np.array([found[name, key] for key in DEFLECTIONS]).swapaxes(0, 1)
        changes, ratios = 100 * np.abs(f[1:] / f[0] - 1).max(axis=1), share[1:] / share[0]
        most[name] = list(zip(changes, ratios.min(axis=1), ratios.max(axis=1)))
        column[0].set(title=name, ylabel="friction coefficient (-)", ylim=(0, None))
        column[1].set(xlabel="entrainment speed U (m/s)", ylabel="$F_H/F_T$ (-)")
    grid[0, 0].legend(fontsize=8)
    words = "\n".join(
        f"- {name}: f changes by at most {one[0]:.1f} % (Johnson) and {two[0]:.1f} % (both pressures), F_H by a "
        f"factor of {one[1]:.3g} to {one[2]:.3g} and {two[1]:.3g} to {two[2]:.3g}."
        for name, (one, two) in most.items()
    )
    return PaperFigure(
        "film",
        "Option: which pressure deforms the film",
        "In the paper's own light case (102 MPa) the choice hardly matters, which is why the paper can leave it open."
        f"\n\n{words}",
        "In the paper only the film's own pressure deforms the film. Johnson, Greenwood and Poon, and after them "
        "Gelinck and Schipper (Tribol. Int. 33 (2000) 175-181), let the whole load deform it, by the modulus "
        "E' F_H/F_T at the load F_H. That is the deflection of the total pressure when both pressures have the same "
        'shape. `"total"` takes the contact\'s pressure as it is found (its semi-ellipse), so the two pressures need '
        "not have one shape.\n\nAt a high load and a small film share, the film's own pressure cannot flatten the "
        "gap. The mean over the strip then is that of the undeformed parabola, and the friction does not tend to that "
        "of the boundary. Under both other options it does. The flat strip has no contact pressure along x of its "
        "own. The key is `numerics.film_deflection`.",
        canvas,
        {"film": (("scene", "deflection", "speed [m/s]", "f [-]", "F_H/F_T [-]"), rows)},
        (
            Check(
                "f of the paper's light cylinder by another deflection: largest change",
                max(change[0] for change in most["cylinder"]) / 100,
                0.02,
                0.0,
                "little load, little deflection",
                AT_MOST,
            ),
        ),
    )
