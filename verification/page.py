"""The report as one HTML page. It has no script, fetches nothing, and can be read on a phone and without a network."""

from __future__ import annotations

import base64
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from .check import Check, Figure, Table
from .run import Outcome
from .types import TableRow
from .wording import allowed, by_grade, listed, number, remark, seconds

if TYPE_CHECKING:
    from .report import Report

CSS = Path(__file__).with_name("page.css").read_text(encoding="utf-8")


def render(report: Report) -> str:
    """Return the complete page for a `report.Report`."""
    state = "good" if report.passed else "bad"
    failed = [(o, c) for o in report.outcomes for c in o.checks if c.failed]
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<link rel="icon" href="data:,">',
        f"<title>lubfric verification: {escape(report.verdict)}</title><style>\n{CSS}</style></head><body>",
        "<h1>lubfric verification</h1>",
        f'<p class="verdict {state}">{escape(report.verdict)}</p>',
        f'<p class="dim">Level {escape(report.level)}, {escape(report.started)}, {report.seconds:.0f} s. '
        + escape(", ".join(f"{k} {v}" for k, v in report.environment.items()))
        + "</p>",
        overview(report),
    ]
    if failed:
        parts.append("<h2>What failed</h2>" + checks_table([c for _, c in failed]))
    deviating = [c for c in report.checks if c.listed]
    if deviating:
        parts.append("<h2>Listed deviations</h2>" + deviations_table(deviating))
    parts += [section(o) for o in report.outcomes]
    return "\n".join([*parts, "</body></html>\n"])


def overview(report: Report) -> str:
    """Return a line for each study, with a link to its section."""
    done = {o.study.name: o for o in report.outcomes}
    rows = []
    for name in report.selected:
        if name not in done:
            rows.append((escape(name), "not run", "", "", ""))
            continue
        o = done[name]
        decisive = [c for c in o.checks if c.decisive]
        ok = sum(c.passed for c in decisive)
        listed_ones = sum(c.deviates_as_listed for c in decisive)
        rows.append(
            (
                f'<a href="#{escape(name)}">{escape(o.study.title)}</a>',
                mark(passed=o.passed),
                f"{ok} of {len(decisive)}" + (f", {listed_ones} listed" if listed_ones else ""),
                by_grade(o.checks),
                seconds(o.seconds),
            )
        )
    return html_table(("Study", "Verdict", "Checks", "By grade", "Time"), rows)


def section(outcome: Outcome) -> str:
    """Return everything one study handed over."""
    parts = [
        f'<h2 id="{escape(outcome.study.name)}">{escape(outcome.study.title)}</h2>',
        *(f'<p class="text">{escape(" ".join(p.split()))}</p>' for p in outcome.description.split("\n\n")),
    ]
    if outcome.error:
        parts.append(
            f'<p class="verdict bad">{escape(outcome.error)}</p><details><summary>Traceback</summary>'
            f"<pre>{escape(outcome.trace)}</pre></details>"
        )
    parts.append(checks_table(outcome.checks))
    parts += [figure(f) for f in outcome.figures]
    parts += [data_table(t) for t in outcome.tables]
    if outcome.fields:
        files = "".join(
            f"<li>{escape(outcome.study.name)}_{escape(f.name)}.vtu: {escape(f.caption)}</li>" for f in outcome.fields
        )
        parts.append(f"<h3>Fields, as VTU in this folder</h3><ul>{files}</ul>")
    return "\n".join(parts)


def checks_table(checks: list[Check] | tuple[Check, ...]) -> str:
    """Return the checks of a study, or the failed ones of all. Of very many only the failed ones are shown."""
    chosen = listed(tuple(checks))
    note = "" if len(chosen) == len(checks) else f"<p>{len(checks)} checks, all of them in report.json.</p>"
    published = [c for c in chosen if c.errors]
    others = [c for c in chosen if not c.errors]
    note += beside_table(published) if published else ""
    if published and not others:
        return note
    rows = [
        (
            verdict_of(c) if c.decisive else "shown",
            escape(c.grade),
            escape(c.name),
            escape(number(c.measured) + ("" if c.unit == "1" else f" {c.unit}")),
            escape(allowed(c)),
            escape(c.source + (f"; {c.note}" if c.note else "")),
            seconds(c.seconds),
        )
        for c in others
    ]
    return note + html_table(("Verdict", "Grade", "Check", "Measured", "Allowed", "Source", "Time"), rows)


def deviations_table(checks: list[Check]) -> str:
    """Return the table of the checks for which a deviation is listed, with cause and reason."""
    rows = [
        (verdict_of(c), escape(c.name), escape(number(c.measured)), escape(allowed(c)), escape(remark(c)))
        for c in checks
    ]
    return html_table(("Verdict", "Check", "Measured", "Allowed", "Reason"), rows)


def beside_table(checks: list[Check]) -> str:
    """Return the table of values of lubfric and published values, each with its error; the deviation in per cent, and
    in units of both errors."""
    rows = []
    for c in checks:
        unit = "" if c.unit == "1" else f" {c.unit}"
        value, published = (f"{number(v)} ± {e:.2g}{unit}" for v, e in zip((c.measured, c.expected), c.errors))
        percent = f"{round(100 * (c.measured / c.expected - 1), 6) + 0.0:+.2g} %" if c.expected else ""
        source = c.source + (f". {c.note}" if c.note else "")
        rows.append(
            (
                verdict_of(c),
                escape(c.name),
                escape(published),
                escape(value),
                percent,
                f"{c.units:.2f}",
                escape(source),
            )
        )
    return html_table(("Verdict", "Quantity", "Published", "lubfric", "Deviation", "Over both errors", "Source"), rows)


def data_table(table: Table) -> str:
    """Return a table of a study. A wide one scrolls inside its own box."""
    rows = ([escape(number(v)) for v in row] for row in table.rows)
    body = html_table([escape(str(c)) for c in table.columns], rows, "wide", table.caption)
    return f'<div class="scroll">{body}</div>'


def html_table(
    columns: list[str] | tuple[str, ...],
    rows: Iterable[TableRow],
    kind: str = "cards",
    caption: str = "",
) -> str:
    """Return a table of ready HTML cells; one of cards turns into them on a narrow screen."""
    head = "".join(f"<th>{c}</th>" for c in columns)
    body = []
    for row in rows:
        pairs = zip(columns, row, strict=True)
        cells = (f'<td data-label="{c}">{f"<span>{v}</span>" if v else ""}</td>' for c, v in pairs)
        body.append(f"<tr>{''.join(cells)}</tr>")
    top = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f'<table class="{kind}">{top}<thead><tr>{head}</tr></thead><tbody>{"".join(body)}</tbody></table>'


def figure(item: Figure) -> str:
    """Return a figure with its bytes inside the page."""
    kind = {"svg": "image/svg+xml", "png": "image/png"}[item.format]
    data = base64.b64encode(item.data).decode("ascii")
    return (
        f'<figure><img alt="{escape(item.caption)}" src="data:{kind};base64,{data}">'
        f"<figcaption>{escape(item.caption)}</figcaption></figure>"
    )


def verdict_of(check: Check) -> str:
    """Return the verdict of a check as a word."""
    return "listed" if check.deviates_as_listed else mark(passed=check.passed)


def mark(*, passed: bool) -> str:
    """Return the verdict as a word, not by colour alone."""
    return '<strong class="good">pass</strong>' if passed else '<strong class="bad">FAIL</strong>'
