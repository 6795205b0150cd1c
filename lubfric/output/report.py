"""report.html of a run: one page for who was not there, with question, answer, pictures, doubts, inputs and sources. It
needs no other file, and prints."""

import base64
from collections.abc import Iterable
from html import escape
from importlib.resources import files
from string import Template

import numpy as np

from ..errors import InputError
from ..estimate import FrictionResult
from ..models.shared import (
    Prepared,
    effect_in_words,
    percent,
)
from ..quantities import COLUMNS, counted
from ..scene import Scene
from ..studies import KNOWN, CurveResult, Law, StribeckResult
from ..units import converted, printed, unit_for, worded
from .describe import TABLE_CAPTION, SceneEstimate
from .inputs import FACTS, SECTIONS, inputs

OF_POINT = ["coefficient", "contact_load", "film_load", "central_film", "film_to_roughness_ratio"]
OF_POINT += ["real_contact_area_fraction"]
CAPTIONS = {
    "stribeck.png": "Friction, shares of the load and film",
    "traction.png": "Friction over the slide-roll ratio",
    "history.png": "History",
    "contact.png": "Contact at one speed",
    "sharing.png": "The same by load sharing, Eq. (8), alone: contact, and film and surfaces on a section",
    "surface.png": "Roughness",
}
UNKNOWN = "the error of the model is not known, and not in it"


def report_page(
    prepared: Prepared, result, record: dict, contents: dict[str, bytes], estimate: SceneEstimate, law: Law | str = ""
) -> bytes:
    """The page of ``result``, a curve or a run in time. ``record``: what result.json holds; ``contents``: of the files
    of the run, its pictures among them; ``estimate``: before it was solved; ``law``: of a curve, or why it has none."""
    scene = prepared.scene
    curve = result if isinstance(result, CurveResult) else None
    answer, *more = _of_run(result) if curve is None else _of_curve(scene, curve)
    made = [*record["versions"].items(), ("seconds", f"{record['seconds']:.3g}"), ("solver", result.report.message)]
    page = Template((files(__package__) / "report.html").read_text(encoding="utf-8")).substitute(
        name=escape(scene.name),
        date=escape(record["date"]),
        version=escape(record["versions"]["lubfric"]),
        question=escape(_question(scene)),
        answer=escape(answer),
        more="".join(f"<p>{escape(text)}</p>" for text in more),
        pictures="".join(_picture(contents[name], caption) for name, caption in CAPTIONS.items() if name in contents),
        warnings=_list(result.validity, "Every assumption that is checked holds throughout.", "warning"),
        results="" if curve is None else "".join(_points(curve)),
        inputs="".join(_inputs(scene, section) for section in SECTIONS),
        law=_law(law, curve),
        lacks=_lacks(scene, curve, estimate),
        solved=_list([text for name in ("transient", "contact", "model") for text in estimate.sections[name]]),
        table=_rows(estimate.table[0], [_cells(row) for row in estimate.table[1:]]),
        about_table=escape(TABLE_CAPTION),
        map=escape("; ".join(estimate.sections["surface"])),
        notes=_list(prepared.surface.notes),
        sources=_list([] if curve is None else curve.cite().splitlines(), head="<h2>Sources</h2>"),
        made=_rows((), [f"<th>{escape(name)}</th><td>{escape(value)}</td>" for name, value in made]),
    )
    return page.encode()


def _question(scene: Scene) -> str:
    bodies = scene.bodies
    oil = scene.lubricant
    motion = scene.motion
    hot = "" if oil.temperature is None else f" at {oil.temperature - 273.15:.4g} °C"
    return (
        f"How large is the friction coefficient f of a line contact of reduced radius {worded(bodies.radius, 'm')} and "
        f"length {worded(bodies.width, 'm')} under {worded(bodies.load, 'N')} (mean Hertz pressure "
        f"{worded(bodies.mean_hertz_pressure, 'Pa')}), in an oil of {worded(oil.viscosity, 'Pa s')}{hot}, "
        + (
            "while motion or load change in time?"
            if scene.transient
            else f"at a slide-roll ratio of {motion.slide_roll_ratio:.4g}?"
        )
    )


