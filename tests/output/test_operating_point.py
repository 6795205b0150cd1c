"""The scene's own speed is solved beside its speed range, and named: in the messages, the table, the picture, the
report."""

import json
import re
import tomllib

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL

import lubfric
from lubfric.output import describe_scene, main, negative_in_words

SURFACE = "[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\n[contact]\nshape = [64, 64]\nspacing = 0.9e-6\n"
NUMERICS = '[numerics]\nsampling = "patch"\nmodel = "paper"\ntolerance = 0.2\n'


def scene(motion):
    return f"{BODIES_AND_OIL}[motion]\n{motion}\n{SURFACE}{NUMERICS}"


def ran(tmp_path, motion, *options):
    (tmp_path / "scene.toml").write_text(scene(motion))
    assert main(["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out"), *options]) == 0
    page = (tmp_path / "out" / "report.html").read_text()
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    return [point["speed"] for point in record["points"]], page, record


def test_a_speed_of_the_scene_outside_its_range_is_solved_and_named(tmp_path, capsys):
    speeds, page, record = ran(tmp_path, "entrainment_speed = 0.05\nspeed_range = [0.01, 0.1, 2]")
    assert speeds == [0.01, 0.05, 0.1]
    assert "2 speeds in the scene; added: 0.05 m/s" in " ".join(capsys.readouterr().err.split())
    assert "at U = 0.05 m/s, the operating point of the scene" in page
    assert [row for row in re.findall(r"<td[^>]*>([^<]*)</td>", page) if "operating" in row] == [
        "0.05 (operating point)"
    ]
    assert record["operating_point"] == 0.05
    svg = ["plot", str(tmp_path / "out"), "--format", "svg"]
    assert main(svg) == 0 and "operating point" in (tmp_path / "out" / "stribeck.svg").read_text()


@pytest.mark.parametrize(
    "speed, solved",
    [(0.1 * (1 + 1e-12), [0.01, 0.1]), (0.0, [0.01, 0.1]), (-0.05, [0.01, 0.1]), (0.5, [0.01, 0.1, 0.5])],
)
def test_info_counts_the_speeds_that_a_run_solves(speed, solved):
    """A speed that is one of the range but for rounding is no second one; none at rest or in the other direction
    belongs to the curve."""
    given = tomllib.loads(scene(f"entrainment_speed = {speed!r}\nspeed_range = [0.01, 0.1, 2]"))
    assert f"for {len(solved)} speeds" in " ".join(describe_scene(lubfric.load_scene(given)).split())


def test_speeds_of_the_command_alone_are_solved_and_the_first_lines_say_so(tmp_path, capsys):
    why = (
        "The scene&#x27;s own speed, 0.05 m/s (motion.entrainment_speed), is not solved, because --speeds does not "
        "contain it."
    )
    speeds, page, _ = ran(tmp_path, "entrainment_speed = 0.05", "--speeds", "0.01,0.1")
    assert speeds == [0.01, 0.1] and page.split('<p class="answer">')[1].split("<li>")[1].startswith(why)
    # by ratio 0.1 m/s is the nearest speed, by difference 0.01 m/s
    assert "at U = 0.1 m/s" in page.split('<p class="answer">')[1].partition("</p>")[0]
    assert np.load(tmp_path / "out" / "fields.npz")["speed"].tolist() == [0.1]
    first = " ".join(capsys.readouterr().err.split("scene: preparing")[0].split())
    assert why.replace("&#x27;", "'") in first
    again = tmp_path / "out" / "resolved.toml"
    assert main(["run", str(again), "--out", str(tmp_path / "again")]) == 0
    both = [(tmp_path / name / "stribeck.csv").read_bytes() for name in ("out", "again")]
    assert both[0] == both[1]


@pytest.mark.parametrize("option", ["--speeds=0.01,0.1", "--ratios=0.1,0.2"])
def test_info_estimates_the_points_that_a_run_with_the_same_option_solves(tmp_path, capsys, option):
    """A row of the operating point was in the table of speeds that the run did not solve; of ratios one point was
    estimated."""
    (tmp_path / "scene.toml").write_text(scene("entrainment_speed = 0.05"))
    assert main(["info", str(tmp_path / "scene.toml"), option]) == 0
    text = capsys.readouterr().out
    assert main(["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out"), option]) == 0
    stated = " ".join(capsys.readouterr().err.split()).partition("estimate: ")[2]
    (cost,) = re.findall("cost: (about .* for 2 (?:speeds|ratios) .*, and .* of 'lubfric run')", " ".join(text.split()))
    assert stated.startswith(cost)
    points = json.loads((tmp_path / "out" / "result.json").read_text())["points"]
    rows = text.partition("U [m/s]")[2].splitlines()
    listed = [row.split()[0] for row in rows if re.match(r"  0\.\d+ ", row)]
    assert listed == list(dict.fromkeys(f"{point['speed']:.4g}" for point in points))


def test_a_rolling_resistance_below_0_is_explained_where_a_table_states_it():
    assert "either sign" in negative_in_words(np.array([0.3, -0.01]))
    assert negative_in_words(np.array([0.3, 0.0])) == ""
