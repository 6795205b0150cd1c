"""What all tests share: hypothesis judges answers, not the time that a loaded machine takes; Ctrl-C interrupts."""

import signal
from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("lubfric", deadline=None)
settings.load_profile("lubfric")
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # in a background job of a shell, and in all that it starts
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout: docs, examples and packages are found from here."""
    return Path(__file__).parents[1]
