"""Parts of ``python -m verification stability``: every bad input of a seed, and the soak."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ..check import AT_MOST, Check, Item, Table
from . import soak as soaking
from .case import ACCEPTED, GOOD, LARGE, RAW, SLOW, WORDLESS
from .command import GROUPS, outcomes

SEED = 1
BAD = (RAW, ACCEPTED, SLOW, LARGE, WORDLESS)


def bad_inputs(level: str) -> Iterator[Item]:
    """Bad scenes, files, calls and command lines from a seeded generator: each is refused in words by
    `lubfric.LubfricError`, within 8 s and 2 GB."""
    found = list(outcomes(SEED, 0.1 if level == "quick" else 1.0))
    for group in GROUPS:
        for verdict in BAD:
            those = [o for o in found if o.case.group == group and o.verdict == verdict]
            first = str(those[0])[:200] if those else ""
            yield Check(f"{group}: {verdict}", len(those), 0, 0, "bad by construction", AT_MOST, note=first)
    counted = Counter((o.case.group, o.verdict) for o in found)
    rows = tuple((group, *(counted[group, v] for v in (*GOOD, *BAD))) for group in GROUPS)
    yield Table("bad-inputs", f"{len(found)} bad inputs by how they ended", ("input", *GOOD, *BAD), rows)


def soak(level: str) -> Iterator[Item]:
    """Friction of random scenes one after the other in one process: each answered, or refused in words; a part of the
    answers closed again by a judge that shares neither film solver nor root finder; memory flat."""
    count, judged_share = (150, 0.2) if level == "quick" else (10_000, 0.02)
    run = soaking.soak(count, SEED, judged_share)
    yield Check("raw errors", run.raw, 0, 0, "none is allowed", AT_MOST, note=run.first_bad)
    yield Check("silently wrong", run.wrong, 0, 0, "independent balance", AT_MOST, note=run.worst_case)
    yield Check("worst error / allowed", run.worst, 1, 0, "independent balance", AT_MOST)
    yield Check("growth of memory", run.growth, soaking.MOST_GROWTH, 0, "flat", AT_MOST, unit="MiB")
    words = f"{count} scenes: {run.answered} answered, {run.refused} refused, {run.judged} judged"
    yield Table("soak", words, ("why", "refused"), tuple(run.reasons.most_common(12)))
