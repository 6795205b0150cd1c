"""The mutation test is itself tested: mutants change what they say, leave nothing behind, and are caught for
a reason.
"""

import json

import numpy as np
import pytest

from verification import mutations
from verification.mutants import MUTANTS, Mutant, applied, located
from verification.mutations import NONE, Trial, table, trial

NAMES = [m.name for m in MUTANTS]


def test_there_are_ten_and_each_has_its_own_name():
    assert len(NAMES) == len(set(NAMES)) == 10 and NONE not in NAMES


@pytest.mark.parametrize("mutant", MUTANTS, ids=NAMES)
def test_every_place_exists_and_is_restored(mutant):
    places = [located(place) for place in mutant.places]
    before = [vars(owner)[name] for owner, name in places]
    with pytest.raises(ZeroDivisionError), applied(mutant):
        assert all(vars(owner)[name] is not b for (owner, name), b in zip(places, before, strict=True))
        raise ZeroDivisionError
    assert all(vars(owner)[name] is b for (owner, name), b in zip(places, before, strict=True))


def test_a_place_that_is_gone_is_an_error_and_undoes_the_others():
    from lubfric.rough import half_space

    original = half_space.centred_axis
    gone = Mutant(
        "gone",
        "",
        {"lubfric.rough.half_space:centred_axis": lambda f: f, "lubfric.rough.half_space:no_such": lambda f: f},
    )
    with pytest.raises(AttributeError, match="no_such"), applied(gone):
        pass
    assert half_space.centred_axis is original


def test_calls_are_counted():
    from lubfric.rough import half_space

    mutant = next(m for m in MUTANTS if m.name == "half_cell")
    right = half_space.centred_axis(4, 2.0)
    with applied(mutant) as calls:
        assert calls == []
        assert np.allclose(half_space.centred_axis(4, 2.0), right - 1.0)
    assert calls == ["lubfric.rough.half_space:centred_axis"]
    half_space.centred_axis(4, 2.0)
    assert len(calls) == 1


def test_kernel_mutant_is_caught_by_hertz_and_the_library_is_not():
    caught = trial("kernel_factor_2", suite=("contact_grid",))
    assert caught.passed and caught.calls > 0 and "cylinder: peak pressure" in caught.failures[0][1]
    clean = trial(NONE, suite=("contact_grid",))
    assert clean.passed and clean.failures == () and clean.checks == caught.checks


def test_viscosity_mutant_is_caught_by_the_film_table():
    caught = trial("viscosity_exponent", suite=("ehl_grid",))
    assert caught.passed and any(name.endswith("flow film") for _, name, *_ in caught.failures)


def test_a_mutant_that_nobody_calls_is_not_caught():
    idle = trial("half_cell", suite=())
    assert not idle.passed and idle.calls == 0


def test_a_crash_is_not_a_catch():
    failure = ("study", "check", "1", "2")
    good = Trial("half_cell", "", (failure,), 3, "", 5, 0.1)
    assert good.passed
    assert not Trial("half_cell", "", (failure,), 3, "TypeError: x", 5, 0.1).passed
    assert not Trial("half_cell", "", (), 3, "", 5, 0.1).passed
    assert not Trial(NONE, "", (failure,), 3, "", 0, 0.1).passed
    text = table([good, Trial("x", "", (), 3, "", 5, 0.1), Trial("y", "", (failure,), 3, "TypeError", 5, 0.1)], 1.0)
    assert "1 of 3 mutants caught" in text and "x (NOT CAUGHT)" in text and "y (CRASHED)" in text


@pytest.mark.slow
def test_all_ten_are_caught_and_the_library_passes(tmp_path, capsys):
    assert mutations.main(["--json", str(tmp_path / "m.json")]) == 0
    rows = json.loads((tmp_path / "m.json").read_text())
    assert [r["name"] for r in rows] == [NONE, *NAMES] and all(r["passed"] for r in rows)
    assert "10 of 10 mutants caught" in capsys.readouterr().out
