"""The store: whole files under kills, records of several writers, damage seen, locks, fingerprints, the codec."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_text import paper_scene

import lubfric
from lubfric._base import FolderLock, read_checked, write_checked, write_whole
from lubfric.errors import Report
from lubfric.models import prepare
from lubfric.models.shared import Violation
from lubfric.output import command_line as cli
from lubfric.studies import Store, classes_of, decode, digest, encode, fingerprint, opened

ROOT = Path(__file__).parents[2]
SCENE = paper_scene(contact={"shape": (64, 64), "spacing": 0.9e-6}, surface={"correlation_length": 4e-6})


def started(code, *arguments):
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE)


# whole files

REPLACER = """
import sys
from lubfric._base import write_whole
print("ready", flush=True)
while True:
    for letter in (b"a", b"b"):
        write_whole(sys.argv[1], letter * 300_000)
"""


def test_a_killed_writer_leaves_the_old_file_or_the_new(tmp_path):
    path = tmp_path / "file"
    rng = np.random.default_rng(5)
    seen = 0
    for _ in range(3):
        process = started(REPLACER, path)
        process.stdout.readline()
        time.sleep(rng.uniform(0.0, 0.1))
        process.kill()
        process.communicate()
        if path.exists():
            seen += 1
            content = path.read_bytes()
            assert len(content) == 300_000 and len(set(content)) == 1
    assert seen > 0


def test_a_failed_write_leaves_the_old_file_and_no_rest(tmp_path, monkeypatch):
    path = tmp_path / "file"
    write_whole(path, b"old")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(lubfric.OutputError, match=r"file was not written: No space left on device"):
        write_whole(path, b"new")
    assert path.read_bytes() == b"old" and [p.name for p in tmp_path.iterdir()] == ["file"]


@given(content=st.binary(max_size=200), data=st.data())
def test_any_damage_of_a_checked_file_is_seen(tmp_path_factory, content, data):
    path = tmp_path_factory.mktemp("checked") / "file"
    write_checked(path, content)
    assert read_checked(path) == content
    whole = bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(whole) - 1))
    if data.draw(st.booleans()):
        path.write_bytes(whole[:at])
    else:
        whole[at] ^= data.draw(st.integers(1, 255))
        path.write_bytes(whole)
    assert read_checked(path) is None


# records

ADDER = """
import sys
from lubfric.studies.store import Store
store = Store(sys.argv[1])
print("ready", flush=True)
for i in range(int(sys.argv[3])):
    store.add(f"{sys.argv[2]}{i}", (i, 0.1 * i))
    print(i, flush=True)
