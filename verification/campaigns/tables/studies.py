"""Tables of a page that are what the studies of `python -m verification` found, at their default level.

A study runs once in a process, however many tables are made of it.
"""

import re
from collections.abc import Callable
from functools import cache, partial
from itertools import takewhile

from ... import wording
from ...catalogue import PUBLISHED, STUDIES
from ...check import Check
from ...fem.published import WEAK
from ...fem.references import SOURCES, Source
from ...run import Outcome, run_one
from .measured import Cells

LEVEL = "default"


@cache
def ran(name: str, *, published: bool = False) -> Outcome:
    """The study ``name``, or that part of `python -m verification published`; raises RuntimeError where it did
    not come to its end."""
    outcome = run_one(next(study for study in (PUBLISHED if published else STUDIES) if study.name == name), LEVEL)
    if outcome.error:
        raise RuntimeError(f"{name}: {outcome.error}")
    return outcome


def title_of(table: "partial[Cells]") -> str:
    """Return the title of the study, or the part of `python -m verification published`, behind a ``table``."""
    is_published = table.func is publications_of or "published" in table.keywords
    return next(study for study in (PUBLISHED if is_published else STUDIES) if study.name == table.args[0]).title


def table_of(study: str, name: str, *, published: bool = False) -> Cells:
    """Return a table of a study without changes."""
    table = next(t for t in ran(study, published=published).tables if t.name == name)
    return table.columns, [["-" if str(cell) == "nan" else str(cell) for cell in row] for row in table.rows]


def on_finest_grid(study: str, name: str) -> Cells:
    """Return the rows of both programs for each case, on the finest grid of each."""
    columns, rows = table_of(study, name)
    return columns, list({tuple(row[:2]): row for row in rows}.values())


def waviness() -> Cells:
    """Small waves by both programs."""
    table = next(t for t in ran("deterministic").tables if t.name == "waviness")
    return table.columns, [
        [*map(str, row[:2]), f"{row[2]:g}", *(f"{value:.3f}" for value in row[3:])] for row in table.rows
    ]


def load_sharing() -> Cells:
    """Both programs at the paper's speeds, on the finest cells."""
    table = next(t for t in ran("load_sharing").tables if t.name == "load_sharing")
    finest = max(row[1] for row in table.rows)
    rows = [
        [f"{u:g}", who, f"{f:.5f}", f"{contact:.4f}", f"{film:.4f}", f"{gap:.2f}", f"{couette:.5f}"]
        for u, cells, who, f, contact, film, gap, _, couette, _ in table.rows
        if cells == finest
    ]
    columns = ["U (m/s)", f"{finest} x {finest} cells", "f", "F_C (N)", "F_H (N)", "mean gap (nm)", "Couette force (N)"]
    return columns, rows


def transient() -> Cells:
    """Return the ten checks of runs in time that are nearest to their limits, one of each kind."""
    worst: dict[str, tuple[float, Check]] = {}
    checks = ran("transient").checks + ran("transient_mixed").checks
    for check in (c for c in checks if c.decisive and c.unit != "s"):
        kind = re.split(r" at T = |: (?=smallest|central)", check.name)[0]
        used = check.deviation / check.tolerance if check.tolerance else check.deviation
        if kind not in worst or used > worst[kind][0]:
            worst[kind] = used, check
    nearest = sorted(worst.items(), key=lambda item: -item[1][0])[:10]
    rows = [[kind, f"{c.measured:.4g}", wording.allowed(c)] for kind, (_, c) in nearest]
    return ["what", "found", "allowed"], rows


def formulations() -> Cells:
    """Return convolutions and iterations of the paper's formulations and of the default, under a cylinder."""
    table = next(t for t in ran("formulations").tables if t.name == "formulations")
    rows: dict[str, list[str]] = {}
    columns = dict.fromkeys(row[1] for row in table.rows)
    under_cylinder = [row for row in table.rows if row[0].startswith("cylinder")]
    for case, _, status, iterations, convolutions, residual, *_ in under_cylinder:
        solved = f"{convolutions} ({iterations})" if status == "converged" else f"stalls at {residual:.2g}"
        rows.setdefault(case, [case]).append(solved)
    return ["contact", *columns], list(rows.values())


