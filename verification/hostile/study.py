"""Parts of ``python -m verification stability``: every bad input of a seed, and the soak."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from ..check import AT_MOST, Check, Item, Table
from . import soak as soaking
from .case import ACCEPTED, GOOD, LARGE, RAW, SLOW, WORDLESS
from .command import GROUPS, outcomes

SEED = 1
BAD = (RAW, ACCEPTED, SLOW, LARGE, WORDLESS)


def bad_inputs(level: str) -> Iterator[Item]:
    """Bad scenes, files, calls and command lines from a seeded generator. `lubfric.LubfricError` refuses each in words,
    within 8 s and 2 GB."""
    found = list(outcomes(SEED, 0.1 if level == "quick" else 1.0))
    for group in GROUPS:
        for verdict in BAD:
            those = [o for o in found if o.case.group == group and o.verdict == verdict]
            first = str(those[0])[:200] if those else ""
            yield Check(f"{group}: {verdict}", len(those), 0, 0, "bad by construction", AT_MOST, note=first)
    counted = Counter((o.case.group, o.verdict) for o in found)
    rows = tuple((group, *(counted[group, v] for v in (*GOOD, *BAD))) for group in GROUPS)
    yield Table("bad-inputs", f"{len(found)} bad inputs by how they ended", ("input", *GOOD, *BAD), rows)


def soak(level: str, folder: Path | None = None, workers: int = 1) -> Iterator[Item]:
    """Friction of random scenes one after the other in one process.

    Each is answered, or refused in words. Each answer is closed again by a judge that shares neither film solver nor
    root finder nor sums. The memory does not grow. ``folder`` keeps every fifty scenes that are done, so that a run
    that was stopped goes on.
    """
    count = 100 if level == "quick" else 10_000
    chunks = soaking.soak(count, SEED, folder, workers)
    wrong, raw = [w for c in chunks for w in c.wrong], sum(c.raw for c in chunks)
    worst = max(chunks, key=lambda c: c.worst)
    yield Check("raw errors", raw, 0, 0, "none is allowed", AT_MOST)
    note = "; ".join(wrong[:3]) or worst.worst_case
    yield Check("silently wrong", len(wrong), 0, 0, "independent balance", AT_MOST, note=note)
    yield Check("worst error / allowed", worst.worst, 1, 0, "independent balance", AT_MOST, note=worst.worst_case)
    yield Check("growth of memory", soaking.growth(chunks), soaking.MOST_GROWTH, 0, "flat", AT_MOST, unit="MiB")
    answered, refused, judged = (sum(getattr(c, name) for c in chunks) for name in ("answered", "refused", "judged"))
    words = f"{count} scenes: {answered} answered, {refused} refused, {judged} closed again"
    yield Table("soak", words, ("why", "refused"), tuple(soaking.total(chunks, "reasons").most_common(12)))
    yield Table("soak-features", "What the answered scenes had", ("feature", "scenes"), _sorted(chunks))
    sizes = chunks[:: max(1, len(chunks) // 12)]
    rows = tuple((c.number * soaking.CHUNK, c.process, round(c.memory, 1)) for c in sizes)
    yield Table("soak-memory", "Resident memory of the process", ("scenes before", "process", "MiB"), rows)


def _sorted(chunks) -> tuple[tuple[str, int], ...]:
    return tuple(soaking.total(chunks, "features").most_common())
