"""Load sharing in time by finite elements: a smooth film that depends on its history, and a rough contact that does
not.

    s d(rho H)/dX - d/dX( m dP/dX ) + d(rho H)/dT = 0,   s = U(T)/U0,   T = U0 t/b,   integral of P = F_H(T)

in the Hertz variables of the load at time 0 at a speed U0 (`ehl`). The rough strip is pressed with F_T(T) - F_H under
the shape of the film of the moment (`sharing.Bodies.under`). F_H is the root at which the mean gap of the contact is
the mean film over the Hertz strip of the load of the moment, whose half-width is b sqrt(F_T(T)/F_T(0)), balanced in
every step by `sharing.root`. Steps in time are BDF2, the first one Euler's.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from . import ehl
from .ehl_film import assemble
from .ehl_newton import HERTZ_LOAD, load_weights, step_length
from .moving import BDF2, EULER, content, gained, newton_change
from .report import SolveError, require
from .ripple import stored
from .sharing import Bodies, cell_means, root, share_load

REST = (0.0, 0.0, 0.0)
SMALLEST_SPEED = 1e-3  # of U0: below it the film has no inlet in these variables


@dataclass(frozen=True, kw_only=True)
class SharedMoment:
    """The division of the load at a time [s]: loads [N], mean gap [m] and share of the strip in contact."""

    time: float
    film_load: float
    contact_load: float
    mean_gap: float
    mean_film: float
    area: float


@dataclass(frozen=True)
class TransientFilmState:
    """Pressure [p_h] and approach [b²/R] on the line of the film, and the degrees of freedom held at P = 0."""

    P: np.ndarray
    H0: float
    held: np.ndarray


def share_in_time(
    bodies: Bodies,
    speed: Callable[[float], float],
    step: float,
    *,
    load: Callable[[float], float] | None = None,
    tolerance: float = 1e-5,
    refinements: int = 0,
    max_evaluations: int = 30,
) -> Iterator[SharedMoment]:
    """The division of the load at moments ``step`` [s] apart, without end, from the steady one at time 0 on.

    ``speed`` [m/s] of a time [s] is the entrainment speed, positive; that of ``bodies.contact`` is U0, the speed at
    time 0. ``load`` [N] of a time is F_T, that of ``bodies`` at time 0 (None: always). ``tolerance``: on the balance of
    the volumes. Raises `SolveError` where a step is not solved.
    """
    contact = bodies.contact
    require(step > 0, f"step = {step} s", "> 0")
    require(
        abs(speed(0.0) / contact.entrainment_speed - 1) < 1e-9, f"speed(0) = {speed(0.0)} m/s", "that of the contact"
    )
    if load is not None:
        require(abs(load(0.0) / bodies.load - 1) < 1e-9, f"load(0) = {load(0.0)} N", "that of the bodies")
    begun = share_load(bodies, refinements=refinements, tolerance=1e-3)
    at = ehl.solve_ehl(contact, refinements=refinements)[-1]
    unit = step * contact.entrainment_speed / contact.half_width
    start = started(at, begun.film)
    steady = Moving(at=at, now=0.0, before=0.0, rates=REST, length=unit, pace=1.0, load=bodies.load)
    state, moment, log_load_ratio = balanced(
        bodies, steady, start, begun.log_load_ratio, 0.0, tolerance, max_evaluations
    )
    yield moment
    now = content(at, state.P, film_of(at, state))
    before = now
    count = 0
    while True:
        count += 1
        time = count * step
        pace = speed(time) / contact.entrainment_speed
        require(pace > SMALLEST_SPEED, f"speed = {pace:g} U0", f"> {SMALLEST_SPEED:g} U0")
        moving = Moving(
            at=at,
            now=now,
            before=before,
            rates=BDF2 if count > 1 else EULER,
            length=unit,
            pace=pace,
            load=bodies.load if load is None else load(time),
        )
        state, moment, log_load_ratio = balanced(
            bodies, moving, state, log_load_ratio, time, tolerance, max_evaluations
        )
        before = now
        now = content(at, state.P, film_of(at, state))
        yield moment


@dataclass(frozen=True, kw_only=True)
class Moving:
    """A step in time of the film in the variables ``at`` the load of time 0: its mass ``now`` and ``before``, the rates
    of BDF2 or Euler (0: a steady film), its length [b/U0], the speed over U0, and F_T [N] at its end."""

    at: ehl.EHLSolution
    now: np.ndarray | float
    before: np.ndarray | float
    rates: tuple[float, float, float]
    length: float
    pace: float
    load: float


def balanced(
    bodies: Bodies,
    moving: Moving,
    start: TransientFilmState,
    guess: float,
    time: float,
    tolerance: float,
    max_evaluations: int,
) -> tuple[TransientFilmState, SharedMoment, float]:
    """Return the film at the end of a step, the division of the load, and ln(F_H/F_C) at which the volumes agree."""
    tried: dict[float, tuple[TransientFilmState, SharedMoment]] = {}

    def mismatch(log_load_ratio: float) -> float:
        """Return (gap - film)/(gap + film) at ln(F_H/F_C) = ``log_load_ratio``."""
        film_load = moving.load / (1 + np.exp(-log_load_ratio))
        state = stepped(moving, start, film_load / bodies.load)
        tried[log_load_ratio] = state, moment_of(bodies, moving, state, film_load, time)
        return signed(log_load_ratio)

    def signed(log_load_ratio: float) -> float:
        moment = tried[log_load_ratio][1]
        return (moment.mean_gap - moment.mean_film) / (moment.mean_gap + moment.mean_film)

    def residual(log_load_ratio: float) -> float:
        return abs(signed(log_load_ratio))

    def done() -> bool:
        return min(map(residual, tried), default=1.0) <= tolerance or len(tried) >= max_evaluations

    root(mismatch, done, guess, 0.05)
    log_load_ratio = min(tried, key=residual)
    if residual(log_load_ratio) > tolerance:
        raise SolveError(f"load sharing in time: t = {time:g} s, volumes differ by {residual(log_load_ratio):.1e}")
    return *tried[log_load_ratio], log_load_ratio


def started(at: ehl.EHLSolution, film: ehl.EHLSolution) -> TransientFilmState:
    """Solve the steady film under its part of the load again, in the variables of the total load."""
    share = film.contact.load_per_width / at.contact.load_per_width
    b = at.contact.half_width
    x = np.clip(at.body.x * b, film.body.x.min() * film.contact.half_width, film.body.x.max() * film.contact.half_width)
    P = np.maximum(film.at(x)[0] / at.contact.hertz_pressure, 0.0)
    P[np.abs(at.body.x * b - x) > 0] = 0.0
    middle = int(np.argmin(np.abs(at.body.x)))
    gap = film.at(np.array([0.0]))[1][0] / at.contact.film_unit
    state = TransientFilmState(P, gap - float((at.body.compliance @ P)[middle]), P <= 0)
    steady = Moving(at=at, now=0.0, before=0.0, rates=REST, length=1.0, pace=1.0, load=np.nan)
    return stepped(steady, state, share)


def film_of(at: ehl.EHLSolution, state: TransientFilmState) -> np.ndarray:
    """Return H [b²/R] at the degrees of freedom of the line."""
    return state.H0 + at.body.x**2 / 2 + at.body.compliance @ state.P


def stepped(
    moving: Moving, start: TransientFilmState, share: float, tolerance: float = 1e-8, max_iterations: int = 60
) -> TransientFilmState:
    """Return the film at the end of a step under a ``share`` of the load of time 0."""
    at = moving.at
    rates = moving.rates
    pace = moving.pace
    step = moving.length
    body = at.body
    line = body.line
    film = replace(at.film, speed_parameter=at.film.speed_parameter * pace)
    weights = load_weights(body)
    last = int(np.argmax(body.x))
    P = start.P
    H0 = start.H0
    held = start.held
    for _ in range(max_iterations + 1):
        H = H0 + body.x**2 / 2 + body.compliance @ P
        flow = assemble(film, P, H)
        then = content(at, P, H)
        gain = (rates[0] * then + rates[1] * moving.now + rates[2] * moving.before) / step
        lost = pace * flow.residual + gained.assemble(line, c=gain)
        load = float(weights @ P / HERTZ_LOAD - share)
        error = max(np.abs(lost[~held]).sum() / abs(pace * flow.inflow), abs(load) / share, -P.min())
        new = np.where(held, lost > 0, P < 0)
        new[last] = True
        if error <= tolerance and not (new != held).any():
            return TransientFilmState(P, H0, held)
        held = new
        stored_P, stored_H = stored(film, P, H)
        by_P = pace * flow.by_P + rates[0] / step * stored_P
        by_H = pace * flow.by_H + rates[0] / step * stored_H
        dP, dH0 = newton_change(body, P, held, lost, load, by_P, by_H)
        part = step_length(film, P, dP, H, dH0 + body.compliance @ dP)
        P = P + part * dP
        H0 = H0 + part * dH0
    raise SolveError(f"film in time: error {error:.1e} after {max_iterations} steps of Newton's method")


def moment_of(bodies: Bodies, moving: Moving, state: TransientFilmState, film_load: float, time: float) -> SharedMoment:
    """Return the contact under the film of the moment, and the volumes of both."""
    film = replace(moving.at, P=state.P, H=film_of(moving.at, state))
    shape = cell_means(film, bodies.edges)
    contact_load = moving.load - film_load
    under = bodies.under(shape, contact_load)
    half_width = bodies.contact.half_width * np.sqrt(moving.load / bodies.load)
    weight = bodies.weight_within(half_width)
    weight = weight / weight.sum()
    return SharedMoment(
        time=time,
        film_load=film_load,
        contact_load=contact_load,
        mean_gap=float(weight @ under.gap),
        mean_film=float(weight @ shape),
        area=float(weight @ under.touching),
    )
