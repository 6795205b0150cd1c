"""report.html in a real browser: it fits its window and a sheet of paper, its pictures are there, and no word of a user
runs as a script."""

import json
import re
import shutil
import subprocess
from html import escape, unescape

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH
from scipy.special import stdtrit

from lubfric.output import main
from lubfric.output.report import shortfalls

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
OPTIONS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]
NAME = "<script>document.title = 'ran'</script> R&D"
SCENE = f"name = {json.dumps(NAME)}\n" + BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n"
LOOK = """<script>window.onload = () => {
  const page = document.querySelector("iframe").contentDocument, wide = page.documentElement;
  const images = [...page.images], texts = name => [...page.querySelectorAll(name)].map(h => h.textContent);
  document.body.dataset.seen = JSON.stringify({
    title: page.title, head: texts("h1")[0], sections: texts("h2"), status: texts(".status")[0],
    drawn: images.every(i => i.complete && i.naturalWidth > 300), images: images.length,
    beyond: wide.scrollWidth - wide.clientWidth, width: wide.clientWidth, answer: texts(".answer")[0],
    folded: [...page.querySelectorAll("details")].map(d => d.open),
    longest: Math.max(...[...page.querySelectorAll(".budget i")].map(i => i.offsetWidth)),
    bars: [...page.querySelectorAll(".budget i")].map(i => i.style.width)})}</script></body>"""
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no browser")


def browse(folder, *options):
    data = f"--user-data-dir={folder / 'browser'}"
    return subprocess.run([BROWSER, *OPTIONS, data, *options], capture_output=True, text=True, timeout=60, check=True)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    (folder / "s.toml").write_text(SCENE + SMALL_PATCH)
    assert main(["run", str(folder / "s.toml"), "--speeds", "0.1,0.3,1", "--out", str(folder / "out")]) == 0
    return folder


@pytest.mark.parametrize("width", [375, 680, 1200])  # px, of a phone, of A4 between its margins, and of a window
def test_it_opens_whole_and_runs_nothing(run, width):
    """In a frame of that width, because a window is at least 500 px wide."""
    page = (run / "out" / "report.html").read_text(encoding="utf-8")
    frame = f'<iframe srcdoc="{escape(page)}" style="width: {width}px; height: 9000px; border: 0"></iframe>'
    (run / "look.html").write_text(f'<meta charset="utf-8"><body>{frame}{LOOK}', encoding="utf-8")
    shown = browse(run, "--window-size=1300,900", "--dump-dom", (run / "look.html").as_uri()).stdout
    seen = json.loads(unescape(re.search(r'data-seen="(.*?)"', shown)[1]))
    assert seen["title"] == NAME and seen["head"].startswith(NAME)
    assert seen["drawn"] and seen["images"] == 3 and seen["width"] == width and seen["beyond"] <= 0
    parts = (
        "Answer|Uncertainty budget|Operating points|Warnings|Effects not modelled|Inputs|Pictures of the contact and"
    )
    parts += " the surface|Method and sources|Reproducibility"
    assert seen["sections"] == parts.split("|")
    assert seen["status"] == "Converged: all 3 speeds are solved."
    assert 'name="viewport"' in page and len(seen["folded"]) >= 2 and not any(seen["folded"])
    record = json.loads((run / "out" / "result.json").read_text())
    point = record["points"][1]
    low, high = point["uncertainty"]["interval"]
    numbers = map(float, re.findall(r"\d+\.\d+", seen["answer"])[:3])
    for number, exact in zip(numbers, (point["coefficient"], low, high)):
        assert number == pytest.approx(exact, abs=0.06 * (high - low))
    assert seen["answer"].endswith(" at 95 %) at U = 0.3 m/s.") and record["hash"] in page
    bars = [float(bar.removesuffix("%")) for bar in seen["bars"]]
    known = point["uncertainty"]
    of_sample = stdtrit(known["freedom"], 0.975) * known["sampling"]
    errors = [known["numerical"], of_sample, known["model"], known["inputs"]]
    assert seen["longest"] > 200  # px: on a phone it has a row of its own
    np.testing.assert_allclose(bars, [100 * error / max(errors) for error in errors], atol=0.06)


