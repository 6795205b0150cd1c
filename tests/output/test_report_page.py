"""report.html in a real browser: it fits a phone, a window and a sheet of paper, its pictures are there, and no word of
a user runs as a script."""

import csv
import json
import re
import shutil
import subprocess
from dataclasses import replace
from html import escape, unescape

import numpy as np
import pytest
from pictures import put_back
from scene_text import BODIES_AND_OIL, SMALL_PATCH
from scipy.special import stdtrit

import lubfric
from lubfric.estimate import Uncertainty, roughness_to_quote
from lubfric.models.shared import checks, violations_by_model_error
from lubfric.output import main, orders_of_magnitude
from lubfric.output.history_table import evenly_by_change
from lubfric.output.inputs_as_given import inputs_as_given
from lubfric.output.missed_tolerances import MissedTolerance, missed_tolerances
from lubfric.output.status import shortfalls
from lubfric.scene import Table, Transient

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
OPTIONS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]
NAME = "<script>document.title = 'ran'</script> R&D"
SCENE = f"name = {json.dumps(NAME)}\n" + BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n"
MOTION = "[transient]\nduration = 1e-3\noutputs = 4\n"
MOTION += 'speed = { kind = "harmonic", mean = 0.2, amplitude = 0.1, frequency = 1000.0 }\n'
FILES = {
    "s.toml": SCENE + SMALL_PATCH,
    "deterministic.toml": SCENE + SMALL_PATCH.replace('"paper"', '"deterministic"'),
    "history.toml": SCENE + SMALL_PATCH + MOTION,
    "p.csv": "position [mm],load [N],speed [m/s]\n-1,3,0.1\n0,5,0.2\n1,4,0.3\n",
    "rig.csv": "U [m/s],mu\n0.1,0.0312\n0.3,0.0519\n1,0.0945\n3,0.162\n",
}
FITTED = ["lubricant.viscosity=0.05:1", "lubricant.limiting_stress_coefficient=0.05:0.2"]
COMMANDS = {
    "run": ["run", "s.toml", "--speeds", "0.1,0.3,1"],
    "deterministic": ["run", "deterministic.toml", "--speeds", "0.05"],
    "history": ["run", "history.toml"],
    "study": ["study", "s.toml", "--points", "p.csv"],
    "fit": "fit s.toml --measured rig.csv --coefficient mu --starts 0 --speed".split()
    + ["U [m/s]", *(word for parameter in FITTED for word in ("--parameter", parameter))],
}
PICTURES = {"run": 3, "deterministic": 3, "history": 2, "study": 1, "fit": 1}
WIDTHS = {"phone": 375, "tablet": 680, "window": 1200, "paper": 680}  # px; A4 has 680 between its margins
LOOK = """<script>window.onload = () => {
  const look = frame => {
    const page = frame.contentDocument, wide = page.documentElement, details = [...page.querySelectorAll("details")];
    const images = [...page.images], texts = name => [...page.querySelectorAll(name)].map(h => h.textContent);
    const folded = details.map(d => d.open);
    details.forEach(d => d.open = true);
    return {
      title: page.title, head: texts("h1")[0], sections: texts("h2"), status: texts(".status")[0],
      drawn: images.every(i => i.complete && i.naturalWidth > 300), images: images.length,
      beyond: wide.scrollWidth - wide.clientWidth, width: wide.clientWidth, answer: texts(".answer")[0], folded: folded,
      tables: [...page.querySelectorAll(".scroll")].map(t => t.scrollWidth - t.clientWidth),
      overhang: [...page.querySelectorAll(".scroll")].map(
        t => t.getBoundingClientRect().right - page.querySelector("h2").getBoundingClientRect().right),
      longest: Math.max(...[...page.querySelectorAll(".budget i")].map(i => i.offsetWidth)),
      bars: [...page.querySelectorAll(".budget i")].map(i => i.style.width)}};
  document.body.dataset.seen = JSON.stringify([...document.querySelectorAll("iframe")].map(look))}</script></body>"""
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no browser")


def browse(folder, *options):
    data = f"--user-data-dir={folder / 'browser'}"
    return subprocess.run([BROWSER, *OPTIONS, data, *options], capture_output=True, text=True, timeout=60, check=True)


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory):
    """The folder of a command of `COMMANDS`, carried out once, with its pictures."""
    folders = {}

    def carried_out(kind):
        if kind not in folders:
            folder = tmp_path_factory.mktemp(kind)
            for name, content in FILES.items():
                (folder / name).write_text(content)
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                put_back(patch.setattr)
                assert main([*COMMANDS[kind], "--out", "out"]) == 0
            folders[kind] = folder
        return folders[kind]

    return carried_out


