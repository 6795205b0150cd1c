"""One bad input, and how the library met it."""

import gc
import resource
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import lubfric

MOST_SECONDS = 8.0  # s: a refusal that takes longer is slow
MOST_BYTES = 2 * 2**30  # a refusal that needs more memory is large
REFUSED = "refused"
PASSED = "passed as it may"
RAW = "raw error"
ACCEPTED = "accepted"
SLOW = "slow"
LARGE = "large"
WORDLESS = "says too little"
GOOD = (REFUSED, PASSED)
BAD = (RAW, ACCEPTED, SLOW, LARGE, WORDLESS)


@dataclass(frozen=True)
class HostileCase:
    """``run(folder)`` hands the bad input to the library. ``folder`` is empty and belongs to the case.

    may_pass : the damage was done at random and can leave a good file. Then an answer is right too, but never another
        exception.
    """

    group: str
    name: str
    run: Callable[[Path], object]
    may_pass: bool = False


def peak_memory() -> int:
    """Return largest resident size of this process so far [bytes]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def resident_memory() -> int:
    """Return resident size of this process [bytes] after a garbage collection; the largest so far where the system
    reports only this."""
    gc.collect()
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except (OSError, IndexError, ValueError):
        return peak_memory()
    return pages * resource.getpagesize()


def judge(case: HostileCase, folder: Path) -> tuple[str, str]:
    """Return (verdict, words) of one case. Only `lubfric.LubfricError` is a refusal, and its words must be one
    paragraph."""
    before = peak_memory()
    begun = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            result = case.run(folder)
        verdict = PASSED if case.may_pass else ACCEPTED
        words = repr(result)[:200]
    except lubfric.LubfricError as error:
        words = str(error)
        verdict = REFUSED if 10 <= len(words) <= 1200 else WORDLESS
    except BaseException as error:  # what must never happen
        if isinstance(error, KeyboardInterrupt):
            raise
        verdict = RAW
        words = f"{type(error).__name__}: {error}"
    seconds = time.process_time() - begun
    after = peak_memory()
    if verdict in GOOD and seconds > MOST_SECONDS:
        verdict = SLOW
    if verdict in GOOD and after > max(before, MOST_BYTES):
        verdict = LARGE
    return verdict, f"{case.group}: {case.name}: after {seconds:.2f} s: {words[:300]}"
