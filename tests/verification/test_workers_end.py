"""A worker of the verification's pools does not outlive the process that started it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

PROGRAM = """
import sys, time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from verification.run import end_with_parent
from tests_of_workers import sleeping
if __name__ == "__main__":
    with ProcessPoolExecutor(2, mp_context=get_context(sys.argv[1]), initializer=end_with_parent) as pool:
        list(pool.map(sleeping, [sys.argv[2], sys.argv[2]]))
"""
TASK = """
import os, time
from pathlib import Path
def sleeping(folder):
    Path(folder, str(os.getpid())).touch()
    time.sleep(900)
"""


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks at /proc")
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_workers_end_with_a_killed_parent(method, tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "tests_of_workers.py").write_text(TASK)
    (at_work := tmp_path / "at-work").mkdir()
    root = str(Path(__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([root, str(tmp_path)])}
    parent = subprocess.Popen([sys.executable, str(tmp_path / "program.py"), method, str(at_work)], env=environment)
    assert _until(lambda: len(os.listdir(at_work)) == 2 or parent.poll() is not None, 600)
    workers = [int(name) for name in os.listdir(at_work)]
    assert len(workers) == 2 and all(_lives(pid) for pid in workers)
    os.kill(parent.pid, signal.SIGKILL)
    parent.wait()
    assert _until(lambda: not any(_lives(pid) for pid in workers), 600)


def _lives(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def _until(holds, seconds: float) -> bool:
    end = time.monotonic() + seconds
    while not holds() and time.monotonic() < end:
        time.sleep(0.05)
    return holds()