@pytest.fixture(scope="module")
def run(folder_of):
    return folder_of("run")


def frames_of(folder):
    """Return frames of `WIDTHS` around the report in ``folder``."""
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    printed = page.replace("@media print", "@media all").replace("@media screen and", "@media print and")
    pages = {name: printed if name == "paper" else page for name in WIDTHS}
    style = "height: 20000px; border: 0"  # all of a page without a bar to scroll
    return [
        f'<iframe srcdoc="{escape(pages[name])}" style="width: {px}px; {style}"></iframe>'
        for name, px in WIDTHS.items()
    ]


@pytest.fixture(scope="module")
def looks(folder_of, tmp_path_factory):
    """What is seen of the report of each command in frames of `WIDTHS`, by their names, in one start of the browser: a
    window is at least 500 px wide."""
    folder = tmp_path_factory.mktemp("looks")
    frames = [frame for kind in COMMANDS for frame in frames_of(folder_of(kind))]
    (folder / "look.html").write_text(f'<meta charset="utf-8"><body>{"".join(frames)}{LOOK}', encoding="utf-8")
    shown = browse(folder, "--window-size=1300,900", "--dump-dom", (folder / "look.html").as_uri()).stdout
    seen = iter(json.loads(unescape(re.search(r'data-seen="(.*?)"', shown)[1])))
    return {kind: {name: next(seen) for name in WIDTHS} for kind in COMMANDS}


@pytest.mark.parametrize("kind", COMMANDS)
def test_every_report_fits_a_phone_a_window_and_paper(looks, kind):
    """Nothing is wider than its page, and no table than the text in a phone, a window or on a sheet; a tablet scrolls a
    table by itself."""
    for name, seen in looks[kind].items():
        assert seen["title"] == NAME and seen["head"].startswith(NAME) and seen["status"].startswith("Converged: ")
        assert seen["drawn"] and seen["images"] == PICTURES[kind]
        assert seen["width"] == WIDTHS[name] and seen["beyond"] <= 0 and len(seen["tables"]) > 5
        assert name == "tablet" or max(seen["tables"]) <= 0
        assert max(seen["overhang"]) <= 0.5


def test_a_report_opens_whole_and_runs_nothing(run, looks):
    page = (run / "out" / "report.html").read_text(encoding="utf-8")
    record = json.loads((run / "out" / "result.json").read_text())
    point = record["points"][1]
    known = point["uncertainty"]
    low, high = known["interval"]
    of_sample = stdtrit(known["freedom"], 0.975) * known["sampling"]
    errors = [known["numerical"], of_sample, known["model"], known["inputs"]]
    parts = (
        "Answer|Uncertainty budget|Operating points|Warnings|Effects not modelled|Inputs|Pictures of the contact and"
    )
    parts += " the surface|Method and sources|Reproducibility"
    assert 'name="viewport"' in page and record["hash"] in page
    for seen in looks["run"].values():
        assert seen["title"] == NAME and seen["sections"] == parts.split("|")
        assert seen["status"].startswith("Converged: all 3 speeds are solved.")
        assert len(seen["folded"]) >= 2 and not any(seen["folded"])
        numbers = map(float, re.findall(r"\d+\.\d+", seen["answer"])[:3])
        for number, exact in zip(numbers, (point["coefficient"], low, high)):
            assert number == pytest.approx(exact, abs=0.06 * (high - low))
        assert seen["answer"].endswith(" at 95 %) at U = 0.3 m/s, the operating point of the scene.")
        bars = [float(bar.removesuffix("%")) for bar in seen["bars"]]
        assert seen["longest"] > 200  # px: on a phone it has a row of its own
        np.testing.assert_allclose(bars, [100 * error / max(errors) for error in errors], atol=0.06)


def test_inputs_stand_as_they_were_given_beside_the_values_used(tmp_path):
    scene = SCENE.replace("radius = 2e-3", 'radii = ["4 mm", "4 mm"]')
    (tmp_path / "s.toml").write_text(scene + SMALL_PATCH.replace("sq = 1e-7", 'ra = "80 nm"'))
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.3", "--out", str(tmp_path / "out")]) == 0
    page = unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    row = re.search(r"<tr>(?:(?!</tr>).)*root mean square height Sq.*?</tr>", page)[0]
    assert 'radii = ["4 mm", "4 mm"]' in page and 'ra = "80 nm"' in page
    assert "100.3 nm" in row and "derived" in row


