"""The campaigns: what is kept is not solved again, their judges fail what is wrong, and points come out sane."""

import json
import time
from importlib import import_module

import numpy as np
import pytest

from verification import kept
from verification.__main__ import main
from verification.campaigns import constants, opponents, table_file
from verification.campaigns.charts import contact
from verification.campaigns.charts.measure import machine
from verification.campaigns.model import answers
from verification.campaigns.sampling import coverage
from verification.check import Check
from verification.kept import Run

NAN = float("nan")


def test_a_line_that_was_not_written_to_its_end_is_written_again(tmp_path):
    solved = []

    def solve(case):
        solved.append(case)
        return [case, NAN]

    assert [row for _, row in Run(tmp_path).solved({"a": 1, "b": 2}, solve)] == [[1, None], [2, None]]
    (file,) = tmp_path.rglob("rows.jsonl")
    file.write_text(file.read_text()[:-3])
    assert [row for _, row in Run(tmp_path).solved({"a": 1, "b": 2, "c": 3}, solve)][-1] == [3, None]
    assert solved == [1, 2, 2, 3] and len(kept.rows_of(file)) == 3


def test_a_row_is_kept_as_soon_as_it_is_solved_whatever_comes_before_it(tmp_path):
    with pytest.raises(ZeroDivisionError):
        list(Run(tmp_path, workers=2).solved({"a": (0, tmp_path), "b": (2, tmp_path)}, inverse))
    (file,) = tmp_path.rglob("rows.jsonl")
    assert kept.rows_of(file) == {"b": 0.5}


def inverse(number_and_folder):
    """1/number; of 0 when something is kept in the folder."""
    number, folder = number_and_folder
    until = time.monotonic() + 600
    while not (number or any(file.stat().st_size for file in folder.rglob("*.jsonl"))) and time.monotonic() < until:
        time.sleep(0.05)
    return 1 / number


