"""Studies on real clusters: Dask with two worker processes, MPI under mpiexec; workers killed."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from small_study import SCENE, same

import lubfric

ROOT = Path(__file__).parents[2]
VARY = {"surface.seed": [1, 2, 3, 4], "bodies.load": [3.0, 5.5]}
SPEEDS = tuple(np.geomspace(0.003, 0.3, 8))


@pytest.fixture(scope="module")
def serial():
    return lubfric.study(SCENE, VARY, SPEEDS)


def cluster():
    distributed = pytest.importorskip("distributed")
    dask = pytest.importorskip("dask")
    dask.config.set({"distributed.scheduler.allowed-failures": 1000})  # of one piece; after them Dask gives it up
    return distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_killed_dask_workers_lose_nothing(serial, tmp_path):
    """Twenty workers killed at random moments, over as many runs of the study as that takes: at most the point that was
    being solved is lost with a worker, and none is solved twice. The other worker lives: a Dask that has lost all of
    them waits for new ones, as a nanny whose worker dies while it starts gives up."""
    distributed = pytest.importorskip("distributed")
    rng = np.random.default_rng(1)
    killed = []
    for run in range(100):
        store = tmp_path / str(run)
        ended = threading.Event()
        with cluster() as workers, distributed.Client(workers) as client:

            def kill(store=store, ended=ended, workers=workers):
                while not list((store / "points").glob("*")) and not ended.is_set():
                    time.sleep(0.01)
                while len(killed) < 20 and not ended.wait(rng.exponential(0.5)):
                    known = set(workers.scheduler.workers)
                    pids = [nanny.pid for nanny in workers.workers.values() if nanny.worker_address in known]
                    if len(pids) == 2:
                        os.kill(int(rng.choice(pids)), signal.SIGKILL)
                        killed.append(run)

            client.wait_for_workers(2)
            killer = threading.Thread(target=kill, daemon=True)
            killer.start()
            same(lubfric.study(SCENE, VARY, SPEEDS, executor=client.get_executor(), store=store), serial)
            ended.set()
            killer.join()
        assert len(list((store / "points").iterdir())) == serial.status.size + 1  # and the plan
        if len(killed) >= 20:
            break
    assert len(killed) == 20


SCRIPT = f"""
import sys
sys.path[:0] = {[str(ROOT), str(ROOT / "tests")]!r}
import lubfric
from mpi4py.futures import MPIPoolExecutor
from small_study import SCENE

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        lubfric.study(SCENE, {VARY!r}, {[float(u) for u in SPEEDS]!r}, executor=executor, store=sys.argv[1])
"""


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("mpiexec") is None, reason="needs an MPI")
def test_mpi_gives_the_same_bits(serial, tmp_path):
    pytest.importorskip("mpi4py")
    (tmp_path / "script.py").write_text(SCRIPT)
    command = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    subprocess.run([*command, str(tmp_path / "script.py"), str(tmp_path / "store")], env=environment, check=True)
    same(lubfric.open_study(tmp_path / "store"), serial)
