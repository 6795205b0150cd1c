"""report.html in a real browser: it fits its window and a sheet of paper, its pictures are there, and no word of a user
runs as a script."""

import json
import re
import shutil
import subprocess
from html import unescape

import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

from lubfric.output import main

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
OPTIONS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]
NAME = "<script>document.title = 'ran'</script> R&D"
SCENE = f"name = {json.dumps(NAME)}\n" + BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n"
LOOK = """<script>window.onload = () => {
  const images = [...document.images], wide = document.documentElement;
  document.body.dataset.seen = JSON.stringify({
    title: document.title, head: document.querySelector("h1").textContent,
    drawn: images.every(i => i.complete && i.naturalWidth > 300), images: images.length,
    beyond: wide.scrollWidth - wide.clientWidth, sections: [...document.querySelectorAll("h2")].map(h => h.textContent),
    answer: document.querySelector(".answer").textContent})}</script></body>"""
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no browser")


def browse(folder, *options):
    data = f"--user-data-dir={folder / 'browser'}"
    return subprocess.run([BROWSER, *OPTIONS, data, *options], capture_output=True, text=True, timeout=60, check=True)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    (folder / "s.toml").write_text(SCENE + SMALL_PATCH + "sampling = 'patch'\n")
    assert main(["run", str(folder / "s.toml"), "--speeds", "0.1,0.3,1", "--out", str(folder / "out")]) == 0
    return folder


@pytest.mark.parametrize("width", [680, 1200])  # px, of A4 between its margins, and of a window
def test_it_opens_whole_and_runs_nothing(run, width):
    page = (run / "out" / "report.html").read_text(encoding="utf-8").replace("</body>", LOOK)
    (run / "look.html").write_text(page, encoding="utf-8")
    shown = browse(run, f"--window-size={width},900", "--dump-dom", (run / "look.html").as_uri()).stdout
    seen = json.loads(unescape(re.search(r'data-seen="(.*?)"', shown)[1]))
    assert seen["title"] == NAME and seen["head"].startswith(NAME)
    assert seen["drawn"] and seen["images"] == 3 and seen["beyond"] <= 0
    parts = "Question|Answer|Cautions|Left out|Results|Errors of f|The curve as a formula|How it was solved|Inputs"
    assert seen["sections"] == [*parts.split("|"), "Sources", "Made by"]
    point = json.loads((run / "out" / "result.json").read_text())["points"][1]
    low, high = point["uncertainty"]["interval"]
    told = f"f = {point['coefficient']:.3g}, between {low:.3g} and {high:.3g} (95 %, model included), at U = 0.3 m/s."
    assert seen["answer"] == told


def test_it_prints_on_some_sheets(run):
    browse(run, "--no-pdf-header-footer", f"--print-to-pdf={run / 'out.pdf'}", (run / "out" / "report.html").as_uri())
    content = (run / "out.pdf").read_bytes()
    assert content.startswith(b"%PDF") and 3 <= len(re.findall(rb"/Type /Page\b", content)) <= 8
    boxes = {tuple(map(float, box.split())) for box in re.findall(rb"/MediaBox \[([^]]*)\]", content)}
    assert all(box[2:] == pytest.approx((595, 842), abs=1.5) for box in boxes)  # points: A4, upright


def test_the_record_has_units_and_a_date(run):
    record = json.loads((run / "out" / "result.json").read_text())
    assert re.fullmatch(r"20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC", record["date"])
    units = record["units"]
    assert (units["bodies.load"], units["speed"], units["central_film"], units["coefficient"]) == ("N", "m/s", "m", "-")
    numbers = [name for name, value in record["points"][0].items() if isinstance(value, float)]
    assert set(numbers) <= set(units)
