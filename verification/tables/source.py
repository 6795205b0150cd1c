"""Where the numbers of a page come from."""

from __future__ import annotations

import platform
import time

from lubfric._base import __version__


def source(command: str) -> str:
    """One line in italics: the command as it is typed, the day, the version and the machine."""
    day, machine, python = time.strftime("%Y-%m-%d"), platform.machine(), platform.python_version()
    return f"*`{command}`, {day}, lubfric {__version__}, {machine}, Python {python}.*"