def test_a_history_stands_as_it_was_given_beside_its_range():
    """A duty cycle in full, and a sliding speed, which the scene has in its [transient]."""
    cycle = {"kind": "table", "times": [0.0, 0.01, 0.02], "values": [1.0, -2.0, 1.0], "repeat": True}
    motion = {"entrainment_speed": 1.0, "sliding_speed": cycle}
    plan = Transient(0.02, outputs=3, speed=1.0, sliding=Table(times=(0.0, 0.01, 0.02), values=(1.0, -2.0, 1.0)))
    scene = lubfric.load_scene("paper").with_(transient=plan)
    (row,) = re.findall(r"<tr>(?:(?!</tr>).)*sliding speed.*?</tr>", unescape(inputs_as_given(scene, "motion", motion)))
    assert "-2 to 1 m/s" in row
    assert 'kind = "table", times = [0.0, 0.01, 0.02], values = [1.0, -2.0, 1.0], repeat = true' in row


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.slow] * (kind not in ("run", "history"))) for kind in COMMANDS]
)
def test_every_report_prints_on_some_sheets(folder_of, kind):
    folder = folder_of(kind)
    report = (folder / "out" / "report.html").as_uri()
    browse(folder, "--no-pdf-header-footer", f"--print-to-pdf={folder / 'out.pdf'}", report)
    content = (folder / "out.pdf").read_bytes()
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


def test_a_row_of_a_table_has_the_heading_of_every_number(folder_of):
    """A phone shows it as a list. Headings are over their numbers, at the right."""
    page = (folder_of("study") / "out" / "report.html").read_text(encoding="utf-8")
    assert "Converged: all 3 points are solved." in page and 'data-label="total load [N]"' in page
    assert '<th class="number">total load [N]</th>' in page and "<th>recommendation</th>" in page


def test_a_failed_point_of_a_study_has_its_whole_reason_in_the_table(tmp_path):
    """It was cut within a number: the limit of 2000 came out as 20."""
    (tmp_path / "s.toml").write_text(SCENE + SMALL_PATCH)
    (tmp_path / "p.csv").write_text("load [N],speed [m/s]\n3,0.1\n5,2000\n")
    command = ["study", str(tmp_path / "s.toml"), "--points", str(tmp_path / "p.csv"), "--out", str(tmp_path / "out")]
    assert main(command) == 1
    record = (tmp_path / "out" / "study.csv").read_text(encoding="utf-8")
    (reason,) = re.findall("ValidityError: .*?marked[.]", record)
    page = unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    rows = re.findall(r"<tr>.*?</tr>", page.partition("<h2>Operating points</h2>")[2].partition("<details>")[0])
    heads, solved, failed = (re.findall(r"<t[hd]", row) for row in rows)
    columns, shown = re.search(
        r'<td data-label="friction coefficient" colspan="(\d)"[^>]*>(.*?)</td>', rows[2]
    ).groups()
    assert shown == reason and len(heads) == len(solved) == len(failed) - 1 + int(columns) > len(failed)
    assert f"1 of 2 points solved. Failures: 1 x {reason}</p>" in page


def test_the_method_is_what_was_solved_and_the_seeds_are_distinguished(run):
    page = (run / "out" / "report.html").read_text(encoding="utf-8")
    method = page.partition("<h2>Method and sources</h2>")[2]
    solved, _, estimate = method.partition("Estimate before the solve")
    assert "At U = 0.3 m/s: film: " in unescape(solved) and "target of the numerical error of f" not in solved
    assert "target of the numerical error of f" in estimate
    assert "seed of the scene (surface.seed), from which those of the strips follow" in page