def test_inputs_stand_as_they_were_given_beside_the_values_used(tmp_path):
    scene = SCENE.replace("radius = 2e-3", 'radii = ["4 mm", "4 mm"]')
    (tmp_path / "s.toml").write_text(scene + SMALL_PATCH.replace("sq = 1e-7", 'ra = "80 nm"'))
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.3", "--out", str(tmp_path / "out")]) == 0
    page = unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    row = re.search(r"<tr>(?:(?!</tr>).)*root mean square height Sq.*?</tr>", page)[0]
    assert (
        "radii = [.4 mm., .4 mm.]" in page.replace(chr(39), ".")
        and "100.3 nm" in row
        and "derived" in row
        and "ra = '80 nm'" in page
    )


def test_it_prints_on_some_sheets(run):
    browse(run, "--no-pdf-header-footer", f"--print-to-pdf={run / 'out.pdf'}", (run / "out" / "report.html").as_uri())
    content = (run / "out.pdf").read_bytes()
    assert content.startswith(b"%PDF") and 2 <= len(re.findall(rb"/Type /Page\b", content)) <= 8
    boxes = {tuple(map(float, box.split())) for box in re.findall(rb"/MediaBox \[([^]]*)\]", content)}
    assert all(box[2:] == pytest.approx((595, 842), abs=1.5) for box in boxes)  # points: A4, upright


def test_the_record_has_units_and_a_date(run):
    record = json.loads((run / "out" / "result.json").read_text())
    assert re.fullmatch(r"20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC", record["date"])
    units = record["units"]
    assert (units["bodies.load"], units["speed"], units["central_film"], units["coefficient"]) == ("N", "m/s", "m", "-")
    numbers = [name for name, value in record["points"][0].items() if isinstance(value, float)]
    assert set(numbers) <= set(units)


def test_the_page_of_a_study_fits_a_phone(tmp_path):
    """Each row of its table is a list there, with the heading before every number."""
    (tmp_path / "s.toml").write_text(SCENE + SMALL_PATCH)
    (tmp_path / "p.csv").write_text("position [mm],load [N],speed [m/s]\n-1,3,0.1\n0,5,0.2\n1,4,0.3\n")
    out = tmp_path / "out"
    assert main(["study", str(tmp_path / "s.toml"), "--points", str(tmp_path / "p.csv"), "--out", str(out)]) == 0
    page = (out / "report.html").read_text(encoding="utf-8")
    frame = f'<iframe srcdoc="{escape(page)}" style="width: 375px; height: 9000px; border: 0"></iframe>'
    look = LOOK.replace(
        "beyond:", "tables: [...page.querySelectorAll('.scroll')].map(t => t.scrollWidth - t.clientWidth), beyond:"
    )
    (tmp_path / "look.html").write_text(f'<meta charset="utf-8"><body>{frame}{look}', encoding="utf-8")
    shown = browse(tmp_path, "--window-size=1300,900", "--dump-dom", (tmp_path / "look.html").as_uri()).stdout
    seen = json.loads(unescape(re.search(r'data-seen="(.*?)"', shown)[1]))
    assert seen["beyond"] <= 0 and seen["tables"] and max(seen["tables"]) <= 0
    assert seen["status"] == "Converged: all 3 points are solved." and 'data-label="total load [N]"' in page


def test_the_method_is_what_was_solved_and_the_seeds_are_distinguished(run):
    page = (run / "out" / "report.html").read_text(encoding="utf-8")
    method = page.partition("<h2>Method and sources</h2>")[2]
    solved, _, estimate = method.partition("Estimate before the solve")
    assert "At U = 0.3 m/s: film: " in unescape(solved) and "target of the numerical error of f" not in solved
    assert "target of the numerical error of f" in estimate
    assert "seed of the scene (surface.seed), from which those of the strips follow" in page


def test_a_status_states_what_misses_its_target_and_what_has_no_interval():
    assert shortfalls(0, 0, 3) == []
    inexact, unknown = shortfalls(2, 3, 3)
    assert inexact.startswith("At 2 of 3 points the numerical error of f is above the requested tolerance")
    assert "in its interval" not in inexact and "in its interval" in shortfalls(2, 0, 3)[0]
    assert unknown == "At 3 of 3 points the interval of f is not known."
    assert shortfalls(0, 1, 1) == ["There the interval of f is not known."]
