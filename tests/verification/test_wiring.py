"""Every option reaches the number (the library as it is), and the checks that say so notice when one does not."""

import pytest

from verification.check import Check
from verification.mutants import MUTANTS
from verification.mutations import trial
from verification.run import load
from verification.studies import STUDIES

WIRING = [s for s in STUDIES if s.name.startswith("wiring")]
QUICKEST = ("film_density_law", "flat_hardness", "half_a_column", "coarse_heights", "motion_axis", "map_not_scaled")


@pytest.mark.parametrize("study", WIRING, ids=lambda s: s.name)
def test_every_option_arrives(study):
    checks = [item for item in load(study)("quick") if isinstance(item, Check)]
    assert len(checks) > 10 and [c for c in checks if not c.passed] == []


@pytest.mark.parametrize("name", QUICKEST)
def test_a_lost_option_is_noticed(name):
    (check,) = trial("default", name)
    assert check.passed, check


def test_at_least_twenty_mutants_lose_an_option():
    names = {s.name for s in WIRING}
    lost = [m for m in MUTANTS if names & set(m.suite)]
    assert len(lost) >= 20 and {s for m in lost for s in m.suite} == names
