"""``python -m verification sampling``: does the interval contain the friction of an infinite line contact?

Every case is solved many times, with seeds of its own. The exit code is 1 when coverage, reported error over scatter,
or bias of a case is out of its bounds (`verification.campaigns.sampling.coverage`).
"""

from argparse import ArgumentParser, Namespace

from ... import frame
from ...types import Keywords, PlainRow

PARTS: tuple[tuple[str, str, str, Keywords], ...] = (
    ("coverage", "sampling.coverage:coverage", "Intervals compared with the friction of an infinite line contact", {}),
    ("pieces", "sampling.others:pieces", "Intervals of pieces compared with the complete map", {}),
    ("quantities", "sampling.others:quantities", "Every other quantity compared with its stated error", {}),
)
SEED = 240_000  # of the first surface of the trials


def _options(parser: ArgumentParser) -> None:
    parser.add_argument("--seed", type=int, default=SEED, help="of the surfaces (default: %(default)s)")


def _own(part: str, options: Namespace) -> PlainRow:
    return {} if part == "quantities" else {"seed": options.seed}


COMMAND = frame.campaign("sampling", __doc__, PARTS, add_options=_options, more_keywords=_own)
