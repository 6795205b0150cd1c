"""The mutation test is itself tested: mutants change what they say, leave nothing behind, and are caught."""

import json

import numpy as np
import pytest

from verification import mutations
from verification.mutant import Mutant, applied, located
from verification.mutants import MUTANTS
from verification.mutations import NONE, judged, trial

NAMES = [m.name for m in MUTANTS]


def test_each_has_its_own_name():
    assert len(NAMES) == len(set(NAMES)) and NONE not in NAMES


@pytest.mark.parametrize("mutant", MUTANTS, ids=NAMES)
def test_every_place_exists_and_is_restored(mutant):
    places = [located(place) for place in mutant.places]
    before = [vars(owner)[name] for owner, name in places]
    with pytest.raises(ZeroDivisionError), applied(mutant):
        assert all(vars(owner)[name] is not b for (owner, name), b in zip(places, before, strict=True))
        raise ZeroDivisionError
    assert all(vars(owner)[name] is b for (owner, name), b in zip(places, before, strict=True))


def test_a_place_that_is_gone_is_an_error_and_undoes_the_others():
    from lubfric.contact import strips

    original = strips.centred_axis
    places = ("lubfric.contact.strips:centred_axis", "lubfric.contact.strips:no_such")
    gone = Mutant("gone", "", {place: lambda f: f for place in places})
    with pytest.raises(AttributeError, match="no_such"), applied(gone):
        pass
    assert strips.centred_axis is original


def test_calls_are_counted():
    from lubfric.contact.strip_cells import Cells

    mutant, cells = next(m for m in MUTANTS if m.name == "half_cell"), Cells((2, 1), (1.0, 1.0), 4)
    right = cells.axis()
    with applied(mutant) as calls:
        assert calls == []
        assert np.allclose(cells.axis(), right - 1.0)
    assert calls == list(mutant.places)
    cells.axis()
    assert len(calls) == 1


def tried(name, *suite):
    (check,) = trial("default", name, suite=suite)
    return check


def test_kernel_mutant_is_caught_by_hertz_and_the_library_is_not():
    caught = tried("kernel_factor_2", "contact_grid")
    assert caught.passed and caught.at["calls"] > 0 and "cylinder: peak pressure" in caught.note
    clean = tried(NONE, "contact_grid")
    assert clean.passed and clean.measured == 0 and clean.at["looked_at"] == caught.at["looked_at"]


def test_a_mutant_that_nobody_calls_is_not_caught():
    idle = tried("half_cell", "no_study")
    assert not idle.passed and idle.at["calls"] == 0 and "never ran" in idle.refused


def test_a_crash_is_not_a_catch():
    failure = ("study", "check", "1", "2")
    assert judged("half_cell", True, [failure], 3, "", 5).passed
    assert not judged("half_cell", True, [failure], 3, "TypeError: x", 5).passed
    assert not judged("half_cell", True, [], 3, "", 5).passed
    assert not judged("half_cell", True, [failure], 3, "", 0).passed
    assert judged(NONE, False, [], 3, "", 0).passed
    assert not judged(NONE, False, [failure], 3, "", 0).passed


@pytest.mark.slow
def test_all_are_caught_and_the_library_passes(tmp_path, capsys):
    assert mutations.main(["--out", str(tmp_path)]) == 0
    studies = json.loads((tmp_path / "report.json").read_text())["studies"]
    assert [s["name"] for s in studies] == [NONE, *NAMES] and all(s["passed"] for s in studies)
    assert f"{len(NAMES)} of {len(NAMES)} mutants caught" in capsys.readouterr().out
