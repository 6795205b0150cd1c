"""What all tests share: hypothesis judges answers, not the time that a loaded machine takes, on the same examples
every time; Ctrl-C interrupts; what is slow."""

import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

# One thread of BLAS in each of the workers that share the processors, before NumPy is imported: 310 s in place of 363.
for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

# Python keeps what it compiled even where the environment says no: each worker would compile the tests for 8 s, and
# each process that a test starts the library for 0.3 s.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Cycles are searched for after this many new objects: one search in the usual 700 takes 8 % of the time.
gc.set_threshold(100_000, 20, 20)

import pytest  # noqa: E402
from hypothesis import HealthCheck, settings  # noqa: E402
from pictures import leave_out, put_back  # noqa: E402

settings.register_profile("lubfric", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("lubfric")
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # in a background job of a shell, and in all that it starts
    signal.signal(signal.SIGINT, signal.default_int_handler)

SLOW = frozenset((Path(__file__).parent / "slow_tests.txt").read_text(encoding="utf-8").split())


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items) -> None:
    """Tests marked slow where they stand belong to ``python -m verification --full`` (`long_tests`): they are ``study``
    as well, and run only where ``-m`` asks for them. Those of slow_tests.txt are part of the default run, not of the
    fast tests."""
    studies = {item for item in items if item.get_closest_marker("slow")}
    for item in items:
        if item.get_closest_marker("slow"):
            item.add_marker("study")
        elif item.nodeid.split("[")[0].removeprefix("tests/") in SLOW:
            item.add_marker("slow")
    if studies and not config.option.markexpr:
        config.hook.pytest_deselected(items=list(studies))
        items[:] = [item for item in items if item not in studies]


def pytest_collection_finish() -> None:
    """What is there before the first test is searched for cycles no more."""
    gc.freeze()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """A file is run by one worker, so that what its tests share is solved once."""
    from xdist.scheduler import LoadFileScheduling

    return LoadFileScheduling(config, log)


@pytest.fixture(scope="session", autouse=True)
def long_lines() -> Iterator[None]:
    """Commands break no line: tests look for sentences. Those of the width set another one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLUMNS", "10000")
        yield


@pytest.fixture(scope="session", autouse=True)
def unsynced() -> Iterator[None]:
    """Files are not forced onto the disk, for which tests would wait: processes are killed here, and no machine."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", lambda handle: None)
        yield


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout: docs, examples and packages are found from here."""
    return Path(__file__).parents[1]


@pytest.fixture(scope="session", autouse=True)
def undrawn() -> Iterator[None]:
    """The pictures of commands are not drawn, which takes most of the time of a small run, except where a test has the
    fixture `drawn`."""
    with pytest.MonkeyPatch.context() as patched:
        leave_out(patched.setattr)
        yield


@pytest.fixture
def drawn(monkeypatch) -> None:
    """The pictures of commands are drawn."""
    put_back(monkeypatch.setattr)


@pytest.fixture
def draws(monkeypatch) -> Callable[..., None]:
    """A function of the names of those pictures of commands that are drawn: as `drawn`, in less time."""
    return lambda *names: put_back(monkeypatch.setattr, names)


@pytest.fixture
def load_sharing(monkeypatch) -> None:
    """Scenes that leave the model open are solved by load sharing alone, loosely: pages and scripts run in a fraction
    of the time, and what the default model answers is the matter of other tests."""
    import lubfric

    real = lubfric.load_scene

    def load_scene(*arguments, **options):
        scene = real(*arguments, **options)
        loose = {"model": "paper", "sampling_tolerance": 0.2, "tolerance": 0.05}
        return scene.with_(numerics=loose) if scene.numerics.model == "auto" else scene

    monkeypatch.setattr(lubfric, "load_scene", load_scene)


@pytest.fixture
def instruments(monkeypatch) -> None:
    """What reads files of instruments: the optional package, or where it is not installed a stand-in for it."""
    try:
        import SurfaceTopography  # noqa: F401
    except ImportError:
        from instrument_files import open_topography

        stand_in = ModuleType("SurfaceTopography")
        stand_in.open_topography = open_topography
        monkeypatch.setitem(sys.modules, "SurfaceTopography", stand_in)
