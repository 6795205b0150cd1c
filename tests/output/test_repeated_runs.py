"""The command that a report states, in the folder of the run, computes the same numbers, also where options of the
command chose the points, and after the folders moved."""

import hashlib
import json
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL

import lubfric
from lubfric.output import commands, main

SCENE = BODIES_AND_OIL.replace("[lubricant]", "hardness = 6e9\n[lubricant]")
SCENE += "[motion]\nentrainment_speed = 0.01\nspeeds = [0.001, 0.01, 0.3]\n"
SCENE += '[surface]\nfile = "map.npy"\nspacing = 0.9e-6\n[numerics]\nsampling = "patch"\nmodel = "paper"\n'


@pytest.mark.parametrize(
    "option", ["--speeds=0.02,0.2", "--ratios=-0.1,0.1", "--fields=0.3"], ids=["speeds", "ratios", "fields"]
)
def test_the_stated_command_repeats_the_run(option, tmp_path, monkeypatch):
    given = tmp_path / "given"
    given.mkdir()
    heights = lubfric.generate_surface((64, 64), 0.9e-6, sq=1e-7, correlation_length=4e-6, seed=7).heights
    np.save(given / "map.npy", heights)
    (given / "small.toml").write_text(SCENE)
    assert main(["run", str(given / "small.toml"), "--out", str(given / "out"), option]) == 0
    moved = tmp_path / "moved"
    shutil.move(given, moved)
    first = json.loads((moved / "out" / "result.json").read_text())
    assert [*first["map_sha256"].values()] == [hashlib.sha256((moved / "map.npy").read_bytes()).hexdigest()]
    page = (moved / "out" / "report.html").read_text()
    assert [*first["map_sha256"].values()][0] in page and first["command"] in page
    monkeypatch.chdir(moved / "out")
    program, *words = shlex.split(first["command"])
    assert program == "lubfric" and 'file = "../map.npy"' in Path("resolved.toml").read_text()
    assert main([*words, "--out", "again"]) == 0
    again = json.loads(Path("again/result.json").read_text())
    assert main(["run", "resolved.toml", "--out", "plain"]) == 0  # the file holds the options
    plain = json.loads(Path("plain/result.json").read_text())
    for name in ("speed", "coefficient", "contact_load"):
        for repeated in (again, plain):
            assert [point[name] for point in repeated["points"]] == [point[name] for point in first["points"]]


def test_a_map_that_is_gone_when_the_run_ends_costs_neither_page_nor_record(tmp_path, monkeypatch, drawn):
    """The checksum is that of the map that was read."""
    heights = lubfric.generate_surface((64, 64), 0.9e-6, sq=1e-7, correlation_length=4e-6, seed=7).heights
    path = tmp_path / "map.npy"
    np.save(path, heights)
    checksum = hashlib.sha256(path.read_bytes()).hexdigest()
    (tmp_path / "small.toml").write_text(SCENE)

    def gone(*_):
        path.unlink()
        raise OSError("nothing to draw")

    monkeypatch.setattr(commands, "plot_surface", gone)
    assert main(["run", str(tmp_path / "small.toml"), "--out", str(tmp_path / "out"), "--speeds=0.01"]) == 2
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert [*record["map_sha256"].values()] == [checksum]
    assert checksum in (tmp_path / "out" / "report.html").read_text()
