"""Answers where the roughness moves, beside the mean of the others."""

import pytest

from verification.campaigns.model import answers_moving
from verification.check import Check, Table


def ways(f, half=0.003, by="deterministic"):
    row = {"f": f, "low": f - half, "high": f + half, "by": by, "error": 0.01, "seconds": 1.0}
    return {"default": row, "load sharing": row}


def judged(monkeypatch, rows, change=0.0):
    """Checks and table of one case with these answers."""
    monkeypatch.setattr(answers_moving, "answer", lambda case: rows[case[1] - 1])
    monkeypatch.setattr(answers_moving, "change", lambda case: change)
    monkeypatch.setattr(answers_moving, "SEEDS", {"quick": len(rows)})
    items = list(answers_moving.answers_moving("quick"))
    return [one for one in items if isinstance(one, Check)], next(one for one in items if isinstance(one, Table))


@pytest.mark.parametrize(("half", "inside"), [(0.003, 1.0), (0.0003, 29 / 30)])
def test_an_interval_that_misses_the_others_does_not_hold_f(monkeypatch, half, inside):
    checks, _ = judged(monkeypatch, [ways(0.1 + 0.002 * (k == 7), half) for k in range(30)])
    assert checks[0].measured == pytest.approx(inside) and checks[-1].measured == 0


def test_answers_are_held_beside_the_others_on_shorter_cells(monkeypatch):
    rows = [ways(0.1), ways(0.1), ways(0.1), ways(0.3, by="load sharing"), {"default": {"failure": "no"}}]
    checks, table = judged(monkeypatch, rows, change=0.02)
    assert checks[-1].measured == 2 and list(table.rows[-1][1:3]) == ["3", "2.0 %"]


def test_roughness_moves_faster_and_slower_than_the_film():
    scene = answers_moving.cases("quick")[0].scene(3, "")
    assert scene.surface.seed == 3 and scene.motion.slide_roll_ratio == -1.0
    assert {case.slip for case in answers_moving.cases("full")} == {0.5, -1.0}
