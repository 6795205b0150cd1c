"""Commands end cleanly: full disks, interrupts while modules load, little memory, names that would move the cursor, and
cells that a spreadsheet would evaluate."""

import os
import resource
import runpy
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest

import lubfric
from lubfric import InputError
from lubfric._base import read_table, table_bytes
from lubfric.output import main

COMMAND = [sys.executable, "-m", "lubfric"]
full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")


@full
@pytest.mark.parametrize("arguments", [["info", "flat"], pytest.param(["oils"], marks=pytest.mark.slow)])
def test_an_answer_that_could_not_be_written_is_no_success(arguments):
    with open("/dev/full", "w") as stream:
        run = subprocess.run([*COMMAND, *arguments], stdout=stream, stderr=subprocess.PIPE, text=True)
    assert run.returncode == 2
    assert run.stderr.startswith("lubfric: standard output was not written") and run.stderr.count("\n") == 1


def test_a_reader_that_went_away_is_no_error():
    run = subprocess.Popen([*COMMAND, "oils"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    run.stdout.close()
    assert run.stderr.read() == b"" and run.wait() == 0
    run.stderr.close()


def test_an_interrupt_while_modules_load_ends_in_one_line(tmp_path):
    """A module of that name that waits stands in for the slow import of matplotlib or scipy."""
    (tmp_path / "argparse.py").write_text("import time\nprint('loading', flush=True)\ntime.sleep(60)\n")
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"}
    run = subprocess.Popen(
        [*COMMAND, "oils"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment, text=True, cwd=os.getcwd()
    )
    assert run.stdout.readline() == "loading\n"
    run.send_signal(signal.SIGINT)
    (_, said) = run.communicate(timeout=30)
    assert run.returncode == 130 and said == "lubfric: interrupted\n"


def test_too_little_memory_is_one_line(tmp_path):
    """The limit of an address space, as clusters set it."""
    script = (
        "import resource, sys; from lubfric.output import main; import numpy, scipy.fft, matplotlib.pyplot, "
        "lubfric.time;"
        "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize();"
        "resource.setrlimit(resource.RLIMIT_AS, (used + 2**26, used + 2**26)); sys.exit(main(sys.argv[1:]))"
    )
    scene = lubfric.load_scene("flat").with_(contact={"shape": (8192, 8192)})
    (tmp_path / "large.toml").write_text(scene.to_toml())
    run = subprocess.run(
        [sys.executable, "-c", script, "info", str(tmp_path / "large.toml")], capture_output=True, text=True
    )
    assert run.returncode in (1, 2) and run.stderr.startswith("lubfric: ") and run.stderr.count("\n") == 1
    assert "memory" in run.stderr
    assert resource.getrlimit(resource.RLIMIT_AS)[0] != 2**26


@pytest.mark.parametrize("name", ["\x1b[2J\x1b[31ma\rb\x07", "\u202edetcefni\x9b31m"])
def test_a_name_moves_no_cursor(tmp_path, capsys, name):
    path = tmp_path / "scene.toml"
    path.write_text(lubfric.load_scene("flat").to_toml())
    scene = lubfric.load_scene(path)
    path.write_text(type(scene)(**{**vars(scene), "name": name}).to_toml())
    assert main(["info", str(path)]) == 0
    out = capsys.readouterr().out
    assert not set(out) & set("\x1b\r\x07\u202e\x9b") and out.isprintable() is False
    assert main(["info", str(tmp_path / name / "none")]) == 2
    assert not set(capsys.readouterr().err) & set("\x1b\r\x07\u202e\x9b")


def test_a_terminal_without_a_character_shows_its_code(tmp_path):
    scene = lubfric.load_scene("flat")
    (tmp_path / "scene.toml").write_text(
        type(scene)(**{**vars(scene), "name": "Lager \u2460"}).to_toml(), encoding="utf-8"
    )
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    run = subprocess.run([*COMMAND, "info", str(tmp_path / "scene.toml")], capture_output=True, env=environment)
    assert run.returncode == 0 and b"Lager \\u2460" in run.stdout


@pytest.mark.parametrize("cell", ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", " =1"])
def test_a_cell_is_no_formula(tmp_path, cell):
    text = table_bytes({"name": [cell, "plain", "-1.5", ""], "x [m]": np.array([-1.0, 2.0, 3.0, np.nan])}).decode()
    lines = text.splitlines()
    assert lines[1].lstrip('"').startswith("'") and lines[2].startswith("plain") and lines[3].startswith("-1.5")
    assert lines[1].endswith("-1.0")
    (tmp_path / "a.csv").write_bytes(table_bytes({"f": np.array([-1.0, 1e-9])}))
    assert read_table(tmp_path / "a.csv")["f"].tolist() == [-1.0, 1e-9]


def test_numbers_and_names_beyond_all_bounds_are_refused(tmp_path):
    """1e999, a name of 200,000 letters, NUL, surrogates, a sparse file of 3 GiB: at once, with a clear message."""
    scene = lubfric.load_scene("flat")
    before = time.process_time()
    for name in ("a" * 200_000, "a\ud800b", "\udc80"):
        with pytest.raises(InputError, match="name"):
            type(scene)(**{**vars(scene), "name": name})
    for path in ("a" * 200_000, "a\0b", "x\ud800", "\udcff", tmp_path):
        for call in (lubfric.load_scene, lambda p: lubfric.read_surface(p, spacing=1e-6), _measured):
            with pytest.raises(InputError):
                call(path)
        with pytest.raises(InputError):
            scene.with_(surface={"file": path, "spacing": 1e-6}).with_(surface={"unit": "ell"})
    for suffix in (".txt", ".csv", ".npy", ".xyz", ".x3p", ".toml"):
        path = tmp_path / f"sparse{suffix}"
        with path.open("wb") as file:
            file.truncate(3 * 2**30)
        call = lubfric.load_scene if suffix == ".toml" else lubfric.read_surface
        with pytest.raises(InputError, match="bytes"):
            call(path)
        with pytest.raises(InputError):
            _measured(path)
    path = tmp_path / "map.csv"
    for text in ("1,2\n3,1e999\n", "1,2\n3,-1e400\n", "1,2\n3\0,4\n", "1e999,1\n2,3\n"):
        path.write_text(text)
        with pytest.raises(InputError):
            lubfric.read_surface(path, spacing=1e-6)
        path.write_text(f"U [m/s],f\n{text}")
        with pytest.raises(InputError):
            _measured(path)
    (tmp_path / "s.toml").write_text(scene.to_toml().replace("load = ", "load = 1e999 #", 1))
    with pytest.raises(InputError, match="load"):
        lubfric.load_scene(tmp_path / "s.toml")
    assert time.process_time() - before < 5.0


def _measured(path):
    return lubfric.read_measured(path, speed="U", coefficient="f")


def test_a_member_packed_by_an_unknown_method_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.x3p", "w", zipfile.ZIP_BZIP2) as archive:
        archive.writestr("main.xml", "<a/>")
    content = bytearray((tmp_path / "a.x3p").read_bytes())
    for place in (8, content.rfind(b"PK\x01\x02") + 10):
        content[place : place + 2] = b"\x5d\x00"
    (tmp_path / "a.x3p").write_bytes(content)
    with pytest.raises(InputError, match="not a complete"):
        lubfric.read_surface(tmp_path / "a.x3p")


def test_another_word_for_the_same_thing_takes_its_place():
    """``{"ra": ..., "sq": None}`` states Ra alone; so with every pair of keys that say the same thing."""
    scene = lubfric.load_scene("paper")
    assert scene.with_(surface={"ra": 8e-8, "sq": None}) == scene.with_(surface={"ra": 8e-8})
    assert scene.with_(surface={"ra": None, "sq": 1e-7}) == scene.with_(surface={"sq": 1e-7})
    assert scene.with_(bodies={"hertz_pressure": 5e8, "load": None}) == scene.with_(bodies={"hertz_pressure": 5e8})
    assert scene.with_(bodies={"hardness_hv": 700, "hardness": None}) == scene.with_(bodies={"hardness_hv": 700})
    assert scene.with_(motion={"slip_percent": 50, "slide_roll_ratio": None}) == scene.with_(
        motion={"slip_percent": 50}
    )
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 80}
    assert scene.with_(lubricant=oil | {"nu40": None, "temperature": None}) == scene.with_(lubricant=oil)
    with pytest.raises(InputError, match="same quantity"):
        scene.with_(surface={"ra": 8e-8, "sq": 1e-7})
    with pytest.raises(InputError, match="sq|correlation"):
        scene.with_(surface={"sq": None})


def raising(error):
    """Return what raises ``error`` whatever it is called with."""

    def raises(*_):
        raise error

    return raises


@pytest.mark.parametrize(
    "place, error",
    [("lubfric._base.figures.make_ready", MemoryError()), ("threading.Thread.start", RuntimeError("no new thread"))],
)
def test_what_can_be_done_without_ends_without_a_word(monkeypatch, tmp_path, capfd, place, error):
    """Fonts are loaded in a thread while a scene is solved: too little memory for them, or none for the thread, is no
    traceback."""
    monkeypatch.setattr(place, raising(error))
    scene = lubfric.load_scene("flat").with_(contact={"shape": (64, 64)}, surface={"correlation_length": 8e-6})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert main(["run", str(tmp_path / "scene.toml"), "--speeds", "0.03", "--out", str(tmp_path / "out")]) == 0
    assert "Traceback" not in capfd.readouterr().err


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc to read the address space")
def test_too_little_address_space_for_linear_algebra_is_one_line():
    """OpenBLAS tries without end to get its buffers, which no signal stops."""
    script = """
import resource, sys
from lubfric.output import main
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + 40 * 2**20, resource.RLIM_INFINITY))
sys.exit(main(["info", "flat"]))
"""
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert run.returncode == 1 and run.stdout == "" and run.stderr.count("\n") == 1
    assert (
        "not enough memory: it needs at least" in run.stderr and "MB of address space, and the limit is" in run.stderr
    )


@pytest.mark.parametrize("error", [MemoryError(), ImportError("x.so: failed to map segment from shared object")])
def test_too_little_memory_for_the_modules_is_one_line(monkeypatch, capsys, error):
    """``python -m lubfric``; an import that fails for another reason is no question of memory."""
    monkeypatch.setattr("lubfric.output.main", raising(error))
    with pytest.raises(SystemExit, match="1"):
        runpy.run_module("lubfric", run_name="__main__")
    assert capsys.readouterr().err.startswith("lubfric: not enough memory to load its modules")
    monkeypatch.setattr("lubfric.output.main", raising(ImportError("no module")))
    with pytest.raises(ImportError):
        runpy.run_module("lubfric", run_name="__main__")
