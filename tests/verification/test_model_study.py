"""The study of the model's error: what it gathers, and that it sees a wrong model."""

import numpy as np
import pytest

import lubfric
from verification import kept
from verification.model import grids, loads, measured
from verification.model.measure import METHODS, REFERENCE, Point, Setting, all_points
from verification.model.summary import deviations

SETTING = Setting(1, "gaussian", 5.5, "Newtonian", (0.01, 0.003), 32)


def made(speed, method, f, share=0.5):
    return Point(SETTING, speed, method, f, share, 1e-7, 1.0, 0.1)


def test_mean_rms_and_failures_are_against_the_reference():
    other = "one-way"
    found = deviations(
        [made(0.01, REFERENCE, 0.1), made(0.01, other, 0.11, 0.6), made(0.003, REFERENCE, 0.1),
         made(0.003, other, float("nan"))]
    )  # fmt: skip
    good = next(d for d in found if d.method == other and d.speed == 0.01)
    failed = next(d for d in found if d.method == other and d.speed == 0.003)
    assert np.isclose(good.mean, 0.1) and np.isclose(good.rms, 0.1) and np.isclose(good.share_mean, 0.1)
    assert failed.failures == 1 and np.isnan(failed.mean)


def test_every_model_answers_the_same_scene():
    found = all_points([SETTING], methods=tuple(m for m in METHODS if m != "hertz, total"))
    assert not any(p.failure for p in found) and len(found) == 10
    f = {p.method: p.coefficient for p in found if p.speed == 0.003}
    assert max(f.values()) < 1.2 * min(f.values()) and len(set(f.values())) == 5


def test_what_is_kept_is_not_solved_again(tmp_path, monkeypatch):
    file, settings, methods = tmp_path / "points.jsonl", [SETTING], ('Eq. (8) over "hertz"',)
    once = all_points(settings, file, methods)
    monkeypatch.setattr("verification.model.measure._sweep", lambda *of: 1 / 0)
    assert all_points(settings, file, methods) == once and len(once) == 2
    with pytest.raises(ZeroDivisionError):
        all_points(settings, file, ("one-way",))


def test_a_line_that_was_not_written_to_its_end_is_written_again(tmp_path):
    file, solved = tmp_path / "rows.jsonl", []

    def solve(key):
        solved.append(key)
        return [key, float("nan")]

    assert list(kept.each(file, "ab", solve)) == [["a", None], ["b", None]]
    file.write_text(file.read_text()[:-3])
    assert list(kept.each(file, "abc", solve)) == [["a", None], ["b", None], ["c", None]]
    assert solved == ["a", "b", "b", "c"] and len(kept.read(file)) == 3


def test_rows_of_other_code_are_refused_unless_asked_for(tmp_path, monkeypatch):
    file = tmp_path / "rows.jsonl"
    assert list(kept.each(file, "ab", str.upper)) == ["A", "B"]
    ours = kept.code_of(file)
    monkeypatch.setattr(kept, "code", lambda: "lubfric 9, source of tomorrow")
    with pytest.raises(kept.OtherCode, match="--go-on"):
        list(kept.each(file, "abc", str.upper))
    kept.adopt(file)
    kept.adopt(file)
    assert list(kept.each(file, "abc", str.upper)) == ["A", "B", "C"]
    codes = [line for line in file.read_text().splitlines() if kept.CODE in line]
    assert len(codes) == 2 and ours in codes[0] and kept.code_of(file) == kept.code()


def test_rows_from_before_codes_were_written_stay_readable(tmp_path):
    file = tmp_path / "old.jsonl"
    file.write_text('["a", 1]\n["b", 2]\n["c"')
    assert kept.read(file) == [["a", 1], ["b", 2]] and kept.code_of(file) == "not known"
    with pytest.raises(kept.OtherCode, match="not known"):
        kept.begin(file)
    kept.adopt(file)
    assert kept.begin(file) == [["a", 1], ["b", 2]]


def test_the_flag_goes_on_with_what_lies_in_the_folder(tmp_path, capsys):
    from verification.levels import main

    (tmp_path / "rows.jsonl").write_text('["a", 1]\n')
    assert main(["--quick", "--only", "switches", "--out", str(tmp_path), "--go-on", "--list"]) == 0
    assert kept.stale(tmp_path / "rows.jsonl")  # nothing is touched by a list


def test_grids_and_heavy_loads_say_what_they_found():
    row = grids.refined((16, 24, 32), "0.01 1")
    assert row[:2] == [0.01, 1] and np.isclose(row[5], 100 * (row[3] / row[4] - 1)) and 0 < row[-1] < 6
    rows = loads.swept(24, "27.5 N, 1")
    assert [r[2] for r in rows] == list(loads.SPEEDS) and not any(r[-1] for r in rows)
    assert rows[-1][4] > rows[0][4]  # the asperities carry more of the load at the lowest speed


def test_a_measured_map_is_slid_along_both_axes_of_its_file(tmp_path):
    """The map turned by a quarter is the same map slid along the other axis."""
    map_ = lubfric.generate_surface((64, 64), 90e-6 / 64, sq=100e-9, correlation_length=(5e-6, 12e-6), seed=4)
    found = {}
    for name, heights in (("as-it-is", map_.heights), ("turned", map_.heights.T)):
        np.save(tmp_path / f"{name}.npy", heights)
        surface = {"file": str(tmp_path / f"{name}.npy"), "spacing": map_.spacing, "unit": "m", "sq": None}
        scene = lubfric.load_scene("paper").with_(
            surface=surface | {"correlation_length": None}, contact={"shape": None, "spacing": None}
        )
        items = list(measured.measured_map(scene, 24, (0.003,), tmp_path / name))
        assert items[0].rows and items[1].measured == 0
        for point in measured.kept_points(tmp_path / name):
            found[point.setting.acf, point.method] = point.coefficient
    assert len(found) == 20 and len({round(f, 6) for f in found.values()}) >= 8
    for motion, method in found:
        name, _, axis = motion.rpartition(" ")
        turned = motion.replace("as-it-is", "turned")[:-1] + ("y" if axis == "x" else "x")
        assert "as-it-is" not in name or found[motion, method] == pytest.approx(found[turned, method], rel=2e-3)
