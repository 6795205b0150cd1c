"""The report as one HTML page. It has no script, fetches nothing, and can be read on a phone and without a network."""

import base64
from html import escape

from .wording import allowed, by_grade, listed, number, seconds

CSS = """
:root { color-scheme: light dark; --ink: #1b1f24; --dim: #57606a; --line: #d0d7de; --paper: #fff;
  --soft: #f6f8fa; --good: #1a7f37; --bad: #cf222e; --link: #0969da; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6edf3; --dim: #9198a1; --line: #3d444d;
  --paper: #0d1117; --soft: #151b23; --good: #3fb950; --bad: #f85149; --link: #58a6ff; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 70rem; font: 16px/1.5 system-ui, sans-serif;
  color: var(--ink); background: var(--paper); overflow-wrap: anywhere; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 .5rem; }
h2 { font-size: 1.2rem; line-height: 1.3; margin: 2.5rem 0 .5rem; padding-top: 1rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.5rem 0 .5rem; }
a { color: var(--link); }
.verdict { font-weight: 600; padding: .6rem .8rem; border-left: .3rem solid; background: var(--soft); }
.good { color: var(--good); } .bad { color: var(--bad); } .dim { color: var(--dim); font-size: .875rem; }
.text { max-width: 46rem; }
table { border-collapse: collapse; width: 100%; font-size: .875rem; font-variant-numeric: tabular-nums; }
th { text-align: left; white-space: nowrap; font-weight: 600; color: var(--dim); }
th, td { padding: .35rem .6rem .35rem 0; border-bottom: 1px solid var(--line); vertical-align: top;
  overflow-wrap: anywhere; }
[data-label=Check], [data-label=Quantity] { min-width: 11rem; }
[data-label=Measured], [data-label=Allowed], [data-label=Theirs], [data-label=Ours] { min-width: 7rem; }
[data-label=Verdict], [data-label=Time] { white-space: nowrap; }
figure { margin: 1.5rem 0; }
figure img { max-width: 100%; height: auto; display: block; background: #fff; border-radius: .3rem; }
figcaption, caption { text-align: left; color: var(--dim); font-size: .875rem; padding: .4rem 0; }
pre { overflow-x: auto; background: var(--soft); padding: .6rem; font-size: .8rem; overflow-wrap: normal; }
.scroll { overflow-x: auto; }
.scroll th, .scroll td { white-space: nowrap; padding-right: 1rem; }
@media (max-width: 44rem) {
  .cards thead { display: none; }
  .cards tr { display: grid; grid-template-columns: 6rem 1fr; padding: .5rem 0;
    border-bottom: 1px solid var(--line); }
  .cards td { min-width: 0; grid-column: 1 / 3; display: grid; grid-template-columns: subgrid; border: 0;
    padding: .1rem 0; }
  .cards td:empty { display: none; }
  .cards td::before { content: attr(data-label); color: var(--dim); }
  .cards td > * { min-width: 0; overflow-wrap: anywhere; }
  .cards td:first-child { font-weight: 600; }
}
"""


def render(report) -> str:
    """The whole page for a `report.Report`."""
    state = "good" if report.passed else "bad"
    failed = [(o, c) for o in report.outcomes for c in o.checks if c.failed]
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<link rel="icon" href="data:,">',
        f"<title>lubfric verification: {escape(report.verdict)}</title><style>{CSS}</style></head><body>",
        "<h1>lubfric verification</h1>",
        f'<p class="verdict {state}">{escape(report.verdict)}</p>',
        f'<p class="dim">Level {escape(report.level)}, {escape(report.started)}, {report.seconds:.0f} s. '
        + escape(", ".join(f"{k} {v}" for k, v in report.environment.items()))
        + "</p>",
        overview(report),
    ]
    if failed:
        parts.append("<h2>What failed</h2>" + checks_table([c for _, c in failed]))
    parts += [section(o) for o in report.outcomes]
    return "\n".join([*parts, "</body></html>\n"])


def overview(report) -> str:
    """A line for each study, with a link to its section."""
    done = {o.study.name: o for o in report.outcomes}
    rows = []
    for name in report.selected:
        if name not in done:
            rows.append((escape(name), "not run", "", "", ""))
            continue
        o = done[name]
        judged = [c for c in o.checks if c.decisive]
        ok = sum(c.passed for c in judged)
        rows.append(
            (
                f'<a href="#{escape(name)}">{escape(o.study.title)}</a>',
                mark(o.passed),
                f"{ok} of {len(judged)}",
                by_grade(o.checks),
                seconds(o.seconds),
            )
        )
    return html_table(("Study", "Verdict", "Checks", "By grade", "Time"), rows)


def section(outcome) -> str:
    """Everything one study handed over."""
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
        parts.append(f"<h3>Fields, beside this page as VTU</h3><ul>{files}</ul>")
    return "\n".join(parts)


def checks_table(checks) -> str:
    """The checks of a study, or the failed ones of all. Of very many only the failed ones are shown."""
    chosen = listed(tuple(checks))
    note = "" if len(chosen) == len(checks) else f"<p>{len(checks)} checks, all of them in report.json.</p>"
    published, others = [c for c in chosen if c.errors], [c for c in chosen if not c.errors]
    note += beside_table(published) if published else ""
    if published and not others:
        return note
    rows = [
        (
            mark(c.passed) if c.decisive else "shown",
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


def beside_table(checks) -> str:
    """Ours beside published values, each with its error; the deviation in per cent, and in units of both errors."""
    rows = []
    for c in checks:
        unit = "" if c.unit == "1" else f" {c.unit}"
        ours, theirs = (f"{number(v)} ± {e:.2g}{unit}" for v, e in zip((c.measured, c.expected), c.errors))
        percent = f"{round(100 * (c.measured / c.expected - 1), 6) + 0.0:+.2g} %"
        source = c.source + (f". {c.note}" if c.note else "")
        rows.append(
            (mark(c.passed), escape(c.name), escape(theirs), escape(ours), percent, f"{c.units:.2f}", escape(source))
        )
    return html_table(("Verdict", "Quantity", "Theirs", "Ours", "Deviation", "In errors", "Source"), rows)


def data_table(table) -> str:
    """A table of a study. A wide one scrolls inside its own box."""
    rows = ([escape(number(v)) for v in row] for row in table.rows)
    body = html_table([escape(str(c)) for c in table.columns], rows, "wide", table.caption)
    return f'<div class="scroll">{body}</div>'


def html_table(columns, rows, kind: str = "cards", caption: str = "") -> str:
    """A table of ready HTML cells; one of cards turns into them on a narrow screen."""
    head = "".join(f"<th>{c}</th>" for c in columns)
    body = []
    for row in rows:
        pairs = zip(columns, row, strict=True)
        cells = (f'<td data-label="{c}">{f"<span>{v}</span>" if v else ""}</td>' for c, v in pairs)
        body.append(f"<tr>{''.join(cells)}</tr>")
    top = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f'<table class="{kind}">{top}<thead><tr>{head}</tr></thead><tbody>{"".join(body)}</tbody></table>'


def figure(item) -> str:
    """A figure with its bytes inside the page."""
    kind = {"svg": "image/svg+xml", "png": "image/png"}[item.format]
    data = base64.b64encode(item.data).decode("ascii")
    return (
        f'<figure><img alt="{escape(item.caption)}" src="data:{kind};base64,{data}">'
        f"<figcaption>{escape(item.caption)}</figcaption></figure>"
    )


def mark(passed: bool) -> str:
    """The verdict as a word, not by colour alone."""
    return '<strong class="good">pass</strong>' if passed else '<strong class="bad">FAIL</strong>'
