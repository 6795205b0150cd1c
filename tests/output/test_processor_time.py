"""The stated processor time of a command with several processes, against what the system counts of them when they have
ended."""

import json
import re
import resource

import pytest

import lubfric
from lubfric.output import main


def seconds_of(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


@pytest.mark.parametrize("name", ["run", pytest.param("study", marks=pytest.mark.slow)])
def test_the_processor_time_contains_that_of_the_worker_processes(tmp_path, capsys, name):
    scene = lubfric.load_scene("paper").with_(numerics={"model": "paper"}, motion={"speeds": (0.02, 0.05)})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    study = 'scene = "scene.toml"\nspeeds = [0.05]\n[vary]\n"bodies.load" = [5.0, 6.0]\n'
    (tmp_path / "study.toml").write_text(study)
    of = tmp_path / {"run": "scene.toml", "study": "study.toml"}[name]
    arguments = [name, str(of), "--workers", "2", "--out", str(tmp_path / "out")]
    (own, children) = (seconds_of(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    assert main(arguments) == 0
    own = seconds_of(resource.RUSAGE_SELF) - own
    children = seconds_of(resource.RUSAGE_CHILDREN) - children
    said = " ".join(capsys.readouterr().err.split())
    stated = float(re.search(r"\(([\d.]+) s of processor time, all processes together\)", said)[1])
    assert children > 0.3  # they did the work
    assert (
        own + 0.8 * children - 0.3 < stated < own + children + 0.1
    )  # less what the command does before and after it counts
    if name == "run":
        record = json.loads((tmp_path / "out" / "result.json").read_text())
        assert record["processor_seconds"] == pytest.approx(stated, abs=0.6)  # taken before the last files
        assert "processor time, all processes together" in (tmp_path / "out" / "report.html").read_text()
