"""``python -m verification calibration``: the error of the quick model on kinds of contacts that the fit
excluded.

Random contacts are solved by load sharing, and by the deterministic model on long and on short cells. ``python -m
verification.campaigns.calibration MOTION COUNT`` extends the table of solved cases; ``... numbers`` solves those that
are missing on long cells, ``... fit`` writes the error model of lubfric anew, and ``... pairs COUNT`` solves pairs of
similar contacts.
"""

from ... import frame
from ...types import Keywords

PARTS: tuple[tuple[str, str, str, Keywords], ...] = (
    (
        "rest",
        "calibration.held_out:coverage",
        "Roughness at rest: bounds on excluded kinds",
        {"motion": "rest"},
    ),
    ("rolling", "calibration.held_out:coverage", "Roughness that moves", {"motion": "rolling"}),
    ("pairs", "calibration.pairs:coverage", "Differences between similar designs", {}),
    ("summary", "calibration.held_out:summary", "Both, in a row each", {}),
    ("paper-limit", "calibration.paper_limit:band", "The limiting stress that the paper does not give", {}),
)
COMMAND = frame.campaign("calibration", __doc__, PARTS)
