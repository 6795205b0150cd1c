"""Load sharing: film and contact that carry F_T = F_C + F_H together, at the one root of the closure, Eq. (8)."""

import math
from dataclasses import dataclass, replace

from ..._base import Renamed, Root, increasing_root
from ...contact import ContactState, RoughContact
from ...errors import CONVERGED, ConvergenceError, Report
from ...film import EHLResult
from ...scene import Scene, budget
from ..model_answer import ModelDetails
from ..shared import film_and_exponents, is_of_impossible_stress
from .closure import gap_under, residual_slope, volume_residual
from .forces import Forces, forces_of
from .point import Point, Settings, Trial
from .response import Response, loads_at, respond

# Factor on Moes' film above any film. Half and twice as much change f by 1e-15 (`python -m
# verification.campaigns.constants`).
SAFE_FILM = 2.0

# Bounds of ln(F_H/F_C) [-]: film shares down to 4e-18, contact shares to 1e-13. A choice, near rounding.
BOUNDS = (-40.0, 30.0)

# Bound of ln(F_H/F_C) with a given arriving film: a film that carries less and leaves the gap empty counts as no film.
# A choice, far below the error of f.
EMPTY_LOG_RATIO = math.log(1e-4)

# First step of ln(F_H/F_C) from a guess. Half and twice as much take 6 and 15 % longer (`python -m
# verification.campaigns.constants`).
FIRST_RATIO_STEP = 1.5

# First step of ln(F_H/F_C) from a balance at another speed. Half and twice as much take 10 % longer.
NEXT_STEP = 0.7

# Steps of Newton's method, at most. A choice: a bound.
MOST_NEWTON_ITERATIONS = 30

# Longest step of Newton's method in ln(F_H/F_C). A choice: a larger value may overshoot, a smaller one takes more
# steps.
LONGEST_NEWTON_STEP = 1.0

# Step in ln(F_H/F_C) at which Newton's method ends: it gives a start only. A choice: a smaller value takes more steps
# here, a larger one takes more of the balance.
LAST_NEWTON_STEP = 1e-3

# Part of the load on the film, at most, at which the root is looked for without a start. Not measured: a start only.
MOST_FILM_SHARE = 0.9

# Rounds, each with tighter tolerances, at most. A choice: a bound.
BALANCE_ROUNDS = 6

# Distance in ln(F_H/F_C) from the balance up to which a stored response is used for it. A choice: a larger value uses a
# response of another load.
OWN_RESPONSE = 0.3

# Rigid film of the total load over Sq below which the film carries less than the last digit of the load: at 1e-12 m/s
# the load of two films was balanced to 2e-11 (a film of 4e-18 m on 100 nm). A choice, by rounding.
NEGLIGIBLE_FILM = 1e-14


@dataclass(frozen=True, kw_only=True)
class Balance(Renamed, ModelDetails):
    """Film and contact of one operating point in balance, by Eq. (8).

    Attributes
    ----------
    film_load, contact_load : loads of film and contact [N]
    film : None: none carries load
    contact_state : the rough contact at its load
    forces : friction, and the heat behind it
    report : of the root
    response : how the balance reacts to an error of its gap; None: the film carries everything
    settings : tolerances with which it was solved; None: no film was
    notes : choices that a reader should know
    why_no_film : why none carries load, as text: no entrainment, or a given film that does not fill the gap; "": one
        does
    """

    kind = "balance"

    film_load: float
    contact_load: float
    film: EHLResult | None
    contact_state: ContactState
    forces: Forces
    report: Report
    response: Response | None = None
    settings: Settings | None = None
    notes: tuple[str, ...] = ()
    why_no_film: str = ""
    _RENAMED = {"contact": "contact_state", "split": "log_load_ratio"}

    @property
    def smooth_film(self) -> EHLResult | None:
        return self.film

    @property
    def log_load_ratio(self) -> float:
        """ln(F_H/F_C)."""
        if self.film_load <= 0:
            return BOUNDS[0]
        return math.log(self.film_load / self.contact_load) if self.contact_load > 0 else BOUNDS[1]

    @property
    def slope(self) -> float:
        """Slope of the residual of the closure over ``log_load_ratio``; infinite where no film shares the load."""
        per_gap = 0.0 if self.response is None else self.response.log_load_ratio_per_gap
        return residual_slope(per_gap, self.contact_state.mean_film)