"""


def test_several_writers_and_a_kill(tmp_path):
    ending = [started(ADDER, tmp_path, name, 40) for name in "ab"]
    killed = started(ADDER, tmp_path, "c", 10**6)
    for _ in range(4):  # "ready" and three records, however long they take
        said = killed.stdout.readline()
    killed.kill()
    said = (said + killed.stdout.read()).decode()  # what it has buffered too
    killed.communicate()
    last = int(said.rpartition("\n")[0].rpartition("\n")[2])
    for process in ending:
        process.communicate()
    for name, count in (("a", 40), ("b", 40), ("c", last + 1)):  # all that was said to be kept is
        result = Store(tmp_path).known([f"{name}{i}" for i in range(count)])
        assert result == {f"{name}{i}": (i, 0.1 * i) for i in range(count)}
    assert Store(tmp_path).get(f"c{last + 2}") is None


def test_what_a_killed_writer_left_goes_with_the_next(tmp_path, monkeypatch):
    with monkeypatch.context() as killed, pytest.raises(KeyboardInterrupt):
        killed.setattr(Path, "unlink", lambda *_, **__: None)
        killed.setattr(os, "replace", lambda *_: signal.raise_signal(signal.SIGINT))
        Store(tmp_path).add("a", (1,))
    assert len(list((tmp_path / "points").iterdir())) == 1
    with opened(tmp_path):
        assert not list((tmp_path / "points").iterdir())


@pytest.mark.parametrize("name", ["lubfric.errors.Report", "lubfric.errors.Gone", "lubfric.gone.Report", "os.system"])
def test_a_record_of_another_version_does_not_count(tmp_path, name):
    tree = json.dumps({"class": name, "solver": "x"}).encode()
    content = len(tree).to_bytes(8, "little") + tree
    with pytest.raises(ValueError, match="another version"):
        decode(content, classes_of(Report))
    store = Store(tmp_path)
    store.add("a", (1,))
    write_checked(*(tmp_path / "points").iterdir(), b"a\n" + content)
    with pytest.warns(UserWarning, match="another version of lubfric and is not used"):
        assert store.known(["a", "b"]) == {}


def test_a_record_that_was_renamed_does_not_count(tmp_path):
    """Files of two points that take each other's place, as after a repair of a file system: each key keeps its own."""
    store = Store(tmp_path)
    store.add("a", (1,))
    store.add("b", (2,))
    for old, new in (("a", "c"), ("b", "a"), ("c", "b")):
        (tmp_path / "points" / f"{old}.bin").rename(tmp_path / "points" / f"{new}.bin")
    with pytest.warns(UserWarning, match="damaged and is not used"):
        assert store.known(["a", "b"]) == {}
    store.add("a", (1,))
    with pytest.warns(UserWarning, match="damaged and is not used"):
        assert store.known(["a", "b"]) == {"a": (1,)}


def test_every_outcome_comes_back_as_it_was(tmp_path):
    entry = Violation(
        what="f", value=2.0, limit=1.0, unit="", consequence="too much", recommendation="less", severe=True
    )
    store = Store(tmp_path)
    model = prepare(SCENE)
    point = lubfric.friction(model, 0.01).without_fields()
    for key, error in enumerate(
        (
            lubfric.ValidityError("beyond", (entry,), point),
            lubfric.ConvergenceError(
                "lost", Report("a solver", "diverged", iterations=3, residual=float("inf"), tolerance=1e-3)
            ),
            lubfric.InputError("wrong"),
            lubfric.LubfricError("other"),
        )
    ):
        store.add(str(key), error)
        back = store.get(str(key))
        assert type(back) is type(error) and str(back) == str(error)
        assert getattr(back, "entries", ()) == getattr(error, "entries", ())
        assert getattr(back, "report", None) == getattr(error, "report", None)
        assert digest(getattr(back, "result", None)) == digest(getattr(error, "result", None))
    for speed in (0.0, 0.01, 0.3):
        point = lubfric.friction(model, speed, fields=True)
        store.add("point", point)
        assert digest(store.get("point")) == digest(point)


# lock

HOLDER = """
import sys
from lubfric._base import FolderLock
with FolderLock(sys.argv[1]):
    print("ready", flush=True)
    sys.stdin.read()
"""


def test_a_second_writer_is_refused_until_the_first_is_gone(tmp_path):
    holder = started(HOLDER, tmp_path)
    holder.stdout.readline()
    with pytest.raises(lubfric.InputError, match=f"another run .process {holder.pid}.; give another folder"):
        with FolderLock(tmp_path):
            pass
    holder.send_signal(signal.SIGKILL)
    holder.communicate()
    with FolderLock(tmp_path):
        pass


# fingerprint


def test_the_fingerprint_does_not_depend_on_how_a_slip_was_written():
    ratio, percent = ({"slide_roll_ratio": 5e-4}, {"slip_percent": 0.05})
    scenes = [lubfric.load_scene("paper").with_(motion=motion) for motion in (ratio, percent)]
    assert scenes[0] == scenes[1] and len({scene.doubtful for scene in scenes}) == 2
    assert fingerprint(scenes[0]) == fingerprint(scenes[1])


