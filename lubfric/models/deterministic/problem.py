"""The problem: two bodies, the gap and the pressure between them, their roughness at rest (in time: `moving`).

On a grid of cells (nx, ny), x along the motion, periodic along y:

    h = h0 + x²/(2R) - z + K p + w        gap; z heights of the rough body, w >= 0 its plastic dent
    div( U rho θ h - rho h³/(12 eta) grad p ) = 0    mass; θ = 1 where fluid fills the gap
    p >= 0, θ <= 1, p (1 - θ) = 0          rupture and refilling that keep the mass (Jakobsson-Floberg-Olsson)
    h = floor                              where the bodies touch; p there is the total pressure
    p <= P_u, w >= 0, (P_u - p) w = 0      plastic limit, of film and contact alike
    ∫ p dx dy = load

``floor`` (1 nm) is the gap of touching surfaces. Film and contact are not added: there is one pressure.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ...contact import BOUNDARY, HalfSpace, half_space
from ...errors import InputError, TooManyCellsError
from ...film import HasLineContact, LineContact, line_peak_pressure
from ...oil import Lubricant
from ...scene import BOUNDARY_FILM
from ...surface import Surface
from ..shared import Memo, OperatorKey

FLOOR = 1e-9  # m: gap of touching cells, some molecules: a choice (`error_by_gap` has what it changes)

# The effects of half and twice the lengths of the grid are those on three points of the scene "paper" (`python -m
# verification.campaigns.constants lubfric.models.deterministic.problem`).

# Undeformed gap at the inlet end of the grid [Sq], at least. Half this value changes f by .5 %; twice by .2 %, for 42 %
# more time.
ROUGH_INLET = 14.0

# Undeformed gap at the outlet end of the grid [Sq], at least. Half and twice this value change f by .03 % at most.
ROUGH_OUTLET = 5.0

# Hertz half-widths from the middle to the inlet end [-], at least. Half and twice this value change nothing there.
HERTZ_INLET = 3.0

# Hertz half-widths to the outlet end [-], at least. Half and twice this value change nothing.
HERTZ_OUTLET = 1.8

# sqrt(2 R h) of the smooth film from the middle to the inlet end [-], at least. Half this value changes nothing, twice
# this value changes f by .04 %.
FILM_INLET = 1.5

# sqrt(2 R h) to the outlet end [-], at least. Half and twice this value change nothing.
FILM_OUTLET = 0.8

# Pressure-viscosity coefficient times Hertz pressure below which pressure thickens the lubricant little: no strip above
# 0.7 took long by Newton's method alone, and one of 0.7 did at 19 GPa.
ISOVISCOUS = 1.0

MOST_GRID_CELLS = 2**20  # cells; at most: a choice, for memory


@dataclass(frozen=True, kw_only=True)
class Problem(HasLineContact):
    """One operating point on its grid, plain values in SI units.

    Friction is the force on surface 2, the upper one, against its sliding u2 - u1, or against U where nothing slides:
    its shear stress, and the pressure on the flanks of its own roughness. The force on surface 1 is the opposite, but
    for the rolling resistance ∫ p x/R dx, the moment of the load about the middle.

    Attributes
    ----------
    line : load, bodies, lubricant, and the speed U > 0 along +x
    sliding : difference of the surface speeds, Δu >= 0 [m/s]
    x : centres of the cells around the line of contact [m] (nx,)
    heights : z of both bodies, out of them [m] (nx, ny)
    operator : K of that grid, free along x and periodic along y
    boundary_friction : f_b [-]
    hardness : P_u [Pa]; infinite: elastic
    boundary_film : gap below which the shear stress is f_b p [m]
    floor : gap of touching surfaces [m]
    sense : 1, or -1 where u2 < u1
    upper : z2, the roughness of surface 2, a part of z [m] (nx, ny); None: it is smooth
    least_flow : what the residuals of the mass are relative to, where less flows in [m²/s]: in time, where U may be 0
    sheared : the lubricant whose stress is the friction, where that of ``line`` flows with the viscosity of a warmer
        inlet; None: they are one
    memo : what is remembered of other problems of the same bodies: their operators and dry contacts; it changes no
        result
    """

    line: LineContact
    sliding: float
    x: np.ndarray
    heights: np.ndarray
    operator: HalfSpace
    boundary_friction: float
    hardness: float = math.inf
    boundary_film: float = BOUNDARY_FILM
    floor: float = FLOOR
    sense: float = 1.0
    upper: np.ndarray | None = None
    least_flow: float = 0.0
    sheared: Lubricant | None = None
    memo: Memo = field(default_factory=Memo, compare=False, repr=False)

    @property
    def spacing(self) -> tuple[float, float]:
        """(dx, dy) [m]."""
        return self.operator.spacing

    @property
    def speed(self) -> float:
        """U [m/s]."""
        return self.line.entrainment_speed

    @property
    def lubricant(self) -> Lubricant:
        """The lubricant of the contact."""
        return self.line.lubricant

    @cached_property
    def rigid_gap(self) -> np.ndarray:
        """x²/(2R) - z [m] (nx, ny)."""
        return (self.x**2 / (2 * self.radius))[:, None] - self.heights

    @property
    def self_deflection(self) -> float:
        """Deflection of a cell by its own pressure [m/Pa]: the diagonal of K."""
        return self.operator.self_deflection

    @property
    def edge_log(self) -> float:
        """4 w/(pi E') [m]: far upstream the gap is less than the parabola by this times ln|x|."""
        return 4 * self.load / (math.pi * self.e_prime)

    def at_load(self, load: float) -> Problem:
        """Return the problem on the same grid under another load [N/m]."""
        return replace(self, line=replace(self.line, load_per_width=load))

    def at_speed(self, speed: float) -> Problem:
        """Return the problem on the same grid at another U [m/s], with the same ratio of sliding."""
        faster = replace(self.line, entrainment_speed=speed)
        return replace(self, line=faster, sliding=self.sliding * speed / self.speed)


def are_soft(line: LineContact, sq: float) -> bool:
    """Return whether pressure thickens the lubricant little (`ISOVISCOUS`), and the bodies of ``line`` flatten by more
    than their roughness of ``sq`` [m]."""
    peak = line_peak_pressure(line.load_per_width, line.radius, line.e_prime)
    thickened = line.lubricant.pressure_viscosity_coefficient * peak
    return thickened < ISOVISCOUS and sq < line.half_width**2 / (2 * line.radius)


def reach(
    line: LineContact, sq: float, *, inlet: float = HERTZ_INLET, outlet: float = HERTZ_OUTLET
) -> tuple[float, float]:
    """Return the lengths [m] of the grid upstream and downstream of the line of contact.

    The grid ends where the roughness is small compared with the gap (its effect on the flow, 6 (Sq/h)², is below some 3
    %) and where there is no pressure. Upstream of the grid the film continues in closed form. ``inlet``, ``outlet``:
    the lengths, at least, in Hertz half-widths.
    """
    radius = line.radius
    b = line.half_width
    film = min(line.moes_film, line.rigid_film) if line.L == 0 else line.moes_film
    thick = math.sqrt(2 * radius * film)
    rough_in, rough_out = (math.sqrt(2 * radius * n * sq) for n in (ROUGH_INLET, ROUGH_OUTLET))
    return max(rough_in, inlet * b, FILM_INLET * thick), max(rough_out, outlet * b, FILM_OUTLET * thick)


def lay_out(
    surface: Surface,
    line: LineContact,
    *,
    sliding: float,
    boundary_friction: float,
    hardness: float | None = None,
    boundary_film: float = BOUNDARY_FILM,
    ends: tuple[float, float] | None = None,
    map_coarsening: tuple[int, int] = (1, 1),
    memo: Memo | None = None,
) -> Problem:
    """Return the `Problem` of ``surface``, its middle under the line of contact, on its own cells or on cells
    ``map_coarsening`` (fx, fy) times as long, which take every fx-th and fy-th of its heights where they are.

    If the grid is longer than the map, the map is repeated, or mirrored if it is not periodic along x. ``ends`` [m]:
    lengths up and down stream (default: `reach`). ``memo``: as of `Problem` (None: of its own). Raises
    `TooManyCellsError` for more cells than `MOST_GRID_CELLS`, and `InputError` for a coarsening that does not divide
    the map.
    """
    (nx, ny) = surface.shape
    (fx, fy) = map_coarsening
    dx = surface.spacing[0] * fx
    dy = surface.spacing[1] * fy
    if ny % fy:
        raise InputError(
            f"map_coarsening = {map_coarsening} does not divide the {ny} cells of the map along y; allowed: its "
            "divisors"
        )
    check_number_of_cells(surface, line, map_coarsening, ends=ends)
    index = _columns_taken(surface, line, fx, ends)
    period = nx if surface.periodic_axes[0] else 2 * nx
    place = index % period
    place = np.where(place < nx, place, period - 1 - place)
    heights = surface.heights[place, fy // 2 :: fy] - surface.heights.mean()
    shape = heights.shape
    spacing = (dx, dy)
    memo = Memo() if memo is None else memo
    operator = memo.get(
        OperatorKey(shape, spacing, line.e_prime),
        lambda: half_space(shape, spacing, line.e_prime, BOUNDARY),
        lambda operator: operator.symbol.size,
    )
    x = (index - (nx - 1) / 2) * surface.spacing[0]
    limit = math.inf if hardness is None else hardness
    return Problem(
        line=line,
        sliding=sliding,
        x=x,
        heights=heights,
        operator=operator,
        boundary_friction=boundary_friction,
        hardness=limit,
        boundary_film=boundary_film,
        memo=memo,
    )


def _columns_taken(
    surface: Surface, line: LineContact, times: int, ends: tuple[float, float] | None = None
) -> np.ndarray:
    """Return the numbers of the columns of ``surface``, continued, that a grid takes on cells so many ``times`` as long
    along x; ``ends``: as of `lay_out`."""
    dx = surface.spacing[0] * times
    upstream, downstream = reach(line, surface.sq) if ends is None else ends
    begins = line.lubricant.inlet_length
    if begins is not None and begins < upstream + dx:  # the first cell is the first that is all behind it
        upstream = begins - 1.5 * dx + 1e-9 * dx
    # the centres of the cells of the map are (i - (nx - 1)/2) dx/fx; those taken are fx//2, fx//2 + fx, ...
    middle = (surface.shape[0] - 1) / 2
    taken = times // 2
    first = math.floor((middle - taken) / times - upstream / dx)
    last = math.ceil((middle - taken) / times + downstream / dx)
    return taken + times * np.arange(first, last + 1)


def why_too_many(cells: float) -> str:
    """Return why a strip of about so many ``cells`` is not solved, as text; "" if it is."""
    if cells <= MOST_GRID_CELLS:
        return ""
    return f"a strip needs {cells:.2g} cells, more than the {MOST_GRID_CELLS:.3g} that are solved at most"


def check_number_of_cells(
    surface: Surface, line: LineContact, map_coarsening: tuple[int, int], ends: tuple[float, float] | None = None
) -> None:
    """Raise `TooManyCellsError` if ``surface`` has more cells than `MOST_GRID_CELLS` on these; arguments as of
    `lay_out`."""
    (fx, fy) = map_coarsening
    (dx, dy) = surface.spacing
    columns = _columns_taken(surface, line, fx, ends).size
    rows = surface.shape[1] // fy
    if columns * rows > MOST_GRID_CELLS:
        raise TooManyCellsError(
            f"contact: a deterministic film needs {columns} x {rows} cells of {dx * fx:.3g} x {dy * fy:.3g} m here; "
            f"allowed: up to {MOST_GRID_CELLS:.3g} cells (larger contact.spacing, or a narrower patch)"
        )


def shifted(problem: Problem, surface: Surface) -> Callable[[float], np.ndarray]:
    """Return the function of a distance [m] along x by which ``surface`` has moved that gives its heights [m] on the
    cells of ``problem``, which are its own or several times as long.

    It is shifted by its Fourier transform along x: by complete cells exactly. One that is not periodic is continued by
    its mirror image.
    """
    (nx, ny) = surface.shape
    dx = surface.spacing[0]
    fy = ny // problem.heights.shape[1]
    heights = surface.heights[:, fy // 2 :: fy] - surface.heights.mean()
    if not surface.periodic_axes[0]:
        heights = np.concatenate([heights, heights[::-1]])
    period = heights.shape[0]
    place = np.rint(problem.x / dx + (nx - 1) / 2).astype(int) % period
    waves = np.fft.rfft(heights, axis=0)
    k = 2 * np.pi * np.fft.rfftfreq(period, dx)
    return lambda s: np.fft.irfft(waves * np.exp(-1j * k * s)[:, None], n=period, axis=0)[place]