def solve_balance(
    scene: Scene,
    speed: float,
    rough_contact: RoughContact,
    sq: float,
    start: Balance | None = None,
    *,
    is_correctable: bool = False,
    starts_at_other_ratio: bool = False,
) -> Balance:
    """Return the balance of ``scene`` at ``speed`` [m/s] on ``rough_contact``, whose heights have the standard
    deviation ``sq`` [m].

    Without entrainment the contact carries the total load. The film of the total load is solved first; if it separates
    the surfaces, no contact is solved. Otherwise the residual (gap - film)/(gap + film) of the volume increases with
    the film's share, so there is one root in ln(F_H/F_C), and the load balance holds by construction. Film, volume and
    contact are solved as closely as ``numerics.tolerance`` needs, by the response of the friction that a first, loose
    balance shows (`lubfric.scene.budget`). ``start``: a balance on the same contact at another speed, or on another
    contact at this one; ``starts_at_other_ratio``: whether its slide-roll ratio is another one, so that only its film
    and contact serve; ``is_correctable``: what the root leaves open of the volume will be corrected to first order.
    Raises `ConvergenceError`.
    """
    if speed == 0:
        return _dry(scene, rough_contact, "no entrainment")
    if sq > 0 and scene.lubricant.inlet_film is None and scene.line_contact(speed).rigid_film < NEGLIGIBLE_FILM * sq:
        return _dry(scene, rough_contact, "the film carries less than the rounding error of the load")
    alone: EHLResult | None = None
    notes: tuple[str, ...] = ()
    if not _touches_certainly(scene, speed, rough_contact):
        try:
            film_alone = _film_alone(Point(scene, speed, rough_contact, _first_settings(scene, is_film_alone=True)))
        except ConvergenceError as error:  # a balance in contact, which is unique, excludes separation as well
            notes = (f"the full-load film was not solved ({error})",)
        else:
            if volume_residual(film_alone.contact_state) <= 0:
                return film_alone
            alone = film_alone.film
    settings = replace(_first_settings(scene), is_correctable=is_correctable)
    is_same_speed = start is not None and start.film is not None and start.film.entrainment_speed == speed
    known = start if is_same_speed and not starts_at_other_ratio else None
    if known is not None:
        settings = known.settings or settings
    return replace(_in_contact(Point(scene, speed, rough_contact, settings), sq, start, alone, known), notes=notes)


def is_separated(scene: Scene, speed: float, rough_contact: RoughContact) -> bool:
    """Return whether the film of the total load at ``speed`` [m/s], not 0, separates the surfaces of ``rough_contact``,
    as `solve_balance` finds before any contact. Raises `ConvergenceError`."""
    if _touches_certainly(scene, speed, rough_contact):
        return False
    film_alone = _film_alone(Point(scene, speed, rough_contact, _first_settings(scene, is_film_alone=True)))
    return volume_residual(film_alone.contact_state) <= 0


def _dry(scene: Scene, rough_contact: RoughContact, why: str) -> Balance:
    """Return the balance of a contact that carries the total load; ``why`` no film does, as text."""
    load = scene.bodies.load
    shape = rough_contact.x**2 / (2 * scene.bodies.radius)
    state = rough_contact.close(shape, load)
    report = _report(scene, CONVERGED, history=(0.0,), contact_state=state, film=None, notes=(f"{why}: all contact",))
    forces = forces_of(scene, None, state, load)
    return Balance(
        film_load=0.0,
        contact_load=load,
        film=None,
        contact_state=state,
        forces=forces,
        report=report,
        response=respond(scene, rough_contact, state, load=load, thickness=shape),
        why_no_film=why,
    )


def _film_alone(point: Point) -> Balance:
    """Return the film under the total load, on the cells that the sum of its shear stress needs, over the unloaded
    contact."""
    load = point.scene.bodies.load
    trial = point.trial(load, 0.0)
    while True:
        forces = forces_of(point.scene, trial.film, trial.contact_state, 0.0)
        cells = _film_cells(point, trial.film, forces)
        if cells == point.settings.film_cells:
            break
        point = replace(point, settings=replace(point.settings, film_cells=cells))
        trial = point.trial(load, 0.0, trial)
    notes = ("separated: the film is thicker than the highest summits",)
    report = _report(
        point.scene, CONVERGED, history=(0.0,), contact_state=trial.contact_state, film=trial.film, notes=notes
    )
    return Balance(
        film_load=load,
        contact_load=0.0,
        film=trial.film,
        contact_state=trial.contact_state,
        forces=forces,
        report=report,
        settings=point.settings,
    )