@pytest.mark.parametrize("command", ["run", "study"])
@pytest.mark.parametrize("is_large", [True, False])
def test_a_status_over_a_large_numerical_error_has_its_own_colour_and_does_not_begin_with_converged(
    tmp_path, monkeypatch, command, is_large
):
    """Here a large one is above any error or above none; none of them makes f an order of magnitude."""
    monkeypatch.setattr(checks, "LARGE_NUMERICAL_ERROR", 0.0 if is_large else 1.0)
    (tmp_path / "s.toml").write_text(
        re.sub("\ntolerance = .*", "\ntolerance = 1e-4\nfilm_tolerance = 0.03", SCENE + SMALL_PATCH)
    )
    (tmp_path / "p.csv").write_text("load [N],speed [m/s]\n3,0.1\n5,0.2\n")
    options = {"run": ["--speeds", "0.1,0.2"], "study": ["--points", str(tmp_path / "p.csv")]}[command]
    assert main([command, str(tmp_path / "s.toml"), *options, "--out", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    ((kind, text),) = re.findall(r'<p class="status (\w*)" role="status">(.*?)</p>', page)
    assert kind == "inexact" and "numerics.tolerance" in text
    assert text.startswith("All 2" if is_large else "Converged: all 2") and "order of magnitude" not in text
    assert ".status.inexact" in page


def test_f_is_an_order_of_magnitude_from_a_numerical_error_of_half_of_it():
    assert orders_of_magnitude([0.01, 0.22, 0.49]) == []
    (text,) = orders_of_magnitude([0.01, 0.22, 0.6])
    assert text.startswith(
        "At 1 of 3 points the numerical error of f is above 50 %, so f is only an order of magnitude"
    )


def test_a_status_states_what_misses_its_target_and_what_has_no_interval():
    def place(row):
        return f"at U = {row} m/s"

    missed = MissedTolerance(
        error="numerical error of f", tolerance="numerics.tolerance", points=(0, 2), worst=2, value=0.02, limit=0.01
    )
    assert shortfalls([], 0, 3, place) == []
    (inexact, unknown) = shortfalls([missed], 3, 3, place)
    assert inexact == (
        "At 2 of 3 points the numerical error of f is above its tolerance, farthest at U = 2 m/s: 2 %, above 1 % "
        "(numerics.tolerance)."
    )
    assert unknown == "At 3 of 3 points the interval of f is not known."
    assert shortfalls([missed], 0, 3, place)[1] == "The interval of f includes this error."
    assert shortfalls([], 1, 1, place) == ["The interval of f is not known."]
    alone = MissedTolerance(error="e", tolerance="k", points=(0,), worst=0, value=0.0104, limit=0.01)
    assert shortfalls([alone], 1, 1, place)[0] == "The e is 1.04 %, above 1 % (k)."
    assert shortfalls([alone], 1, 2, place)[0] == "At U = 0 m/s the e is 1.04 %, above 1 % (k)."
    assert replace(missed, notes=1).in_words(3, place) == (
        "At 2 of 3 points the numerical error of f is above its tolerance, farthest at U = 2 m/s: 2 %, above 1 % "
        "(numerics.tolerance). At 1 of these it is a note, because the error is usual for the model, or the scene names "
        "the model."
    )


def test_no_relative_error_of_an_f_near_zero_misses_a_tolerance():
    """As at a slide-roll ratio of 0, where f is the small remainder of what its sample adds."""
    scene = lubfric.load_scene("paper")
    columns = {
        "coefficient": np.array([-8e-6, 0.05]),
        "sampling_error": np.array([93.0, 0.05]),
        "sampling_freedom": np.array([10.0, 10.0]),
    }
    (missed,) = missed_tolerances(columns, [scene, scene])
    assert missed.points == (1,) and missed.value == pytest.approx(2.228 * 0.05, rel=1e-3)


def test_status_and_warnings_count_the_same_model_form_errors():
    """Of points with f of 0.05, of 0.0047 with an error above it, and of 0.0047 with a smaller one."""
    scene = lubfric.load_scene("paper")
    f = np.array([0.05, 0.05, 4.7e-3, 4.7e-3, 0.05])
    error = np.array([0.2, 0.3, 1.2, 0.9, 0.01])
    tolerance = scene.numerics.model_tolerance
    pairs = zip(error.tolist(), f.tolist())
    made = [violations_by_model_error(e, tolerance=tolerance, f=each, has_interval=True) for e, each in pairs]
    (missed,) = missed_tolerances({"coefficient": f, "model_error": error}, [scene] * 5)
    assert len(missed.points) + missed.uncounted == sum(bool([*each]) for each in made) == 4
    text = missed.in_words(5, lambda row: f"at point {row + 1}")
    assert text.startswith("At 3 of 5 points") and "state it at 1 more point, where f is below 0.005" in text


def test_status_and_notes_count_the_same_sampling_errors():
    """f is near 0 at the second point by its model-form error, so its sampling error does not count relative to f."""
    scene = lubfric.load_scene("paper")
    model = np.array([0.01, 11.0])
    columns = {
        "coefficient": np.array([0.05, 0.002]),
        "sampling_error": np.array([0.06, 0.26]),
        "sampling_freedom": np.array([30.0, 30.0]),
    }
    missed = {each.assumption: each.points for each in missed_tolerances(columns | {"model_error": model}, [scene] * 2)}
    tolerance = scene.numerics.sampling_tolerance
    point = Uncertainty(coefficient=0.002, model=11.0, sampling=0.26, freedom=30.0, tolerance=tolerance)
    assert missed[checks.Assumption.SAMPLING_ERROR] == (0,) and not point.misses_sampling_tolerance
    assert replace(point, model=0.01).misses_sampling_tolerance
    assert [each.points for each in missed_tolerances(columns, [scene] * 2)] == [(0, 1)]


def test_a_documented_default_is_a_default_beside_short_forms(tmp_path):
    """As the limit at ambient pressure and the conductivity of an oil by its grade, whose viscosity is derived."""
    given = {"grade": "ISO VG 46", "viscosity_index": 95, "temperature": "40 °C", "limiting_stress_coefficient": 0.05}
    scene = lubfric.load_scene("paper").with_(lubricant={**given, "viscosity": None})
    rows = re.findall(r"<tr>(.*?)</tr>", inputs_as_given(scene, "lubricant", given))
    sources = {
        re.search(r">([^<]*)</td>", row)[1]: re.findall(r">([^<]*)</td>", row)[-1] for row in rows if "<td" in row
    }
    assert (
        sources["limiting shear stress at ambient pressure"] == sources["thermal conductivity of the film"] == "default"
    )
    assert sources["viscosity at ambient pressure"] == "derived"


def test_sq_of_a_plateau_honed_surface_is_derived_and_nominal():
    given = {"sk": "0.6 µm", "spk": "0.15 µm", "svk": "1.5 µm", "correlation_length": "15 µm"}
    scene = lubfric.load_scene("paper").with_(surface=given)
    (row,) = (each for each in inputs_as_given(scene, "surface", given).split("<tr>") if "Sq" in each)
    assert "derived from sk, spk, svk (nominal" in row and "default" not in row
    assert any(text.startswith("nominal Sq ") for text in roughness_to_quote(scene))
    assert any(text.startswith("Sq ") for text in roughness_to_quote(lubfric.load_scene("paper")))


def test_the_table_of_a_run_has_rows_where_it_changes():
    """A run that rests for nine tenths of its outputs: no row repeats the others but the ends."""
    columns = {name: np.zeros(200) for name in ("entrainment_speed", "sliding_speed", "load", "coefficient")}
    columns["time"] = np.arange(200.0)
    columns["load"][100:120] = np.arange(20)
    columns["load"][120:] = 19.0
    picked = evenly_by_change(columns, 11)
    assert picked[0] == 0 and picked[-1] == 199 and all(100 < index <= 119 for index in picked[1:-1])
    assert np.ptp(np.diff(columns["load"][picked[:-1]])) <= 1.0


def test_a_run_has_no_friction_force_at_a_standstill_and_states_the_largest_one(tmp_path):
    """At 0 and 0.5 ms the speed changes its sign, but for rounding; the energy is the integral of the power."""
    motion = MOTION.replace("mean = 0.2", "mean = 0.0").replace("outputs = 4", "outputs = 8")
    (tmp_path / "s.toml").write_text(SCENE + SMALL_PATCH + motion)
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) == 0
    (heads, *rows) = csv.reader((tmp_path / "out" / "history.csv").read_text().splitlines())
    columns = {head.partition(" [")[0]: [row[i] for row in rows] for i, head in enumerate(heads)}
    for name in ("coefficient", "friction_force", "boundary_force"):
        assert [cell == "" for cell in columns[name]] == [abs(float(u)) < 1e-9 for u in columns["entrainment_speed"]]
        assert "" in columns[name]
    page = unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    force = max(abs(float(cell)) for cell in columns["friction_force"] if cell)
    assert float(re.search(r"largest friction force against the sliding is ([\d.]+) (m?)N", page)[1]) == pytest.approx(
        force, rel=0.03
    )
    energy = np.trapezoid(np.array(columns["power_loss"], float), np.array(columns["time"], float))
    assert float(re.search(r"Friction takes ([\d.]+) µJ in 1 ms", page)[1]) == pytest.approx(1e6 * energy, rel=0.03)
