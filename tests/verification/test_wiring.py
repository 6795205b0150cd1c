"""Every option reaches the number (the library as it is), and the checks that say so notice when one does not."""

import pytest

from verification.campaigns.mutants import FAILED, table, trial
from verification.catalogue import STUDIES
from verification.check import Check
from verification.run import load

WIRING = [s for s in STUDIES if s.name.startswith("wiring")]


@pytest.mark.parametrize("study", WIRING, ids=lambda s: s.name)
def test_every_option_arrives(study):
    checks = [item for item in load(study)("quick") if isinstance(item, Check)]
    assert len(checks) > 10 and [c for c in checks if not c.passed] == []


def test_a_lost_option_is_noticed():
    """One of them; ``python -m verification --only mutants`` tries all."""
    study = "wiring_contact"
    assert trial(next(mutant for mutant in table() if study in mutant.noticed_by), (study,)) == FAILED
