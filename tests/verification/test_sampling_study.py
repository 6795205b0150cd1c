"""The study of the sampling: its verdict on trials of known distribution, what it keeps, and its pictures."""

import json

import numpy as np
import pytest

import lubfric
from verification import kept, sampling
from verification.sampling import charts, cost, lengths, measure, pieces, verdict
from verification.sampling.cases import SPEEDS, Case
from verification.tables import folders as tables

CASE = Case("made up", 0.01)
SIZE, F = 400, 0.05


def trials(told_error=0.02, true_error=0.02, bias=0.0, told=False, seed=3):
    """Rows of trials whose f is normal about (1 + bias) times the truth."""
    drawn = F * (1 + bias + true_error * np.random.default_rng(seed).standard_normal(SIZE))
    return [
        {"kind": "trial", "seed": k, "f": f, "sampling": told_error, "low": f - 1.96 * told_error * F}
        | {"high": f + 1.96 * told_error * F, "length": 1e-3, "seconds": 0.1, "told": told}
        for k, f in enumerate(drawn)
    ]


def verdicts(**options):
    return {c.name.split(": ")[1]: c for c in verdict.checks(measure.Result(CASE, trials(**options), F, 1e-4))}


def test_an_honest_interval_passes():
    found = verdicts()
    assert all(c.passed and c.decisive for c in found.values())
    assert found["coverage"].measured == pytest.approx(0.95, abs=0.03)
    assert found["reported over scatter"].measured == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(
    ("options", "failing"),
    [
        ({"told_error": 0.01}, {"coverage", "reported over scatter"}),
        ({"told_error": 0.04}, {"reported over scatter"}),
        ({"bias": 0.012}, {"bias of f", "coverage"}),
    ],
)
def test_an_interval_too_short_too_long_or_off_fails(options, failing):
    assert {name for name, c in verdicts(**options).items() if c.failed} == failing


def test_a_map_that_says_that_it_is_too_small_does_not_fail_by_its_coverage():
    found = verdicts(told_error=0.01, told=True)
    assert not found["coverage"].passed and not found["coverage"].failed


def test_pieces_and_other_numbers():
    row = {"low": 0.9, "high": 1.1, "whole": 1.0}
    assert verdict.of_pieces([row] * 95 + [row | {"whole": 2.0}] * 5).passed
    assert verdict.of_pieces([row] * 60 + [row | {"whole": 2.0}] * 40).failed
    good, bad = verdict.of_quantities([("film_load", 100, 0.95, 0.01), ("mean_gap", 100, 0.8, 0.01)])
    assert good.passed and bad.failed and "mean_gap" in bad.name


def test_what_is_kept_is_not_solved_again(tmp_path, monkeypatch):
    monkeypatch.setattr(measure, "truth", None)
    monkeypatch.setattr(measure, "solve", None)
    truth = {"kind": "truth", "seed": measure.REPORTED, "f": F, "error": 1e-4}
    file = tmp_path / "made-up-0.jsonl"
    file.write_text("\n".join(json.dumps(r) for r in [*trials(), truth]) + "\n")
    kept.adopt(file)
    found = measure.run(CASE, SIZE, 0, tmp_path)
    assert found.truth == F and len(found.rows) == SIZE
    with pytest.raises(TypeError):
        measure.run(CASE, SIZE + 1, 0, tmp_path)


def test_a_map_is_cut_into_its_pieces_and_those_kept_are_not_solved_again(tmp_path, monkeypatch):
    seen = []

    def solve(scene, speed, asked):
        seen.append(np.load(scene.surface.file))
        return {"f": float(len(seen)), "low": 0.0, "high": 1.0}

    monkeypatch.setattr(pieces, "solve", solve)
    surface = lubfric.generate_surface((24, 36), 1e-6, sq=1e-7, correlation_length=2e-6, seed=3)
    np.save(tmp_path / "map.npy", surface.heights)
    scene = lubfric.load_scene("paper").with_(surface={"file": str(tmp_path / "map.npy"), "spacing": 1e-6, "unit": "m"})
    rows = pieces.measured(scene, (2, 3), tmp_path)
    assert [row["whole"] for row in rows] == [1.0] * 6 and [row["f"] for row in rows] == [2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    assert np.array_equal(np.block([seen[1:4], seen[4:]]), seen[0])
    monkeypatch.setattr(pieces, "solve", None)
    assert pieces.measured(scene, (2, 3), tmp_path) == rows


def test_the_command_reports_what_is_kept_and_the_table_of_the_page_reads_it(tmp_path, monkeypatch, capsys):
    for case in SPEEDS:
        truth = {"kind": "truth", "seed": 7 + measure.REPORTED, "f": F, "error": 1e-4}
        rows = [row | {"seed": 7 + row["seed"]} for row in trials(seed=5)[:16]]
        file = measure._file(case, 7, tmp_path)
        file.write_text("\n".join(json.dumps(r) for r in [*rows, truth]) + "\n")
    assert sampling.main(["--quick", "--seed", "7", "--go-on", "--out", str(tmp_path)]) == 0
    assert "12 of 12 checks passed" in capsys.readouterr().out
    assert (tmp_path / "coverage.png").stat().st_size > 1000
    monkeypatch.setattr(tables, "SAMPLING", tmp_path)
    monkeypatch.setattr(tables.cases, "SEED", 7)
    columns, rows = tables.coverage()
    assert len(rows) == len(SPEEDS) and all(len(row) == len(columns) for row in rows)


def test_charts_and_what_they_tell():
    rows = np.array([[1e-4, 0.051, 0.003, 8], [1e-3, 0.0502, 0.001, 8]])
    assert charts.bias({0.01: (rows, F)}).name == "bias"
    assert [c.measured for c in lengths.checks({0.01: (rows, F)})] == pytest.approx([0.02, 0.004])
    times = {"0.01 m/s": np.array([[0.05, 0.1, 0.04], [0.01, 0.9, 0.012]])}
    assert charts.cost(times).name == "cost"
    assert [c.measured for c in cost.checks(times)] == [0.04, 0.012]
