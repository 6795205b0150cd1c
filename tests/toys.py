"""A rough contact made outside of lubfric, whose gap is known in closed form."""

from dataclasses import dataclass, field

import numpy as np

from lubfric.contact import ContactState, RoughContact


@dataclass(frozen=True)
class Spring(RoughContact):
    """gap = touching - sigma (F_C/stiffness)^(2/3) [m]; it touches nowhere in particular."""

    touching: float
    sigma: float
    stiffness: float
    x: np.ndarray = field(default_factory=lambda: np.linspace(-1e-6, 1e-6, 3))
    weight: np.ndarray = field(default_factory=lambda: np.ones(3))

    @property
    def name(self):
        return "a spring"

    def close(self, film, load, start=None, shape=None):
        return self.state(film, self.gap(load))

    def gap(self, load):
        return self.touching - min(self.sigma * (load / self.stiffness) ** (2 / 3), 0.999 * self.touching)

    def state(self, film, gap):
        return ContactState(
            mean_gap=gap,
            mean_film=float(np.mean(film)),
            x=self.x,
            contact_fraction=np.zeros(3),
            real_contact_area_fraction=0.0,
            plastic_area_fraction=0.0,
        )


@dataclass(frozen=True)
class YieldingSpring(Spring):
    """A spring whose gap falls by ``drop`` [m] where its load exceeds ``limit`` [N], as where a single cell yields
    until another one touches: gaps between have that load."""

    limit: float = 0.0
    drop: float = 0.0

    def gap(self, load):
        return super().gap(load) - self.drop * (load > self.limit)