def _touches_certainly(scene: Scene, speed: float, rough_contact: RoughContact) -> bool:
    """Return whether the summits would even reach through twice Moes' film over an undeformed cylinder, which is
    thicker than any film."""
    film = SAFE_FILM * scene.line_contact(speed).moes_film
    return volume_residual(rough_contact.close(film + rough_contact.x**2 / (2 * scene.bodies.radius), 0.0)) > 0


def _in_contact(
    point: Point, sq: float, start: Balance | None, alone: EHLResult | None, known: Balance | None
) -> Balance:
    """Return film and contact in balance, solved again until the settings are those that the balance shows to be
    needed.

    ``alone``: the film of the total load, if it is solved; ``known``: ``start``, if it has the speed and the sliding of
    the point. Where a root cannot be found as closely as needed, because f jumps with single cells, the last one is
    kept and its error reported.
    """
    near = _root_start(point, sq, start)
    if near.last is None and alone is not None:
        unloaded = point.rough_contact.close(alone.film_at(point.rough_contact.x), 0.0)
        near = replace(near, last=Trial(film=alone, contact_state=unloaded, film_load=0.0, contact_load=0.0))
    converged: Balance | None = None
    response: Response | None = None
    response_at = math.nan  # its ln(F_H/F_C)
    if known is not None:
        response = known.response
        response_at = known.log_load_ratio
    for _ in range(BALANCE_ROUNDS):
        point, root = _root_on_accurate_contact(point, near)
        trial: Trial | None = root.payload
        if trial is None:
            return _dry(point.scene, point.rough_contact, "the film in the inlet does not fill the gap")
        if response is None or abs(root.x - response_at) > OWN_RESPONSE:
            response = _response(point, trial)
            response_at = root.x
        balance = _balance(point, root, response)
        converged = balance if root.status == CONVERGED else converged
        settings = _needed_settings(point, balance)
        if settings == point.settings or root.status != CONVERGED:
            break
        same = replace(settings, balance_tolerance=point.settings.balance_tolerance)
        value = root.value if same == point.settings else None
        point = replace(point, settings=settings)
        near = RootStart(log_load_ratio=root.x, slope=balance.slope, last=trial, value=value)
    return converged or balance


def response_of(point: Point, balance: Balance) -> Response:
    """Return the response of film and contact of ``balance`` to the load, with the friction that they have at
    ``point``."""
    assert balance.film is not None
    return _response(point, _trial_of(balance, balance.film))


def _trial_of(balance: Balance, film: EHLResult) -> Trial:
    """Return the ``film`` and the contact of a ``balance`` as a trial, from which others start."""
    return Trial(
        film=film,
        contact_state=balance.contact_state,
        film_load=balance.film_load,
        contact_load=balance.contact_load,
        last_touching=balance.contact_state,
    )


def _response(point: Point, trial: Trial) -> Response:
    def film_of(load: float) -> EHLResult:
        return point.film(load, trial.film, trial.film.cells)

    thickness, shape = point.on(point.rough_contact, trial.film)
    return respond(
        point.scene,
        point.tight(point.rough_contact),
        trial.contact_state,
        load=trial.contact_load,
        thickness=thickness,
        shape=shape,
        film_of=film_of,
    )


@dataclass(frozen=True, kw_only=True)
class RootStart:
    """Where the root of the volume residual is looked for.

    Attributes
    ----------
    log_load_ratio : ln(F_H/F_C)
    slope : of the residual there; None: not known
    step : first step of ln(F_H/F_C)
    last : the trial to start from; None: there is none
    value : the residual of that trial, where it is the same with today's settings; None: it is solved again
    """

    log_load_ratio: float
    slope: float | None = None
    step: float = NEXT_STEP
    last: Trial | None = None
    value: float | None = None


def _root_start(point: Point, sq: float, start: Balance | None) -> RootStart:
    """Return where the root is looked for from the balance ``start``; without one (None) where the rigid isoviscous
    film is two Sq thick."""
    if start is None or start.film is None or start.response is None:
        thickness = max(2 * sq, 1e-12)
        film_share = min(point.line(point.scene.bodies.load).rigid_film / thickness, MOST_FILM_SHARE)
        return RootStart(log_load_ratio=math.log(film_share / (1 - film_share)), step=FIRST_RATIO_STEP)
    trial = _trial_of(start, start.film)
    if start.film.entrainment_speed == point.speed:
        return RootStart(log_load_ratio=start.log_load_ratio, slope=start.slope, last=trial)
    log_load_ratio, slope = predict_log_load_ratio(point, start)
    return RootStart(log_load_ratio=log_load_ratio, slope=slope, last=trial)