def _of_curve(scene: Scene, curve: CurveResult) -> list[str]:
    """The answer of a curve: at its point nearest to the scene's own, and over all."""
    plural = curve.SWEPT[3]
    f = curve["coefficient"]
    solved = np.flatnonzero(np.isfinite(f))
    if (nearest := _nearest(scene, curve)) is None:
        return [f"0 of {counted(f.size, plural)} have an answer."]
    known, place = nearest
    low, high = known.uncertainty.interval
    model = f"; {UNKNOWN}" if np.isnan(known.uncertainty.model) else ", model included"
    within = f", between {low:.3g} and {high:.3g} (95 %{model})" if np.isfinite(low) else ", with an error not known"
    told = [f"f = {known.coefficient:.3g}{within}, {place}."]
    if np.isfinite(known.central_film):
        share = known.contact_load / (known.contact_load + known.film_load)
        film = f"the film is {known.in_unit('central_film', 'nm'):.3g} nm thick in the middle"
        told.append(f"There {100 * share:.3g} % of the load is on spots in contact, and {film}.")
    if f.size > 1:
        least = _place(curve, solved[f[solved].argmin()])
        ends = f"{f[solved].min():.4g} to {f[solved].max():.4g}, and least {least}"
        told.append(f"{solved.size} of {f.size} {plural} have an answer. f is {ends}.")
    return told + _lift_off(curve)


def _lift_off(curve: CurveResult) -> list[str]:
    """Where the contact of a curve over the speed ends, if its points tell."""
    if not isinstance(curve, StribeckResult):
        return []
    try:
        at = curve.lift_off
        (low, high) = curve.lift_off_range
        least = curve.least
    except InputError:  # too few of them, or in both directions
        return []
    if at is None:
        touching = "all" if np.nanmax(curve.contact_load[curve.speed != 0]) > 0 else "none"
        return [f"Lift-off is not between the speeds solved: in motion the surfaces touch at {touching} of them."]
    known = f", and least at U = {least[0]:.3g} m/s: {least[1]:.3g}" if curve.between <= KNOWN else ""
    return [
        f"Between the speeds f is known within {100 * curve.between:.2g} %{known}.",
        f"The film lifts the surfaces off each other at U = {at:.4g} m/s, {low:.4g} to {high:.4g} m/s by the "
        "interpolation between the speeds. Summits higher than those that were solved touch beyond it.",
    ]


def _law(law: Law | str, curve: CurveResult | None) -> str:
    """The section on the formula of a curve, or on why it has none; "" of what is no curve over the speed."""
    if isinstance(law, Law) and isinstance(curve, StribeckResult):
        off, within = (f"{100 * error:.2g} %" for error in (law.largest, curve.between))
        fastest = law.ranges["speed"][1]
        said = (
            f"<p>For simulations of a machine, also as law.json and, in C, law.c. It is off by at most {off} from the "
            f"curve through the solved points, which is known within {within} between them. To check what you make of "
            f"it: f = {law(fastest):.4g} at U = {fastest:.4g} m/s.</p><pre>{escape(law.text)}</pre>"
        )
    else:
        said = f"<p>None was fitted: {escape(str(law))}.</p>"
    return f"<h2>The curve as a formula</h2>{said}" if law else ""


def _lacks(scene: Scene, curve: CurveResult | None, estimate: SceneEstimate) -> str:
    """What is left out, and by how much f would change by it; of a curve at its point nearest to the scene's own."""
    if curve is None or (nearest := _nearest(scene, curve)) is None:
        return _list(estimate.sections["left out"])
    point, place = nearest
    lacks = map(effect_in_words, point.unmodelled_effects)
    head = f"<p>Likely changes of f {escape(place)}, by closed forms:</p>"
    return _list([*lacks], "Nothing that would change f by its tolerance.", head=head)


def _nearest(scene: Scene, curve: CurveResult) -> tuple[FrictionResult, str] | None:
    """The solved point nearest to the scene's own, and its place in words; None if no point has an answer."""
    name = curve.SWEPT[0]
    own = scene.motion.entrainment_speed if name == "speed" else scene.motion.slide_roll_ratio
    away = np.where(np.isfinite(curve["coefficient"]), np.abs(getattr(curve, name) - own), np.inf)
    index = int(away.argmin())
    return None if (point := curve.points[index]) is None else (point, _place(curve, index))


def _place(curve: CurveResult, index: int) -> str:
    name, symbol, unit, _ = curve.SWEPT
    return f"at {symbol} = {getattr(curve, name)[index]:.4g} {unit.removesuffix('(slide-roll ratio)')}".rstrip()


