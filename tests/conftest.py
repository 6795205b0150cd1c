"""What every test shares: hypothesis judges answers, not the time a loaded machine takes for them; what is slow."""

from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("lubfric", deadline=None)
settings.load_profile("lubfric")

SLOW = frozenset((Path(__file__).parent / "slow_tests.txt").read_text(encoding="utf-8").split())


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items) -> None:
    """Tests marked slow where they stand take minutes and belong to the verification: they are ``study`` as well, and
    run only where ``-m`` asks for them. Those of slow_tests.txt are part of the default run, not of the fast lane."""
    studies = [item for item in items if item.get_closest_marker("slow")]
    for item in items:
        if item.get_closest_marker("slow"):
            item.add_marker("study")
        elif item.nodeid.split("[")[0].removeprefix("tests/") in SLOW:
            item.add_marker("slow")
    if studies and not config.option.markexpr:
        config.hook.pytest_deselected(items=studies)
        items[:] = [item for item in items if item not in set(studies)]


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout: docs, examples and packages are found from here."""
    return Path(__file__).parents[1]
