"""What the paper leaves open about the film: which pressure deforms its gap."""

from __future__ import annotations

import numpy as np

import lubfric

from .draw import axes, png
from .page import PaperFigure
from .spread import spread

SCENES = {
    "cylinder": lubfric.load_scene("paper"),
    "flat strip, 500 MPa": lubfric.load_scene("flat").with_(
        bodies={"load": 132.3},
        contact={"shape": (256, 256)},
        lubricant={"eyring_stress": 5e6, "limiting_stress_coefficient": 0.05},
    ),
}
DEFLECTIONS = {"hydrodynamic": "own pressure (paper)", "scaled": "whole load, E' $F_H/F_T$ (Johnson)"}


def curve(name, deflection, speeds):
    """(coefficient, film load share) over speed."""
    scene = SCENES[name].with_(numerics={"film_deflection": deflection})
    found = lubfric.stribeck(scene, speeds)
    return found.coefficient, found.film_load / scene.bodies.load


def film_deflection(quick: bool) -> PaperFigure:
    """Friction and film load with the film deformed by its own pressure or by the whole load."""
    speeds = {
        "cylinder": np.geomspace(1e-3, 1, 5 if quick else 13),
        "flat strip, 500 MPa": np.geomspace(1e-3, 10, 5 if quick else 13),
    }
    cases = [(name, deflection, speeds[name]) for name in SCENES for deflection in DEFLECTIONS]
    found = dict(zip([c[:2] for c in cases], spread(curve, cases, quick)))
    canvas, grid = axes(2, 2, width=8.8, height=6.2, sharex="col")
    rows, most = [], {}
    for column, name in zip(grid.T, SCENES):
        for (key, label), style in zip(DEFLECTIONS.items(), ("o-", "s--")):
            f, share = found[name, key]
            column[0].semilogx(speeds[name], f, style, ms=4, label=label)
            column[1].loglog(speeds[name], share, style, ms=4, label=label)
            rows += [(name, key, float(u), float(a), float(b)) for u, a, b in zip(speeds[name], f, share)]
        f, share = (np.array(v) for v in zip(*(found[name, key] for key in DEFLECTIONS)))
        most[name] = (
            100 * np.max(np.abs(f[1] / f[0] - 1)),
            float(np.max(share[1] / share[0])),
            float(np.min(share[1] / share[0])),
        )
        column[0].set(title=name, ylabel="friction coefficient (-)", ylim=(0, None))
        column[1].set(xlabel="entrainment speed U (m/s)", ylabel="$F_H/F_T$ (-)")
    grid[0, 0].legend(fontsize=8)
    words = "; ".join(
        f"{name}: coefficient changed by at most {d:.1f} %, F_H by a factor of {low:.2f} to {high:.2f}"
        for name, (d, high, low) in most.items()
    )
    return PaperFigure(
        "film",
        "Option: which pressure deforms the film",
        f"{words}. In the paper's own light case (102 MPa) the choice hardly matters, which is why the "
        "paper can leave it open.",
        "The paper lets the film be deformed by its own pressure only. Johnson, Greenwood and Poon, and "
        "after them Gelinck and "
        "Schipper (2000, doi:10.1016/S0301-679X(00)00051-1), let the whole load deform it, by the modulus "
        "E' F_H/F_T at the load F_H: "
        "the deflection of the total pressure when both pressures have the same shape. At a high load and a "
        "small film share the two "
        "differ: the film's own pressure cannot flatten the gap, whose mean over the strip then is that of "
        "the undeformed parabola. "
        '`numerics.film_deflection = "scaled"`, off by default.',
        png(canvas),
        {"film": (("scene", "deflection", "speed [m/s]", "f [-]", "F_H/F_T [-]"), rows)},
    )