def _of_run(result) -> list[str]:
    """The answer of a run in time."""
    if result.time.size < 2:
        return ["The run has no answer."]
    mean = result.average()
    f = result.coefficient
    error = 100 * mean.sampling
    film = worded(float(result.min_film.min()), "m")
    peak = int(np.abs(f).argmax())
    low, high = result.uncertainty.interval[peak]
    when = "the" if mean.in_motion == 1 else f"the {100 * mean.in_motion:.3g} % in motion of the"
    ends = f" ({low:.3g} to {high:.3g} with the range of f_b)" if np.any(result.inputs) else ""
    return [
        f"f is {mean.coefficient:.4g} on average over {when} {result.time[-1]:.4g} s.",
        f"Its standard error is {error:.2g} %, as the surface is finite; {UNKNOWN}.",
        f"f is at most {f[peak]:.4g}{ends}; the film is at least {film}.",
    ]


def _points(curve: CurveResult) -> list[str]:
    """The tables of all points: their numbers, one unit for all of a kind; and the errors of f. Then what there is to
    know about these, once for all points alike."""
    name = curve.SWEPT[0]
    found = {name: getattr(curve, name)} | {n: curve[n] for n in OF_POINT}
    kinds = {n: COLUMNS[n].unit for n in (name, *OF_POINT)}
    units = {si: unit_for([v for n in kinds if kinds[n] == si for v in found[n].tolist()], si) for si in kinds.values()}
    heads = [
        f"{COLUMNS[n].label} {COLUMNS[n].symbol}" + (f" ({printed(units[si])})" if printed(units[si]) else "")
        for n, si in kinds.items()
    ]
    columns = [converted(found[n], si, units[si]) for n, si in kinds.items()]
    numbers = []
    errors = []
    notes: dict[str, list[str]] = {}
    for i, point in enumerate(curve.points):
        if point is None:
            why = f'<td colspan="{len(OF_POINT) + 1}" class="warning">{escape(str(curve.errors[i]))}</td>'
            numbers.append(_cells([f"{columns[0][i]:.4g}"]) + why)
            continue
        cells = [f"{values[i]:.4g}" for values in columns]
        low, high = point.uncertainty.interval
        cells.insert(2, f"{low:.3g} to {high:.3g}" if np.isfinite(low) else "not known")
        numbers.append(_cells(cells))
        of = [percent(getattr(point.uncertainty, part)) for part in ("numerical", "sampling", "model", "inputs")]
        errors.append(_cells([f"{found[name][i]:.4g}", *of, point.decision.model]))
        for note in (*point.uncertainty.notes, *point.decision.notes):
            notes.setdefault(note, []).append(f"{found[name][i]:.4g}")
    heads.insert(2, "interval of f, 95 %")
    head = heads[0], "numerical", "surface (standard error)", "model (95 %)", "inputs", "solved by"
    at = f"at {COLUMNS[name].symbol} ="
    unit = printed(units[kinds[name]])
    told = [f"{note} ({at} {', '.join(places)} {unit}".rstrip() + ")" for note, places in notes.items()]
    return ["<h2>Results</h2>", _rows(heads, numbers), "<h2>Errors of f</h2>", _rows(head, errors), _list(told)]


def _cells(texts: Iterable[str]) -> str:
    return "".join(f'<td class="number">{text}</td>' for text in texts)


def _rows(heads, rows: list[str]) -> str:
    head = "".join(f"<th>{escape(text)}</th>" for text in heads)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(f'<tr>{row}</tr>' for row in rows)}</tbody></table>"


def _inputs(scene: Scene, section: str) -> str:
    """The inputs of a section as a table, and what follows from them."""
    rows = [
        f"<td>{escape(label)}</td><td>{escape(text).replace(' ', '&nbsp;')}</td>"
        f'<td class="key">{escape(key + note)}</td>'
        for label, text, key, note in inputs(scene, section)
    ]
    more = _list(FACTS[section](scene)) if section in FACTS else ""
    return (_rows((section, "", ""), rows) if rows else "") + more


def _picture(content: bytes, caption: str) -> str:
    data = base64.b64encode(content).decode()
    said = escape(caption)
    return f'<figure><img alt="{said}" src="data:image/png;base64,{data}"><figcaption>{said}</figcaption></figure>'


def _list(lines, otherwise: str = "", kind: str = "", head: str = "") -> str:
    if not lines:
        return f"<p>{escape(otherwise)}</p>" if otherwise else ""
    return f'{head}<ul class="{kind}">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'
