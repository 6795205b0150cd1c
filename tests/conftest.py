"""What every test shares: hypothesis judges answers, not the time a loaded machine takes for them."""

from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("lubfric", deadline=None)
settings.load_profile("lubfric")


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout: docs, examples and packages are found from here."""
    return Path(__file__).parents[1]
