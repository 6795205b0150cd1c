"""Charts: data survive the round trip, exponents are fitted, errors are told apart, points come out sane."""

import json

import numpy as np
import pytest

from verification.__main__ import main
from verification.charts import contact, draw
from verification.charts.data import interleaved, load, measured_on, point
from verification.charts.growth import exponent
from verification.opponents import CONTACT


def sample(n, power=1.5):
    at = {"memory": 0.0, "work": 20.0}
    return [
        point("contact", "contact", str(k), 1.0, (1e-6 * k**power, 0.0, 0.0), **at | {"size": k, "memory": 8.0 * k})
        for k in n
    ]


def written(folder, **charts):
    """A report.json with these points, measured long ago."""
    studies = [
        {
            "name": name,
            "checks": [c.as_dict() for c in points],
            "tables": [{"name": f"{name}_machine", "rows": [["an abacus"]]}],
        }
        for name, points in charts.items()
    ]
    (folder / "report.json").write_text(json.dumps({"studies": studies}))


def test_points_survive_the_report(tmp_path):
    points = sample((10, 100, 1000))
    written(tmp_path, growth=points, contact=sample((1,)))
    assert load(tmp_path, "growth") == points


@pytest.mark.parametrize("power", [1.0, 1.5, 2.9])
def test_exponents(power):
    points = sample((16, 64, 256, 1024, 4096), power)
    assert exponent(points, "seconds") == pytest.approx(power)
    assert exponent(points, "memory") == pytest.approx(1.0)
    assert exponent(points, "work") == pytest.approx(0.0, abs=1e-12)


def test_repeats_are_interleaved():
    order = []
    calls = {name: lambda name=name: order.append(name) for name in "ab"}
    found = interleaved(calls, 3)
    assert order == list("ababab")
    median, low, high = found["a"][1]
    assert 0 <= low <= median <= high


def test_coarser_grids_sample_the_same_surface():
    fine, coarse = contact.heights(128, "gaussian"), contact.heights(64, "gaussian")
    assert np.array_equal(fine[::2, ::2], coarse)


def test_methods_agree_and_errors_fall_with_the_tolerance():
    z = contact.heights(64, "exponential")
    points = list(contact.panel(z, 200e6, "periodic", "test", (1e-3, 1e-6), quick=True))
    ours = [p.measured for p in points if p.at["method"] == "lubfric"]
    assert ours[1] < 1e-5 < 1e-2 and ours[1] < ours[0] < 0.1
    tight = {p.at["method"]: p.measured for p in points if p.at["setting"] == "tolerance 1e-06"}
    assert set(tight) >= {"lubfric", "plain Polonsky-Keer", "paper, single loop", "paper, alternating"}
    assert max(tight.values()) < 1e-3
    assert [p.at["setting"] for p in points if p.at["default"]] == ["tolerance 1e-06"]


def test_opponents_give_none_where_they_are_not_installed(monkeypatch):
    import sys

    z = contact.heights(64, "gaussian")
    for name in ("aspher", "tamaas"):
        monkeypatch.setitem(sys.modules, name, None)
        assert CONTACT[name](z, 1e-6, 231e9) is None


def test_redraw_from_saved_data(tmp_path):
    spread = (0.1, 0.09, 0.12)
    dots = [
        point("a", "lubfric", "tolerance 1e-06", 1e-7, spread, default=True),
        point("b", "lubfric", "64²", 0.01, spread, apart=True),
    ]
    written(tmp_path, growth=sample((10, 100, 1000, 10000)), contact=dots)
    out = tmp_path / "again"
    assert main(["charts", "--redraw", str(tmp_path), "--only", "growth", "contact", "--out", str(out)]) == 0
    assert (out / "contact.png").stat().st_size > 1000 and (out / "growth.png").stat().st_size > 1000
    assert load(out, "contact") == dots
    assert measured_on(out, "contact") == "an abacus"  # not the machine that draws
    assert draw.palette([]) == {}


@pytest.mark.slow
def test_quick_charts(tmp_path):
    assert main(["charts", "--quick", "--out", str(tmp_path)]) == 0
    assert len(list(tmp_path.glob("*.png"))) == 4