def predict_log_load_ratio(point: Point, start: Balance) -> tuple[float, float | None]:
    """Predict ln(F_H/F_C) at ``point``, and the slope of the residual there, from the balance ``start`` at another
    speed.

    The film follows Moes' formula, ``h ~ F_H^-m`` locally, and the mean gap a power of the contact's load, ``g ~
    F_C^-b``. The slope of (g - h)/(g + h) at a balance is (b F_H + m F_C)/(2 F_T), which gives b. The prediction is
    only a start.
    """
    assert start.film is not None
    load = point.scene.bodies.load
    slope = start.slope
    line = point.line(start.film_load)
    before, exponent, _ = film_and_exponents(replace(line, entrainment_speed=start.film.entrainment_speed))
    stiffness = max(2 * slope * load - exponent * start.contact_load, 0.0) / start.film_load
    log_load_ratio = start.log_load_ratio
    for _ in range(MOST_NEWTON_ITERATIONS):
        film_load, contact_load = loads_at(load, log_load_ratio)
        film, exponent, _ = film_and_exponents(point.line(film_load))
        slope_of_excess = (stiffness * film_load + exponent * contact_load) / load
        excess = -stiffness * math.log(contact_load / start.contact_load) - math.log(film / before)
        log_load_ratio = min(
            max(
                log_load_ratio + min(max(-excess / slope_of_excess, -LONGEST_NEWTON_STEP), LONGEST_NEWTON_STEP),
                BOUNDS[0],
            ),
            BOUNDS[1],
        )
        if abs(excess) <= LAST_NEWTON_STEP * slope_of_excess:
            break
    return log_load_ratio, 0.5 * slope_of_excess


def _root_on_accurate_contact(point: Point, near: RootStart) -> tuple[Point, Root]:
    """Return ``point`` with a contact that is solved so closely that the error of its gap is within the tolerance of
    the root, and the root there; on a less accurate contact it would be elsewhere."""
    while True:
        root = _root(point, near)
        now = point.settings.contact_tolerance
        volume = point.settings.balance_tolerance
        tighter = now if root.payload is None else _contact_tolerance(point, root.payload.contact_state, volume)
        if tighter == now:
            return point, root
        point = replace(point, settings=replace(point.settings, contact_tolerance=tighter))
        near = replace(near, log_load_ratio=root.x, last=root.payload, value=None)


def _contact_tolerance(point: Point, contact_state: ContactState, volume: float) -> float | None:
    """Return the tolerance that leaves less than ``volume`` of the gap of ``contact_state`` open: that of ``point`` if
    it does."""
    now = point.settings.contact_tolerance
    adjustable = point.rough_contact.adjustable_tolerance
    fields = contact_state.fields
    if adjustable is None or fields is None or point.scene.numerics.contact_tolerance is not None:
        return now
    enough = max(volume * contact_state.mean_gap / fields.length, budget.TIGHTEST_CONTACT)
    return now if (now or adjustable) <= budget.SLACK * enough else 0.5 * enough


def _root(point: Point, near: RootStart) -> Root:
    """Return the root of the closure's residual over ln(F_H/F_C); its payload is the `Trial` there, None where a given
    film does not fill the gap."""
    load = point.scene.bodies.load
    most = point.rough_contact.capacity
    lowest = max(math.log((load - most) / most), BOUNDS[0]) if most < load else BOUNDS[0]

    def residual_at(x: float, last: Trial | None) -> tuple[float, Trial]:
        trial = point.trial(*loads_at(load, x), last)
        return volume_residual(trial.contact_state), trial

    is_fed = point.scene.lubricant.inlet_film is not None
    root = increasing_root(
        residual_at,
        near.log_load_ratio,
        step=near.step,
        tolerance=point.settings.balance_tolerance,
        slope=near.slope,
        first=(near.value, near.last),
        bounds=(max(lowest, EMPTY_LOG_RATIO) if is_fed else lowest, BOUNDS[1]),
    )
    return replace(root, payload=None) if is_fed and root.x == EMPTY_LOG_RATIO and root.value > 0 else root


