"""How an interval is printed: ± only where both sides are alike, and never as if it held a model that is not known."""

import math

import pytest

from lubfric.sampling import Uncertainty

KNOWN = {"numerical": 0.001, "sampling": 0.01, "model": 0.05}
CASES = [
    (KNOWN, (0.045, 0.055), "f = 0.0500 ± 0.005 at 95 % (numerical 0.1 %, surface 1 %, model 5 %)"),
    (
        KNOWN | {"inputs": 0.3},
        (0.035, 0.054),
        "f = 0.0500, 0.0350 to 0.0540 at 95 % (numerical 0.1 %, surface 1 %, model 5 %, inputs 30 %)",
    ),
    (KNOWN | {"inputs": math.nan}, (0.045, 0.055), "model 5 %, inputs not known)"),
    (
        KNOWN | {"model": math.nan},
        (0.049, 0.051),
        "± 0.001 at 95 % (numerical 0.1 %, surface 1 %, model not known and not in it)",
    ),
    (KNOWN | {"sampling": math.nan}, (math.nan, math.nan), "f = 0.05 (numerical 0.1 %, surface not known, model 5 %)"),
]


@pytest.mark.parametrize("parts, interval, words", CASES)
def test_an_interval_in_words(parts, interval, words):
    known = Uncertainty(**parts, interval=interval)
    assert known.short(0.05).endswith(words)
    if math.isnan(known.model):
        assert "model not known and not in it" in known.text