def publications_of(part: str) -> Cells:
    """Return the publications of a part of `python -m verification published`: how many values agree, and how well."""
    checks = ran(part, published=True).checks
    rows = []
    for source in SOURCES.values():
        of_source = [check for check in checks if check.source == source.text]
        if not of_source:
            continue
        agreed = f"{sum(check.passed for check in of_source)} of {len(of_source)}"
        weak = sum(check.tolerance > WEAK * abs(check.expected) for check in of_source)
        origin = f"{source.got}{source.note and '; ' + source.note}"
        rows.append(
            [
                f"{citation(source)}: {source.place}",
                f"{agreed}{weak and f', {weak} weak' or ''}",
                span([check.measured / check.expected - 1 for check in of_source if check.expected], "+"),
                span([check.errors[1] / abs(check.expected) for check in of_source if check.expected]),
                span([check.errors[0] / abs(check.expected) for check in of_source if check.expected]),
                origin,
            ]
        )
    columns = ["publication", "agree", "deviation (%)", "published bound (%)", "lubfric bound (%)"]
    return [*columns, "origin of the published values"], rows


def span(values: list[float], sign: str = "") -> str:
    """Return the lowest and the highest of ``values`` in percent as one word, with a ``sign`` or none."""
    low, high = (f"{float(f'{round(100 * value, 2) + 0.0:.2g}'):{sign}g}" for value in (min(values), max(values)))
    return low if low == high else f"{low}…{high}"


def mixed_values() -> Cells:
    """Return each value of mixed friction or load ratio with the 95 % bounds of both sides."""
    rows = []
    for check in ran("mixed", published=True).checks:
        if check.unit == "1":
            ours, theirs = check.errors
            values = (f"{check.expected:.3g}±{theirs:.2g}", f"{check.measured:.3g}±{ours:.2g}")
            difference = f"{check.units:.2g}"
            rows.append([check.name, *values, difference])
    return ["quantity", "published", "lubfric", "difference over both bounds"], rows


# What lies behind a difference, as the table names it.
CAUSE_IN_WORDS = {"theirs": "publication", "ours": "lubfric", "both": "both", "unknown": "unknown"}


def differing() -> Cells:
    """Return the published values that differ by more than both bounds, with the cause.

    Of each publication these are all, or the two that differ least and most."""
    sources = {source.text: source for source in SOURCES.values()}
    of_source: dict[str, list[Check]] = {}
    for check in (c for part in PUBLISHED for c in ran(part.name, published=True).checks if not c.passed):
        of_source.setdefault(check.source, []).append(check)
    rows = []
    for source, checks in of_source.items():
        ordered = sorted(checks, key=lambda check: check.units)
        for check in ordered if len(ordered) <= 2 else (ordered[0], ordered[-1]):
            ours, theirs = check.errors
            name = check.name if check.unit == "1" else f"{check.name}, in {check.unit}"
            values = (f"{check.expected:.4g}±{theirs:.2g}", f"{check.measured:.4g}±{ours:.2g}")
            rows.append(
                [
                    name,
                    *values,
                    CAUSE_IN_WORDS[check.listed.cause] if check.listed else "unknown",
                    f"{authors(sources[source])}: {len(checks)}",
                ]
            )
    return ["quantity", "published", "lubfric", "cause", "publication: values that differ"], rows


PERSON = re.compile(r"([A-Z]\. )+[\w-]+( et al\.| \d+)?")  # "D. Dowson", "K. L. Johnson et al.", "A. Doleschel 2002"


def people_of(source: Source) -> list[str]:
    """Return the authors as they are written in the citation."""
    return list(takewhile(PERSON.fullmatch, source.words.split(", ")))


def surnames(people: list[str]) -> str:
    """Return up to two surnames, or the first and "et al."."""
    names = [re.sub(r"^([A-Z]\. )+| \d+$", "", person) for person in people]
    return ", ".join(names) if len(names) < 3 else f"{names[0]} et al."


def citation(source: Source) -> str:
    """Return the citation with surnames, as in "Dowson, Toyoda, 5th Leeds-Lyon Symp. (1978) 60"."""
    people = people_of(source)
    if not people or people[-1][-1].isdigit():
        return source.words
    return surnames(people) + source.words.removeprefix(", ".join(people))


def authors(source: Source) -> str:
    """Return surnames and year, as in "Dowson, Toyoda 1978"; of a company its name."""
    people = people_of(source)
    year = re.search(r"\b(18|19|20)\d\d\b", source.words)
    return f"{surnames(people)} {year[0]}" if people and year else source.words.split(", ")[0]


TABLES: dict[str, Callable[[], Cells]] = {
    "load-sharing": load_sharing,
    **{f"published-{part.name}": partial(publications_of, part.name) for part in PUBLISHED},
    "published-differing": differing,
    "mixed-values": mixed_values,
    "masjedi": partial(table_of, "mixed", "masjedi", published=True),
    "rough-strip": partial(on_finest_grid, "rough_strip", "rough-strip"),
    "touching-strip": partial(on_finest_grid, "touching_strip", "touching-strip"),
    "starved": partial(table_of, "starved", "starved"),
    "sharing-in-time": partial(table_of, "sharing_in_time", "sharing-in-time"),
    "waviness": waviness,
    "transient": transient,
    "formulations": formulations,
}
