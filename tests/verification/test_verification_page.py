"""The page in a real browser: renders, silent on the console, fits a phone, needs no network."""

import json
import shutil
import subprocess
from html import unescape

import pytest

from verification import convergence, page, plotting
from verification.check import Check, Field, Table
from verification.report import Report, environment
from verification.run import Outcome
from verification.studies import Study

BROWSER = next((b for b in ("chromium", "chromium-browser", "google-chrome") if shutil.which(b)), None)
PROBE = """<script>
const failures = [];
addEventListener('error', e => failures.push(e.message || e.target.src || 'load error'), true);
addEventListener('load', () => parent.postMessage(JSON.stringify({
  width: innerWidth, content: document.documentElement.scrollWidth, failures: failures,
  count: document.images.length,
  drawn: [...document.images].every(i => i.complete && i.naturalWidth > 0)}), '*'));
</script></head>"""
# a window is never narrower than 500 px, a frame is as narrow as it is told
FRAME = """<!DOCTYPE html><html><head><link rel="icon" href="data:,"><script>
addEventListener('message', e => document.body.setAttribute('data-probe', e.data));
</script></head><body style="margin: 0">
<iframe src="report.html" style="border: 0; width: %dpx; height: 900px"></iframe></body></html>"""

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine to open the page in")


@pytest.fixture(scope="module")
def html():
    """A page with everything on it: figures, wide tables, long words, failures."""
    long = "https_like_word_without_a_break_" * 4
    series = [convergence.Series("P1", [1, 0.5], [1, 0.25], 2)]
    figure = convergence.picture("c", "a caption", series, "size", "error")
    canvas, _ = plotting.axes(width=12)
    png = plotting.finish("wide", canvas, "a wide one", "png")
    checks = (
        Check("passes", 1.23456789e-12, 1.2345e-12, 1e-3, "a closed form, doi:10.1000/182", unit="m³/s"),
        Check(long, 1.0, 2.0, 1e-9, long, note=long),
    )
    table = Table("t", "a wide table", [f"column {i}" for i in range(12)], [[i / 7 for i in range(12)]])
    field = Field("f", "pressure", [[0.0, 0.0]], {})
    trace, words = "Traceback\n  " + "x" * 300, "Words.\n\nMore words."
    study, drawn = Study("s", "m:f", "A study"), (figure, png)
    outcome = Outcome(study, "quick", words, checks, (table,), drawn, (field,), 1.0, f"SolveError: {long}", trace)
    return page.render(Report("quick", ("s", "later"), (outcome,), False, "2026-01-01", 1.0, environment()))


def browse(folder, page, *options):
    """Run the browser on a page in ``folder``, cut off from any network."""
    quiet = "--headless --no-sandbox --disable-gpu --hide-scrollbars --no-first-run --disable-dev-shm-usage".split()
    quiet += ["--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", "--virtual-time-budget=5000"]
    line = [BROWSER, *quiet, f"--user-data-dir={folder / 'profile'}", *options, (folder / page).as_uri()]
    return subprocess.run(line, capture_output=True, text=True, timeout=60, check=True)


@pytest.mark.parametrize("width", [390, 1200])
def test_page_renders_fits_and_is_silent(html, tmp_path, width):
    (tmp_path / "report.html").write_text(html.replace("</head>", PROBE, 1), encoding="utf-8")
    (tmp_path / "frame.html").write_text(FRAME % width)
    done = browse(tmp_path, "frame.html", "--window-size=1300,900", "--dump-dom")
    assert "CONSOLE" not in done.stderr
    found = json.loads(unescape(done.stdout.partition('data-probe="')[2].partition('"')[0]))
    assert found["width"] == width
    assert found["content"] <= found["width"]
    assert found["failures"] == [] and found["drawn"] and found["count"] == 2
