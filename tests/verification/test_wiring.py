"""Every option reaches the number (the library as it is), and the checks that say so notice when one does not."""

import time
from functools import partial

import pytest

from verification.campaigns import mutants
from verification.campaigns.mutants import FAILED, PASSED, Mutant, outcome_of, table
from verification.catalogue import STUDIES
from verification.check import Check
from verification.run import load

WIRING = [s for s in STUDIES if s.name.startswith("wiring")]


@pytest.mark.parametrize(
    "study", [pytest.param(s, id=s.name, marks=[pytest.mark.slow] * (s.name != "wiring_contact")) for s in WIRING]
)
def test_every_option_arrives(study):
    checks = [item for item in load(study)("quick") if isinstance(item, Check)]
    assert len(checks) > 10 and [c for c in checks if not c.passed] == []


def test_a_lost_option_is_noticed():
    """One of them; ``python -m verification mutants`` tries all."""
    study = "wiring_contact"
    assert outcome_of(next(mutant for mutant in table() if study in mutant.noticed_by), (study,)) == FAILED


def test_every_mutant_quotes_text_that_stands_once_in_its_place():
    assert [message for mutant in table() if (message := mutant.misquoted())] == []


def test_a_wrong_quote_fails_and_stops_no_other_trial(tmp_path, monkeypatch):
    good, bad = table()[0], Mutant("oil", "no such text", "", ("oil/test_oil.py",))
    monkeypatch.setattr(mutants, "table", lambda: [bad, good])
    monkeypatch.setattr(mutants, "outcome_of", lambda mutant, names, longest: FAILED if mutant else PASSED)
    checks = [item for item in mutants.mutants("default", file=tmp_path / "t.csv") if isinstance(item, Check)]
    assert [check.passed for check in checks] == [False, True, True] and "0 times" in checks[0].refused


def test_a_quoted_text_is_found_however_its_lines_are_broken(tmp_path):
    (tmp_path / "a.py").write_text("x = f(\n    one + two,\n    three,\n)\n")
    _, content = Mutant("a.py", "f(one + two, three)", "g(1)", ()).broken(tmp_path)
    assert content == "x = g(1)\n"
    with pytest.raises(ValueError, match="0 times"):
        Mutant("a.py", "f(onetwo", "g(", ()).broken(tmp_path)


def test_a_verdict_holds_until_the_changed_function_or_its_test_changes(tmp_path):
    def print_of(inside="x + 1", other="2", asserted="f(1) == 2"):
        (tmp_path / "lubfric" / "a.py").write_text(f"def f(x):\n    y = {inside}\n    return y\n\n\nother = {other}\n")
        (tmp_path / "tests" / "test_a.py").write_text(f"def test_f():\n    assert {asserted}\n")
        return Mutant("a.py", "return y", "return -y", ("test_a.py::test_f",)).fingerprint(tmp_path)

    for folder in ("lubfric", "tests"):
        (tmp_path / folder).mkdir()
    first = print_of()
    assert print_of(other="3") == print_of(inside="x  +  1  # y") == first
    assert len({first, print_of(inside="x + 2"), print_of(asserted="f(2) == 3")}) == 3


def test_trials_that_are_up_to_date_are_not_repeated(tmp_path, monkeypatch):
    def outcome_of(mutant, names, longest):
        tried.append(mutant)
        return FAILED if mutant else PASSED

    monkeypatch.setattr(mutants, "outcome_of", outcome_of)
    tried = []
    judge = partial(mutants.mutants, "default", ["estimate/power.py"], file=tmp_path / "tried.csv")
    assert not [item for item in judge(seconds=0.0) if isinstance(item, Check)] and tried == []
    checks = [item for item in judge() if isinstance(item, Check)]
    assert len(checks) == len(tried) > 2 and all(check.passed for check in checks)
    assert tried.count(None) == len([check for check in checks if "as it is" in check.name]) > 0
    tried.clear()
    again = [item for item in judge() if isinstance(item, Check)]
    assert tried == [] and [check.name for check in again] == [check.name for check in checks]


def test_a_trial_that_the_deadline_stops_has_no_outcome_and_leaves_no_row(tmp_path, monkeypatch):
    def outcome_of(mutant, names, longest):
        time.sleep(longest)
        return mutants.BROKEN

    monkeypatch.setattr(mutants, "outcome_of", outcome_of)
    items = list(mutants.mutants("default", ["estimate/power.py"], 0.2, tmp_path / "tried.csv"))
    assert not (tmp_path / "tried.csv").exists() and [each for each in items if isinstance(each, Check)] == []
