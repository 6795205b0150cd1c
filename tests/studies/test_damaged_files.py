"""A thousand damaged files: records, plans of studies and result.json. Each is told of, none stops what is sound
beside it, and none makes Python import anything."""

import json
import os
import shutil
import sys
import warnings
from contextlib import contextmanager

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric._base import read_checked, write_checked
from lubfric.output import main, read_record

DEEP = "[" * 100_000 + "]" * 100_000
WORDS = (  # what is put in place of a part of JSON
    *("null", "true", "-1", "0", "1e999", "-1e308", "NaN", "Infinity", "1" * 5000, "1" * 400, '"text"', '""', "[]"),
    *("{}", "[[]]", '{"a": 1}', DEEP, "[1, 2, 3]", '{"float": "nan"}', '{"float": "no"}', '{"float": [1]}'),
    *('{"list": 3}', '{"dict": 3}', '{"dict": {"a": []}}', '{"float64": "x"}', '{"float64": 3.5}', '{"int64": 1e400}'),
    *('{"class": "os.system"}', '{"class": "lubfric.__main__.X"}', '{"class": "this.that"}', '{"class": ["a"]}'),
    *('{"class": "lubfric.errors.Report"}', '{"class": 3, "x": 1}', '{"eval": "1"}', '{"array": 3}'),
    *('{"array": ["|O", [1], "C", 0]}', '{"array": ["<f8", [-1], "C", 0]}', '{"array": ["<f8", [1e9], "C", 0]}'),
    *('{"array": ["<f8", [1000000000000], "C", 0]}', '{"array": ["<f8", [0, 99999999999999999999], "C", 0]}'),
    *('{"array": ["<f8", [2], "X", 0]}', '{"array": ["<f8", [1], "C", -9]}', '{"array": [["a", "O"], [1], "C", 0]}'),
    *('{"array": ["<f8", [], "C", 10000000]}', '{"array": ["V8", [1], "C", 0]}', "\\", '{"a": 1, "a": 2}'),
)
MARK = '"~~here~~"'


def places(tree, path=()):
    """The ways to all parts of a tree."""
    yield path
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, part in items:
        yield from places(part, (*path, key))


def damaged_json(text, rng):
    """JSON with one part replaced, left out or said twice."""
    tree = json.loads(text)
    ways = list(places(tree))
    way = ways[rng.integers(len(ways))]
    if not way:
        return WORDS[rng.integers(len(WORDS))]
    parent = tree
    for key in way[:-1]:
        parent = parent[key]
    kind = rng.integers(4)
    if kind == 0:
        del parent[way[-1]]
        return json.dumps(tree)
    if kind == 1 and isinstance(parent, dict):
        parent["~~here~~"] = 0
        return json.dumps(tree).replace(MARK, json.dumps(way[-1]))
    parent[way[-1]] = "~~here~~"
    return json.dumps(tree).replace(MARK, WORDS[rng.integers(len(WORDS))], 1)


def damaged_bytes(content, rng):
    """Bytes cut off, flipped, emptied, doubled or replaced."""
    at = int(rng.integers(max(len(content), 1)))
    flipped = bytearray(content)
    flipped[at] ^= int(rng.integers(1, 256))
    noise = rng.integers(0, 256, 300, dtype=np.uint8).tobytes()
    return (content[:at], bytes(flipped), b"", content + content, noise)[rng.integers(5)]


def replaced(path, rng):
    """Something else in place of a file: a folder, a loop of links, a link to nowhere, a pipe."""
    path.unlink()
    kind = rng.integers(4)
    if kind == 0:
        path.mkdir()
    elif kind == 3:
        os.mkfifo(path)
    else:
        path.symlink_to(path.name if kind == 1 else "nowhere")


def damage(path, rng):
    """Replace a file of a store or of a run by a damaged one; of records often with a checksum that is right."""
    kind = rng.integers(10)
    record = path.suffix == ".bin"
    if kind == 0:
        replaced(path, rng)
    elif kind == 1 or not (record or path.suffix == ".json"):
        path.write_bytes(damaged_bytes(path.read_bytes(), rng))
    elif not record:
        path.write_bytes(damaged_json(path.read_text(), rng).encode())
    else:
        key, line, content = read_checked(path).partition(b"\n")
        end = 8 + int.from_bytes(content[:8], "little")
        tree = damaged_json(content[8:end], rng).encode()
        content = len(tree).to_bytes(8, "little") + tree + content[end:]
        write_checked(path, key, line, content if kind > 2 else damaged_bytes(content, rng), sync=False)


@contextmanager
def damaged(path, rng):
    """The file ``path`` damaged for a while."""
    sound = path.read_bytes()
    damage(path, rng)
    yield
    path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink(missing_ok=True)
    path.write_bytes(sound)


class Watch:
    """Notes what Python is asked to import."""

    def __init__(self):
        self.names = []

    def find_spec(self, name, *_):
        if not name.startswith("encodings."):  # of a text whose bytes look like another encoding
            self.names.append(name)


