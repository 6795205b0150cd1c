"""Memory that was freed is kept for the next step of a solver, and goes back to the system after a point.

glibc by itself gives the end of its heap back as soon as some 128 kB of it are free. The fields of a Newton step are
freed at once and come back page by page at the next one, which took a fifth of the processor time of a rolling contact.
`keep_freed_memory` stops that.

It also keeps freed blocks inside the heap: after 45 points of varied scenes a process stood at 950 MB, of which 80 MB
were in use. `release_freed_memory` returns them after a point, where they have become many.
"""

import ctypes
import os
from collections.abc import Callable
from contextlib import suppress
from functools import cache, wraps
from importlib import import_module
from typing import ParamSpec, TypeVar

import numpy as np

P = ParamSpec("P")
T = TypeVar("T")

# Bytes of resident memory, more than after the last release, from which freed blocks are returned: a release takes
# about 1 ms a 100 MB. A choice: a smaller value takes more time, a larger one leaves more memory.
RELEASED_GROWTH = 64 * 2**20

# Bytes of the block whose release lets glibc keep as much again as it holds: a little less than the largest size from
# which glibc learns, 32 MB (mallopt(3), "M_MMAP_THRESHOLD"). A Newton step on 10,368 cells takes 28 instead of 35 ms.
LEARNED_SIZE = 32 * 2**20 - 2**16

# Address space that the first linear algebra of a process takes [bytes]: OpenBLAS of NumPy and that of SciPy 32 MB
# each, and a margin. Where they get none they try again without end, and no signal stops them. A choice of the margin.
FIRST_ALGEBRA = 96 * 2**20

_STATM = "/proc/self/statm"  # of Linux; the second number is the resident pages


def _malloc_trim() -> Callable[[int], int] | None:
    """Return the function of glibc; None elsewhere."""
    with suppress(OSError, AttributeError, TypeError):
        return ctypes.CDLL(None).malloc_trim
    return None


_trim = _malloc_trim()
_after_last = [0]  # bytes of resident memory after the last release


def resident_memory() -> int:
    """Return the bytes of this process that are in memory; 0 where the system does not say."""
    try:
        with open(_STATM, encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0


def check_address_space() -> None:
    """Raise `MemoryError` where a limit (``ulimit -v``) leaves this process too little for its first linear algebra."""
    try:
        limit = import_module("resource").getrlimit(import_module("resource").RLIMIT_AS)[0]
        with open(_STATM, encoding="ascii") as file:
            used = int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (ImportError, OSError, ValueError, IndexError):
        return
    if 0 <= limit < used + FIRST_ALGEBRA:
        needed = (used + FIRST_ALGEBRA) / 1e6
        raise MemoryError(f"at least {needed:.0f} MB of address space, and the limit is {limit / 1e6:.0f} MB")


@cache
def keep_freed_memory() -> None:
    """Let glibc keep what a solver frees, from the first call on; nothing changes elsewhere.

    glibc learns from the blocks that a program frees: after one of 32 MB, none of whose pages is touched here, it keeps
    up to 64 MB. That is what any large array of NumPy does. ``mallopt`` would set it too, for the whole process and
    against what the host may have set.
    """
    np.empty(LEARNED_SIZE, np.uint8)


def release_freed_memory() -> None:
    """Return freed blocks to the system, where resident memory has grown by `RELEASED_GROWTH` since the last time."""
    if _trim is None or resident_memory() < _after_last[0] + RELEASED_GROWTH:
        return
    _trim(0)
    _after_last[0] = resident_memory()


def releasing_memory(function: Callable[P, T]) -> Callable[P, T]:
    """Return the ``function`` such that memory which it used and freed goes back to the system when it ends, and not
    before."""

    @wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> T:
        keep_freed_memory()
        try:
            return function(*args, **kwargs)
        finally:
            release_freed_memory()

    return wrapped
