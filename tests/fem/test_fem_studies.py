"""The quick studies of the finite elements and closed forms: orders of convergence, closed forms, and `lubfric` beside
them."""

import pytest

from verification.catalogue import STUDIES
from verification.check import Check
from verification.run import load

NAMES = ("reynolds", "layer", "contact", "contact_grid", "ehl_grid")  # the others with python -m verification
LONG = ("contact_grid", "layer", "reynolds")


@pytest.mark.parametrize(
    "study",
    [pytest.param(s, id=s.name, marks=[pytest.mark.slow] * (s.name in LONG)) for s in STUDIES if s.name in NAMES],
)
def test_every_check_passes(study):
    checks = [item for item in load(study)("quick") if isinstance(item, Check)]
    assert len(checks) > 5 and [c for c in checks if c.failed] == []
