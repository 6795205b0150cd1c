"""A worker of a pool ends with the process that started it, whatever the worker is in the middle of.

A pool tells its workers that it is over. One that was killed tells nothing, and its workers would go on to the end of
their checks.
"""

import os
import threading
from multiprocessing import parent_process
from multiprocessing.connection import wait


def end_with_parent() -> None:
    """To be called first in a worker (``initializer`` of a pool): starts a thread that waits for the parent to end."""
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_watch, args=(parent.sentinel,), daemon=True).start()


def _watch(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)