@pytest.fixture
def imports(monkeypatch):
    watch = Watch()
    monkeypatch.setattr(sys, "meta_path", [watch, *sys.meta_path])
    return watch.names


SPEEDS = (0.01, 0.1, 1.0)


@pytest.fixture(scope="module")
def stores(tmp_path_factory):
    """A study at given speeds, one with a failed point, and one whose speeds are chosen."""
    made = []
    refused = SCENE.with_(surface={"sq": 0.0}, lubricant={"viscosity": 0.005}, motion={"slide_roll_ratio": 2.0})
    for scene, speeds in (
        (SCENE, SPEEDS),
        (refused, (1.0, 1000.0)),
        (SCENE.with_(numerics={"tolerance": 0.1}), "auto"),
    ):
        folder = tmp_path_factory.mktemp("store")
        lubfric.study(scene, {"bodies.load": [5.5]}, speeds, store=folder)
        made.append((folder, lubfric.open_study(folder)))
    assert made[1][1].failed == 1
    return made


def looked_at(found, folder):
    """All that a user does with a study."""
    found.to_csv(folder / "t.csv")
    return repr(found), found["coefficient"], found.lift_off, found.at(0.1), found.coords, found.failures


@pytest.mark.slow
def test_damaged_studies_are_reported_and_stop_nothing(stores, tmp_path, imports):
    rng = np.random.default_rng(7)
    stated = {"error": 0, "warning": 0, "none": 0}
    looked_at(stores[0][1], tmp_path)
    imports.clear()
    for trial in range(700):
        folder, sound = stores[trial % 3]
        plan = folder / "points" / "plan.bin"
        points = sorted((folder / "points").glob("?" * 40 + ".bin"))
        files = [plan] if trial % 4 == 0 else points
        with damaged(files[rng.integers(len(files))], rng), warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                result = lubfric.open_study(folder)
                if trial % 10 < 3:
                    looked_at(result, tmp_path)
            except lubfric.InputError as error:
                assert trial % 4 == 0 and "\n" not in str(error) and str(folder) in str(error)
                stated["error"] += 1
                continue
        stated["warning" if caught else "none"] += 1
        if trial % 4 and not result.chosen:
            kept = result.status == sound.status
            assert np.count_nonzero(~kept) <= 1
            same = result["coefficient"][kept] == sound["coefficient"][kept]
            assert np.count_nonzero(~same & np.isfinite(sound["coefficient"][kept])) <= 1
    assert imports == [] and stated["error"] > 60 and stated["warning"] > 350, stated


def test_damaged_results_are_one_clear_error(tmp_path, imports, capsys):
    scene = SCENE.with_(lubricant={"density_law": "constant"})
    (tmp_path / "s.toml").write_text(scene.to_toml())
    run = tmp_path / "run"
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.01,0.3", "--out", str(run)]) == 0
    rng = np.random.default_rng(8)
    refused = 0
    assert main(["plot", str(run)]) == 0
    imports.clear()
    for trial in range(150):
        with damaged(run / "result.json", rng):
            try:
                if trial % 75:
                    read_record(run)
                else:
                    assert main(["plot", str(run)]) in (0, 2)
            except lubfric.InputError as error:
                assert "\n" not in str(error) and "result.json" in str(error)
                refused += 1
    assert imports == [] and refused > 30


@pytest.mark.parametrize("kind", ["folder", "loop", "cut"])
def test_a_study_goes_on_beside_what_is_damaged(stores, tmp_path, kind):
    """The points that are sound are not solved again, and the others are."""
    shutil.copytree(stores[0][0], tmp_path / "s")
    path = sorted((tmp_path / "s" / "points").iterdir())[0]
    content = path.read_bytes()
    path.unlink()
    if kind == "cut":
        path.write_bytes(content[:100])
    elif kind == "loop":
        path.symlink_to(path.name)
    else:
        path.mkdir()
    with pytest.warns(UserWarning, match="damaged and is not used"):
        assert lubfric.open_study(tmp_path / "s").missing == 1
    if kind == "folder":  # which lubfric does not remove
        with pytest.warns(UserWarning), pytest.raises(lubfric.OutputError, match=f"{path.name} was not written"):
            lubfric.study(SCENE, {"bodies.load": [5.5]}, SPEEDS, store=tmp_path / "s")
        return
    with pytest.warns(UserWarning, match="solved again"):
        again = lubfric.study(SCENE, {"bodies.load": [5.5]}, SPEEDS, store=tmp_path / "s")
    np.testing.assert_array_equal(again["coefficient"], stores[0][1]["coefficient"])


def test_a_record_of_the_first_version_is_read(tmp_path):
    """Its violations have a remedy, and do not say whether they are notes."""
    known = {"what": "w", "value": 2.0, "limit": 1.0, "unit": "", "consequence": "c", "remedy": "r", "severe": False}
    record = {"scene": {"name": "n"}, "points": [{"validity": [known]}]}
    (tmp_path / "result.json").write_text(json.dumps(record))
    assert read_record(tmp_path)["points"][0]["validity"][0]["recommendation"] == "r"
