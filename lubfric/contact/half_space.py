"""The rough surface on half-spaces, where every point may carry load, under a cylinder: the semi-periodic contact of
the paper, Sec. 3.2."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import InputError
from ..scene import Bodies, Scene
from . import edges
from .half_space_grid import HalfSpaceGrid
from .hertz_strip import area_half_width, area_weight, centred_axis, check_strip, weighted_mean
from .operator import HalfSpace, half_space
from .rough_contract import ContactState
from .solve import solve_contact

BOUNDARY = ("free", "periodic")


@dataclass(frozen=True)
class HalfSpaceContact(HalfSpaceGrid):
    """A `HalfSpaceGrid` that is pressed: width [m] of the line; hardness [Pa] (None: elastic); tolerance: of
    `lubfric.solve_contact`."""

    width: float
    hardness: float | None
    tolerance: float

    def close(self, film, load, start=None, shape=None) -> ContactState:
        """The surface, loaded under the film's shape, by `lubfric.solve_contact`."""
        under, length = film if shape is None else shape, self.x.size * self.spacing[0]
        if load == 0:
            return self._first_touch(film, under)
        gap0 = under[:, None] - self.heights
        found = solve_contact(
            gap0,
            self.spacing,
            self.operator.e_prime,
            operator=self.operator,
            mean_pressure=load / (self.width * length),
            hardness=self.hardness,
            boundary=BOUNDARY,
            tolerance=self.tolerance,
            start=self.pressure_of(start),
        )
        return self._state(film, found.gap, found)

    def carry(self, film, start=None, shape=None) -> tuple[float, ContactState]:
        """Load under the imposed film, by the single loop (paper, Appendix 2)."""
        under = film if shape is None else shape + weighted_mean(film - shape, self.weight)
        from ..paper import single_loop

        found = single_loop(
            self.heights,
            under,
            self.spacing,
            self.operator.e_prime,
            weight=self.weight,
            hardness=self.hardness,
            boundary=BOUNDARY,
            tolerance=self.tolerance,
            start=self.pressure_of(start),
            operator=self.operator,
        )
        load = found.mean_pressure * self.width * self.x.size * self.spacing[0]
        return load, self._state(film, found.gap, found if load > 0 else None)

    @property
    def name(self) -> str:
        return "semi-periodic"

    @property
    def adjustable_tolerance(self) -> float:
        return self.tolerance

    def tightened(self, tolerance: float) -> HalfSpaceContact:
        return replace(self, tolerance=tolerance)

    def foretell(self, bodies: Bodies, film: float) -> None:
        """By a dry contact, unless a closed form rules it out (`lubfric.contact.edges`)."""
        line_load = bodies.load / bodies.width
        if film > edges.FILM * self.sq or self._given_way(bodies):
            return
        if not edges.within_reach(self.x, self.sq, line_load, bodies.radius, bodies.e_prime):
            return
        dry = self.tightened(edges.TOLERANCE).close(self.x**2 / (2 * bodies.radius), bodies.load)
        share = self.on_the_ends(dry)
        if edges.clear(share, film / max(self.sq, 1e-300)):
            raise InputError(
                f"contact.shape: {100 * share:.2g} % of the load of a dry contact sits on the edge columns of a patch "
                f"{self.x.size * self.spacing[0]:.3g} m long (foretold, no film was solved); "
                f"allowed: at most {100 * edges.ALLOWED:g} % ({edges.LONGER})"
            )

    def _given_way(self, bodies: Bodies) -> bool:
        """Whether the whole patch at its hardness carries less than the load. Then there is no dry contact to look
        at."""
        length = self.x.size * self.spacing[0]
        return self.hardness is not None and self.hardness * length * self.width <= bodies.load

    def on_the_ends(self, state: ContactState) -> float:
        if state.pressure is None or self.x.size <= 2:
            return 0.0
        cell, step = state.x[1] - state.x[0], self.spacing[0]
        ends = [i for i in (0, -1) if abs(abs(state.x[i] - self.x[i]) - 0.5 * (cell - step)) < 0.25 * step]
        return step / cell * float(sum(state.pressure[i].sum() for i in ends) / state.pressure.sum())

    def again(self, scene: Scene, old: Scene) -> HalfSpaceContact:
        """The contact for another scene, with the same operator."""
        check_strip(scene, self.spacing[0], self.x.size * self.spacing[0])
        return half_space_contact(scene, self.heights, self.spacing, self.operator)

    def _first_touch(self, film, under) -> ContactState:
        """Without load: the gap is open everywhere, and zero at one cell."""
        mean, highest = self.profiles
        nothing = np.zeros(self.x.size)
        return ContactState(
            mean_gap=weighted_mean(under - mean, self.weight) - float((under - highest).min()),
            mean_film=weighted_mean(film, self.weight),
            x=self.x,
            contact_fraction=nothing,
            real_contact_area_fraction=0.0,
            plastic_area_fraction=0.0,
            y=np.arange(self.heights.shape[1]) * self.spacing[1],
        )

    def _state(self, film, gap, found) -> ContactState:
        touching = np.zeros(gap.shape, bool) if found is None else found.pressure > 0
        fraction = touching.mean(axis=1)
        plastic = 0.0
        if found is not None and self.hardness is not None:
            plastic = weighted_mean((found.pressure >= self.hardness).mean(axis=1), self.weight)
        return ContactState(
            mean_gap=weighted_mean(np.maximum(gap, 0.0).mean(axis=1), self.weight),
            mean_film=weighted_mean(film, self.weight),
            x=self.x,
            contact_fraction=fraction,
            real_contact_area_fraction=weighted_mean(fraction, self.weight),
            plastic_area_fraction=plastic,
            fields=found,
            pressure=None if found is None else found.pressure,
            y=np.arange(self.heights.shape[1]) * self.spacing[1],
        )


def half_space_contact(
    scene: Scene, heights, spacing, operator: HalfSpace | None = None, x: np.ndarray | None = None
) -> HalfSpaceContact:
    """The contact of ``scene`` on ``heights`` [m] (nx, ny) about their mean; ``operator``: made before for this grid;
    ``x`` [m] (nx,): cell centres (None: evenly about the line of contact)."""
    bodies, numerics = scene.bodies, scene.numerics
    x = centred_axis(heights.shape[0], spacing[0]) if x is None else x
    weight = area_weight(scene, x, spacing[0])
    if operator is None:
        operator = half_space(heights.shape, spacing, bodies.e_prime, BOUNDARY, workers=numerics.workers)
    return HalfSpaceContact(
        heights=heights,
        spacing=spacing,
        x=x,
        weight=weight,
        half_width=area_half_width(scene),
        operator=operator,
        width=bodies.width,
        hardness=bodies.hardness,
        tolerance=numerics.tolerances.contact,
    )