def test_a_campaign_judges_what_lies_in_the_folder_and_puts_its_table(tmp_path):
    folder = tmp_path / "kept-quick" / kept.code()
    folder.mkdir(parents=True)
    rows = [[f"{case.name}, 7", [F, 1e-4]] for case in coverage.SPEEDS]
    (folder / "truths.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    rows = [[f"{c.name}, {7 + k}", row] for c in coverage.SPEEDS for k, row in enumerate(trials(seed=5)[:16])]
    (folder / "coverage.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    page = tmp_path / "page.md"
    page.write_text("<!-- table: sampling-coverage -->\n<!-- end of table -->\n")
    (tmp_path / "images").mkdir()
    for name in ("coverage", "sampling-coverage"):
        (tmp_path / "images" / f"{name}.png").write_bytes(b"old")
    requested = ["--quick", "--only", "coverage", "--seed", "7", "--out", str(tmp_path), "--docs", str(tmp_path)]
    assert main(["sampling", *requested]) == 0
    text = page.read_text()
    assert text.count("| 16 |") == 4 and "sampling --quick --only coverage`" in text
    pictures = {file.name: file.read_bytes() for file in (tmp_path / "images").iterdir()}
    assert pictures.pop("coverage.png") == b"old" and pictures["sampling-coverage.png"].startswith(b"\x89PNG")
    assert len(pictures) == 1
    assert (tmp_path / "coverage.png").stat().st_size > 1000


F = 0.05


def trials(stated=0.02, scatter=0.02, bias=0.0, *, few=False, seed=3):
    """Rows of 400 trials whose f is normal about (1 + bias) times the truth."""
    drawn = F * (1 + bias + scatter * np.random.default_rng(seed).standard_normal(400))
    shared = {"sampling": stated, "length": 1e-3, "seconds": 0.1, "few": few}
    return [shared | {"f": f, "low": f - 1.96 * stated * F, "high": f + 1.96 * stated * F} for f in drawn]


def verdicts(**options):
    result = coverage.Result(coverage.CoverageCase(name="made up"), trials(**options), F, 1e-4)
    return {c.name.split(": ")[1]: c for c in coverage.checks(result)}


def test_an_honest_interval_passes():
    result = verdicts()
    assert all(c.passed and c.decisive for c in result.values())
    assert result["coverage"].measured == pytest.approx(0.95, abs=0.03)
    assert result["reported over scatter"].measured == pytest.approx(1.0, abs=0.1)


def test_the_interval_of_a_trial_omits_the_error_of_the_model_alone():
    result = coverage.trial((coverage.SPEEDS[1], 5))
    half = (result["high"] - result["low"]) / (2 * result["f"])
    sampling = result["sampling"]
    assert 1.96 * sampling < half < 2.3 * sampling and result["high"] - result["f"] == pytest.approx(half * result["f"])


@pytest.mark.parametrize(
    ("options", "failing"),
    [
        ({"stated": 0.01}, {"coverage", "reported over scatter"}),
        ({"stated": 0.04}, {"reported over scatter"}),
        ({"bias": 0.012}, {"bias of f", "coverage"}),
    ],
)
def test_an_interval_too_short_too_long_or_off_fails(options, failing):
    assert {name for name, c in verdicts(**options).items() if c.failed} == failing


def test_a_map_that_says_that_it_is_too_small_does_not_fail_by_its_coverage():
    result = verdicts(stated=0.01, few=True)
    assert not result["coverage"].passed and not result["coverage"].failed


@pytest.mark.parametrize(("off", "covered"), [(0.02, True), (0.2, False)])
def test_answers_beside_finer_strips_fail_where_their_intervals_miss_f(monkeypatch, off, covered):
    truth = {"f": 0.1, "half": 0.02, "error": 0.01}
    f = 0.1 + 0.1 * off
    row = {"f": f, "low": f - 0.005, "high": f + 0.005, "error": 0.01}
    monkeypatch.setattr(answers, "reference", lambda case: truth)
    monkeypatch.setattr(answers, "answer", lambda case: dict.fromkeys(answers.WAYS, row))
    checks = [item for item in answers.answers("quick") if isinstance(item, Check)]
    assert [check.passed for check in checks if "intervals" in check.name] == [covered, covered]


@pytest.mark.parametrize("kind", answers.MEASURED)
def test_a_drawn_map_has_the_skewness_of_its_kind(kind):
    z = answers.heights(kind, 3)
    skewness = float(np.mean(z**3))
    assert z.std() == pytest.approx(1.0) and abs(z.mean()) < 1e-9
    expected = {"plateau": (-2.0, -0.7), "peaks": (0.7, 2.0)}.get(kind, (-0.4, 0.4))
    assert expected[0] < skewness < expected[1]


def test_methods_agree_and_errors_fall_with_the_tolerance():
    rows = contact.panel("test", "exponential", 64, 200e6, "periodic", (1e-3, 1e-6), 1)
    result = [Check.from_dict(values) for values in rows]
    ours = [p.measured for p in result if p.at["method"] == "lubfric"]
    assert ours[1] < 1e-5 < 1e-2 and ours[1] < ours[0] < 0.1
    tight = {p.at["method"]: p.measured for p in result if p.at["setting"] == "tolerance 1e-06"}
    assert set(tight) >= {"lubfric", "plain Polonsky-Keer", "paper, single loop", "paper, alternating"}
    assert max(tight.values()) < 1e-3
    assert [p.at["setting"] for p in result if p.at["default"]] == ["tolerance 1e-06"]
    assert np.array_equal(contact.heights(128, "gaussian")[::2, ::2], contact.heights(64, "gaussian"))


def test_a_chart_says_which_solvers_of_others_are_missing(monkeypatch):
    monkeypatch.setattr(opponents, "version", lambda package: "2.9.0" if package == "tamaas" else "")
    assert "tamaas 2.9.0, aspher not installed" in machine()


def test_the_table_of_constants_is_of_the_values_of_today():
    """A constant that changed is measured again: its rows are removed, and the command appends them."""
    rows = table_file.rows(constants.TABLE)
    now = [getattr(import_module(f"lubfric.{row['module']}"), row["constant"], None) for row in rows]
    assert [row["constant"] for row, value in zip(rows, now) if row["value"] != str(value)] == []
    assert len(rows) > 200
