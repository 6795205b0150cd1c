"""The result of one operating point: `FrictionResult`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, cast

import numpy as np

from .._base import Renamed, Shown, __version__, figures, packaged, validate
from ..errors import InputError, Report
from ..models import ContactFields, ModelDetails
from ..models.shared import (
    Assumption,
    Decision,
    UnmodelledEffect,
    Violation,
    alpha_beside_interval,
    length_beside_interval,
)
from ..quantities import PointQuantities, described_in_doc, in_words
from .bibtex import bibtex, source_in_words
from .inputs_to_quote import span_to_quote
from .methods_paragraph import methods_paragraph
from .uncertainty import NumberErrors, Uncertainty

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..film import EHLResult
    from ..models import Balance, DeterministicResult


# What lubfric itself is cited for where no source is a chapter of it.
PROGRAM = "the program that computed the result"


@described_in_doc
@dataclass(frozen=True, repr=False, kw_only=True)
class FrictionResult(Renamed, PointQuantities[float], Shown):
    """The friction of one operating point, its uncertainty, what was modelled, and fields (after Akchurin et al. 2015,
    doi:10.1007/s11249-015-0536-z).

    The residuals are relative. All fields are of one solve, on the same cells: ``result.fields`` says which, and
    ``heights``, ``pressure``, ``gap``, ``x`` and ``y`` are read from it. ``fields=True`` solves a single patch on its
    own cells.

    Attributes
    ----------
    report : of the solve
    uncertainty : of the coefficient, by solvers and grids, by the finite sample of the surface, and by the model
        (`Uncertainty`, docs/uncertainty.md)
    errors : relative errors of every other number (`NumberErrors`), for example ``errors.contact_load``
    decision : which model answered, what was solved, and why; ``decision.text`` describes it
    power_loss_interval : 95 % interval of the power loss [W], (low, high)
    rolling_resistance_interval : 95 % interval of the rolling resistance [N], (low, high); NaN: not known
    validity : the assumptions that do not hold (`lubfric.Violation`). A severe one is there only where it was accepted
    unmodelled_effects : effects that are not modelled, each with the likely change of f (relative; NaN: not known) and
        a recommendation, the largest first; without those that would change f by less than the tolerance
        (`lubfric.models.shared.unmodelled_effects`)
    methods : names of the published methods used; ``cite()`` gives the publications
    inputs : the inputs that a publication states, as text; ``cite("methods")`` has them
    fields : the fields of one solve (`lubfric.models.ContactFields`); None where there are none
    compared_fields : those of the cheapest model on the same strips, where it was solved as well
    details : what each model keeps of its solve, by its name
    """

    report: Report
    uncertainty: Uncertainty
    errors: NumberErrors
    decision: Decision
    power_loss_interval: tuple[float, float] = (math.nan, math.nan)
    rolling_resistance_interval: tuple[float, float] = (math.nan, math.nan)
    validity: tuple[Violation, ...] = ()
    unmodelled_effects: tuple[UnmodelledEffect, ...] = ()
    methods: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    fields: ContactFields | None = None
    compared_fields: ContactFields | None = None
    details: dict[str, ModelDetails | None] = field(default_factory=dict)
    _RENAMED = {"lacks": "unmodelled_effects"}

    def without_fields(self) -> FrictionResult:
        """Return a copy with its numbers alone."""
        return replace(self, fields=None, compared_fields=None, details={})

    def _facts(self) -> dict[str, str]:
        facts = in_words(self, ("speed", "coefficient", "contact_load", "film_load", "lambda_ratio"))
        facts["f"] = f"{self.coefficient:.5g}{_interval(self.uncertainty.interval)}"
        facts[""] = self.report.status
        warnings = [violation.what for violation in self.validity if not violation.is_note]
        if warnings:
            facts["warnings"] = "; ".join(warnings)
        return facts

    @property
    def not_in_interval(self) -> str:
        """Heat that neither f nor its interval includes, the range of an estimated pressure-viscosity coefficient, and
        another correlation length if it may change f by more than the interval, as text; "" if there are none."""
        heat = [violation for violation in self.validity if violation.assumption == Assumption.HEAT_INCLUDED]
        parts = [
            f"f and its interval are without the heat of the film, which lowers f by up to {each.value_in_words} %"
            for each in heat[:1]
        ]
        has_interval = math.isfinite(self.uncertainty.sampling)
        by_alpha = alpha_beside_interval(self.unmodelled_effects) if has_interval else ""
        by_length = length_beside_interval(self.unmodelled_effects, self.coefficient, self.uncertainty.interval)
        return "; ".join(filter(None, (*parts, by_alpha, by_length)))

    def cite(self, format: str = "text") -> str:
        """Return the publications of the methods used for this result, the model's first: one a line, with ``format``
        "bibtex" as BibTeX entries, or with "methods" as a paragraph to quote: program, model, methods, and what the
        interval contains."""
        return cite_together([self], format)

    @property
    def balance(self) -> Balance | None:
        """The balance of film and contact by Eq. (8), where it was solved; else None."""
        return cast("Balance | None", self._kept("balance"))

    @property
    def deterministic(self) -> DeterministicResult | None:
        """The results of the deterministic strips, where they give the answer ("deterministic", "quick"); else None."""
        return cast("DeterministicResult | None", self._kept("deterministic"))

    @property
    def smooth_film(self) -> EHLResult | None:
        """The film of smooth surfaces of the answer; None where the answer has none, as by the deterministic model."""
        kept = self.details.get(self.decision.model)
        return None if kept is None else kept.smooth_film

    def _kept(self, kind: str) -> ModelDetails | None:
        """Return the details of this kind that a model keeps, if there are any."""
        return next((kept for kept in self.details.values() if kept is not None and kept.kind == kind), None)

    @property
    def shows_contact(self) -> bool:
        """Whether there are fields of the contact."""
        return self.fields is not None

    @property
    def x(self) -> np.ndarray:
        """Cells of the contact along the motion [m], (nx,), around the line of contact."""
        return self._field("x")

    @property
    def y(self) -> np.ndarray:
        """Cells of the contact along the line [m], (ny,)."""
        return self._field("y")

    @property
    def heights(self) -> np.ndarray:
        """Heights of the roughness of both bodies about their mean [m], (nx, ny)."""
        return self._field("heights")

    @property
    def pressure(self) -> np.ndarray:
        """Pressure [Pa], (nx, ny): of the asperity contacts by "paper", else of film and contact together."""
        return self._field("pressure")

    @property
    def gap(self) -> np.ndarray:
        """Gap of the rough contact [m], (nx, ny)."""
        return self._field("gap")

    def plot_contact(self, ax: "Axes | None" = None, rows: slice = slice(None)) -> "Axes":
        """Draw the pressure of the rough contact in the plane, in some ``rows`` along the line, and the edges of the
        Hertz strip, dashed; returns the axes. Needs ``fields=True``, and contact. The load ratio above is that of the
        point, a mean over strips and moments, of which one is drawn."""
        axes = figures.axes_or_new(ax)
        fields = self._fields_with("pressure")
        pressure, unit = figures.in_unit_for(fields.pressure[:, rows], "Pa")
        figures.field_image(
            axes, fields.x, fields.y[rows], pressure, "magma_r", f"{fields.pressure_label} ({unit})", vmin=0
        )
        figures.hertz_strip(axes, fields.half_width)
        share = self.contact_load / (self.contact_load + self.film_load)
        axes.set_title(f"U = {self.speed:.4g} m/s, mean $F_C/F_T$ = {share:.3g}", fontsize=10, wrap=True)
        if ax is None:
            figures.narrow_to_map(axes)
        return axes

    def _field(self, name: str) -> np.ndarray:
        values: np.ndarray = getattr(self._fields_with(name), name)
        return values

    def _fields_with(self, name: str) -> ContactFields:
        """Return the fields, of which ``name`` is requested. Raises `InputError` where there are none."""
        if self.fields is None:
            why = "it is separated" if self.contact_load == 0 else "it was not kept, or comes from a contact curve"
            raise InputError(f"this point has no {name} of its contact: {why}; solve one in contact with fields=True")
        return self.fields


def _interval(interval: tuple[float, float]) -> str:
    low, high = interval
    return f" ({low:.4g} to {high:.4g} at 95 %)" if np.isfinite(low) and np.isfinite(high) else ""


def cited(
    methods: Iterable[str],
    format: str = "text",
    *,
    decisions: Sequence[Decision] = (),
    errors: Sequence[Uncertainty] = (),
    inputs: Sequence[str] = (),
    what: str = "Friction",
    models: Sequence[str] = (),
    points_by_model: Mapping[str, int] | None = None,
) -> str:
    """Return the papers of ``methods`` (keys of papers.toml), the model's first, and lubfric itself, in the ``format``
    "text" or "bibtex"; or "methods", a paragraph about them with the ``decisions`` and ``errors`` of the points, and
    the ``inputs`` that they share. ``what``: was computed, as text; without decisions, ``points_by_model``: how many
    points each model answered, by its name, or ``models``: that may have answered."""
    validate.choice("format", format, ("text", "bibtex", "methods"))
    used = set(methods)
    papers = packaged(__package__, "papers.toml")
    sources = [source for name, group in papers.items() if name in used for source in group]
    if format == "methods":
        return methods_paragraph(__version__, sources, decisions, errors, inputs, what, models, points_by_model)
    if not any(source["type"] == "software" for source in sources):
        program = papers["deterministic model"][0]  # a chapter of lubfric
        sources.append(program | {"chapter": "", "purpose": PROGRAM})
    return bibtex(sources) if format == "bibtex" else "\n".join(map(source_in_words, sources))


def cite_together(points: Iterable[FrictionResult], format: str = "text", more_inputs: Sequence[str] = ()) -> str:
    """Return the papers of several results, each once, in the ``format`` of `cited`; ``more_inputs``: of them, as
    text."""
    solved = list(points)
    methods = [name for point in solved for name in point.methods]
    return cited(
        methods,
        format,
        decisions=[point.decision for point in solved],
        errors=[point.uncertainty for point in solved],
        inputs=[*shared_inputs([point.inputs for point in solved]), *_speeds(solved), *more_inputs],
    )


def _speeds(points: Sequence[FrictionResult]) -> list[str]:
    """Return the entrainment speeds of the ``points`` as text; of several their range."""
    speeds = [point.speed for point in points]
    if not speeds:
        return []
    if min(speeds) == max(speeds):
        return [span_to_quote("entrainment speed", speeds, "m/s")]
    return [span_to_quote(f"{len(speeds)} entrainment speeds", speeds, "m/s")]


def shared_inputs(of_points: Sequence[Sequence[str]]) -> list[str]:
    """Return the inputs that all points have in common, of those ``of_points``, in their order."""
    first = of_points[0] if of_points else ()
    return [text for text in first if all(text in inputs for inputs in of_points)]