def _balance(point: Point, root: Root, response: Response) -> Balance:
    """Return the balance of the last trial of ``root``, with the forces there and its report."""
    trial = root.payload
    scene = point.scene
    report = _report(
        scene,
        root.status,
        history=root.history,
        contact_state=trial.contact_state,
        film=trial.film,
        notes=(),
        tolerance=point.settings.balance_tolerance,
    )
    forces = forces_of(scene, trial.film, trial.contact_state, trial.contact_load)
    return Balance(
        film_load=trial.film_load,
        contact_load=trial.contact_load,
        film=trial.film,
        contact_state=trial.contact_state,
        forces=forces,
        report=report,
        response=response,
        settings=point.settings,
    )


def _first_settings(scene: Scene, *, is_film_alone: bool = False) -> Settings:
    numerics = scene.numerics
    film = numerics.film_tolerance or min(budget.FILM_ALONE * numerics.tolerance, budget.LOOSEST_FILM)
    if not is_film_alone and numerics.film_tolerance is None:
        film = budget.FIRST_FILM
    return Settings(film_tolerance=film, balance_tolerance=numerics.balance_tolerance or budget.LOOSEST_VOLUME)


def _needed_settings(point: Point, balance: Balance) -> Settings:
    """Return the settings that ``balance`` shows to be needed: those of ``point`` if they are enough."""
    numerics = point.scene.numerics
    now = point.settings
    response = balance.response
    assert response is not None and balance.film is not None
    mean_film = balance.contact_state.mean_film
    film = now.film_tolerance
    volume = now.balance_tolerance
    if numerics.film_tolerance is None:
        enough = budget.FILM_GRID * numerics.tolerance / max(response.per_film(balance.forces, mean_film), 1e-12)
        film = _tightened(film, max(min(enough, budget.FIRST_FILM), budget.TIGHTEST_FILM))
    if numerics.balance_tolerance is None:
        part = budget.CORRECTED if now.is_correctable else budget.BALANCE
        allowed = response.gap_for("coefficient", part * numerics.tolerance)
        if now.is_correctable:
            allowed /= budget.SLOPE
        if response.log_load_ratio_per_gap:  # f may be anything farther off
            allowed = min(
                allowed,
                (budget.MOST_MOVED if now.is_correctable else OWN_RESPONSE) / abs(response.log_load_ratio_per_gap),
            )
        open_length = min(0.5 * allowed, budget.LOOSEST_VOLUME * min(mean_film, balance.film.central_film))
        volume = _tightened(volume, max(open_length / gap_under(mean_film), budget.TIGHTEST_VOLUME))
    contact_tolerance = _contact_tolerance(point, balance.contact_state, volume)
    return Settings(
        film_tolerance=film,
        balance_tolerance=volume,
        film_cells=_film_cells(point, balance.film, balance.forces),
        contact_tolerance=contact_tolerance,
        is_correctable=now.is_correctable,
    )


def _tightened(now: float, needed: float) -> float:
    return now if now <= budget.SLACK * needed else needed


def _film_cells(point: Point, film: EHLResult, forces: Forces) -> int:
    """Return the least number of cells of the film: twice its present number where the sum of its shear stress is not
    exact enough. It stays where that sum is of stresses that no oil carries."""
    numerics = point.scene.numerics
    now = point.settings.film_cells
    is_resolved = forces.quadrature <= budget.SHEAR_SUM * numerics.tolerance or is_of_impossible_stress(forces.shear)
    if numerics.film_tolerance is not None or is_resolved:
        return now
    return min(2 * film.cells, max(budget.MOST_FILM_CELLS, now))


def _report(
    scene: Scene,
    status: str,
    *,
    history: tuple[float, ...],
    contact_state: ContactState,
    film: EHLResult | None,
    notes: tuple[str, ...],
    tolerance: float | None = None,
) -> Report:
    """Return the report of a balance whose error of the volume has this ``history``."""
    residuals = {"volume": min(history), "load": 0.0}
    if film is not None:
        residuals["film"] = film.report.residual
    if contact_state.fields is not None:
        residuals["contact"] = contact_state.fields.report.residual
    steps = len(history)
    return Report(
        "load sharing",
        status,
        iterations=steps,
        residual=min(history),
        tolerance=scene.numerics.tolerance_of("balance") if tolerance is None else tolerance,
        residuals=residuals,
        history=tuple(history),
        evaluations=steps,
        notes=notes,
    )
