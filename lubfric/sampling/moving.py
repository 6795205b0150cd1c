"""Points whose roughness moves through the film: its maps, and what the deterministic model would cost there."""

from __future__ import annotations

from dataclasses import replace

from ..contact import Strips
from ..deterministic import RoughBody, Strip, moving_work, solve_moving_strip, solve_strip
from ..scene import moves, moving_bodies
from ..sharing import Prepared, on_strip
from ..surface import Surface

MOST_WORK = 120.0  # s, counted: beyond it "auto" leaves moving roughness to Eq. (8)


def solved_strip(prepared: Prepared, index: int, speed: float, **how) -> Strip:
    """Strip ``index`` by the deterministic model, its roughness at rest or moving; ``how``: as in `solve_strip`."""
    if moves(prepared.scene):
        return solve_moving_strip(prepared.scene, bodies_of(prepared, index, speed), speed, **how)
    return solve_strip(prepared.scene, strip_surface(prepared, index), speed, **how)


def strip_surface(prepared: Prepared, index: int) -> Surface:
    """The map of strip ``index``."""
    assert prepared.strips is not None
    contact = on_strip(prepared, prepared.strips, index)
    return replace(prepared.surface, heights=contact.heights, spacing=contact.spacing, mask=None)


def bodies_of(prepared: Prepared, index: int, speed: float) -> list[RoughBody]:
    """The rough bodies of strip ``index``. In pure rolling two are one, and a map that was given is all: surface 1."""
    found, strips = moving_bodies(prepared.scene), prepared.strips
    assert strips is not None
    if len(found) == 1 or prepared.given or found[0][1] == found[1][1]:
        name, ratio = found[0]
        return [RoughBody(strip_surface(prepared, index), abs(speed) * ratio, name == "counterface")]
    return [
        RoughBody(_alone(strips, name).strip(index), abs(speed) * ratio, name == "counterface") for name, ratio in found
    ]


def _alone(strips: Strips, name: str) -> Strips:
    """The ``strips`` of one of two rough bodies."""
    other = "counterface" if name == "surface" else "surface"
    smooth = replace(getattr(strips.scene, other), sq=0.0)
    return replace(strips, scene=replace(strips.scene, **{other: smooth}))


def too_costly(prepared: Prepared, speed: float, factors: tuple[int, int]) -> str:
    """Why moving roughness is left to Eq. (8) under "auto", in words; "" if it is not."""
    if not moves(prepared.scene):
        return ""
    work = moving_work(prepared.scene, bodies_of(prepared, 0, speed), speed, factors)
    if work <= MOST_WORK:
        return ""
    return (
        "Eq. (8) alone: the roughness moves, and one strip with one gap and one pressure would take about "
        f"{work:.0f} s of processor time, more than {MOST_WORK:g} s; numerics.model = 'deterministic' asks for it"
    )