def test_the_fingerprint_sees_every_number_and_no_label(tmp_path):
    model = prepare(SCENE)
    same = prepare(SCENE.with_(name="other", motion={"speeds": (0.1,)}))
    assert fingerprint(model) == fingerprint(same)
    heights = model.surface.heights.copy()
    heights[3, 5] = np.nextafter(heights[3, 5], 1.0)
    moved = replace(model.surface, heights=heights)
    wider = replace(model.surface, spacing=(0.9e-6, 0.90001e-6))
    seen = [model, prepare(SCENE, surface=moved), prepare(SCENE, surface=wider), SCENE]
    seen += [SCENE.with_(bodies={"load": 1.000001 * SCENE.bodies.load}), SCENE.with_(bodies={"hardness": None})]
    assert len({fingerprint(part) for part in seen}) == len(seen)


def test_a_file_counts_by_its_bytes(tmp_path):
    def print_of(name, heights):
        np.save(tmp_path / name, heights)
        rough = {"file": str(tmp_path / name), "spacing": 1e-6, "correlation_length": None}
        return fingerprint(SCENE.with_(surface=rough))

    heights = np.random.default_rng(1).normal(size=(32, 32)) * 1e-8
    one = print_of("a.npy", heights)
    other = print_of("b.npy", heights)
    assert one == other and print_of("a.npy", heights * 1.001) != one


def test_values_that_look_alike_differ():
    values = [1, 1.0, "1", True, None, [1], {"1": 1}, (1, 1), [[1], 1], np.ones(1), np.ones((1, 1)), 0.0, -0.0]
    assert len({digest(value) for value in values}) == len(values)
    with pytest.raises(TypeError, match="cannot be stored"):
        digest(object())


# codec

plain = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner) | st.lists(inner).map(tuple) | st.dictionaries(st.text(), inner),
    max_leaves=10,
)


@settings(max_examples=50)
@given(value=plain)
def test_plain_values_come_back_the_same(value):
    again = decode(b"".join(encode(value)), {})
    assert again == value and repr(again) == repr(value)


def test_only_classes_of_the_table_are_built():
    report = Report("a solver", "diverged", iterations=3, residual=float("inf"), tolerance=1e-3)
    stored = b"".join(encode(report))
    assert decode(stored, classes_of(Report)) == report
    with pytest.raises(ValueError):
        decode(stored, classes_of(Violation))
    with pytest.raises(TypeError, match="cannot be stored"):
        encode(object())


@pytest.mark.parametrize("place", ["/proc/lubfric/deep", "file", "file/deep"])
def test_a_place_that_cannot_be_written_is_one_line_even_for_root(tmp_path, capsys, place):
    """A file system that takes no folders, a file where a folder should be: from Python and on the command line."""
    (tmp_path / "file").write_text("mine")
    out = place if place.startswith("/proc") else str(tmp_path / place)
    scene = lubfric.load_scene("flat").with_(
        contact={"shape": (32, 32), "spacing": 3e-6},
        surface={"sq": 1e-7, "correlation_length": 1e-5, "acf": "gaussian"},
        motion={"speeds": ()},
    )
    moving = scene.with_(transient=lubfric.Transient(1e-5, outputs=1))
    for call in (
        lambda: lubfric.stribeck(scene, [0.1], store=out),
        lambda: lubfric.transient(moving, checkpoint=out),
        lambda: lubfric.study(scene, {"bodies.load": [5.0, 6.0]}, store=out),
    ):
        with pytest.raises(lubfric.LubfricError, match=re.escape(out)):
            call()
    for name, one in (("steady", scene), ("moving", moving)):
        path = tmp_path / f"{name}.toml"
        path.write_text(one.to_toml())
        assert cli.main(["run", str(path), "--out", out]) == 2
        last = capsys.readouterr().err.strip().splitlines()[-1]
        assert last.startswith("lubfric: ") and out in last
    assert (tmp_path / "file").read_text() == "mine"
