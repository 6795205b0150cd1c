"""Tables of loggers: units in the heading, any encoding and decimal mark; what cannot be read is refused by line."""

import numpy as np
import pytest

import lubfric
from lubfric.scene import Table, Transient, read_history
from lubfric.scene.transient import history

LINES = "time [ms],speed [mm/s]\n0,1000\n500,2000\n1000,0\n"
EXPECTED = Table(times=(0.0, 0.5, 1.0), values=(1.0, 2.0, 0.0))


def write(folder, content, code="utf-8"):
    path = folder / "run.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode(code))
    return path


@pytest.mark.parametrize("code", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize(
    "text",
    [
        LINES,
        LINES.replace(",", ";"),
        LINES.replace(",", "\t"),
        "# µ-tribometer\ntime (s);speed\n0,0;1,0\n\n0,5;2\n1;0,0\n",
        "n;speed [m/s];time [µs]\n1;1,0;0\n2;2,0;5e5\n3;0;1e6\n",
        "time,load [N], speed [ km/h ]\r\n0,9,3.6\r\n0.5,9,7.2\r\n1,9,0\r\n",
    ],
)
def test_every_way_to_write_the_same_table(tmp_path, text, code):
    result = read_history(write(tmp_path, text, code), "speed", unit="m/s")
    np.testing.assert_allclose(result.times, EXPECTED.times, rtol=1e-15)
    np.testing.assert_allclose(result.values, EXPECTED.values, rtol=1e-15)


@pytest.mark.parametrize(
    "name, unit, heading, si",
    [
        ("bodies.load", "N", "F [kN]", 2000),
        ("transient.viscosity", "Pa s", "F (mPa·s)", 2e-3),
        ("lubricant.viscosity", "Pa s", "F [Pa.s]", 2),
        ("transient.radius", "m", "F [mm]", 2e-3),
        ("transient.sliding", "m/s", "F [um/s]", 2e-6),
    ],
)
def test_each_quantity_has_its_units(tmp_path, name, unit, heading, si):
    write(tmp_path, f"time,{heading}\n0,2\n1,2\n")
    table = {"kind": "file", "file": "run.csv", "column": "F"}
    assert history(name, table, unit, tmp_path).at(0.5) == pytest.approx(si)
    with pytest.raises(lubfric.InputError, match=f"{name}: .* unit .* is not known"):
        history(name, table, "N" if unit != "N" else "m", tmp_path)


@pytest.mark.parametrize(
    "content, words",
    [("time [fortnight],speed\n0,1\n1,1\n", "fortnight"), ("time,speed [N]\n0,1\n1,1\n", "'N' is not known")]
    + [("time,speed,speed\n0,1,2\n1,1,2\n", "2 columns 'speed'"), ("time;speed\n0;1.234,5\n1;1\n", "line 2")]
    + [
        ("time,speed\n0,1\n1\n", "line 3"),
        ("time,speed\n0,1\n1,nan\n", "line 3"),
        ("time,speed\n0,1\n1,\n", r"\(speed\): the cell is empty"),
        ("time,speed\n", "1 rows"),
    ]
    + [(b"time,speed\n\x00\x01\x02", "not text"), (b"time,speed\n0,\x81\n1,2", "not text")]
    + [('time,speed\n0,"1\n1,2"\n', "not a number")],
)
def test_bad_files_are_refused_by_name_and_line(tmp_path, content, words):
    path = write(tmp_path, content)
    with pytest.raises(lubfric.InputError, match=words) as caught:
        read_history(path, "speed", unit="m/s")
    assert "run.csv" in str(caught.value)


@pytest.mark.parametrize("heading", ["U mm/s", "U/mm/s", "speed_mm_s", "U in km/h", "v {cm/s}", "mm/s", "U, µm/s"])
def test_a_unit_without_brackets_is_not_taken_for_si(tmp_path, heading):
    path = write(tmp_path, f"time;{heading}\n0;100\n1;200\n")
    for unit in ("m/s", None):
        with pytest.raises(lubfric.InputError, match=r"without brackets.*\[m/s\]"):
            read_history(path, heading, unit=unit)
    with pytest.raises(lubfric.InputError, match="names ms without brackets"):
        read_history(write(tmp_path, "t/ms;U\n0;1\n1;2\n"), "U", time_column="t/ms")


@pytest.mark.parametrize("heading", ["slip %", "slip%", "slip, %", "SRR100%"])
def test_per_cent_without_brackets_are_not_taken_for_shares(tmp_path, heading):
    path = write(tmp_path, f"time;{heading}\n0;5\n1;10\n")
    for unit in ("-", None):
        with pytest.raises(lubfric.InputError, match="names % without brackets"):
            read_history(path, heading, unit=unit)


@pytest.mark.parametrize("heading", ["U m/s", "U_m_s", "Umm", "alarms", "mm/s (m/s)", "h", "P"])
def test_a_heading_that_names_no_other_unit_is_si(tmp_path, heading):
    path = write(tmp_path, f"time s;{heading}\n0;100\n1;200\n")
    for unit in ("m/s", None):
        assert read_history(path, heading, time_column="time s", unit=unit).values == (100.0, 200.0)


@pytest.mark.parametrize("repeat", ["no", 0, None, 1.0])
def test_repeat_is_a_truth_value(repeat):
    with pytest.raises(lubfric.InputError, match="repeat"):
        history("speed", {"kind": "table", "times": [0, 1], "values": [1, 2], "repeat": repeat})


@pytest.mark.parametrize(
    "table, words",
    [({"kind": "file", "file": 3, "column": "speed"}, "file = 3")]
    + [({"kind": "file", "file": "a\0b", "column": "speed"}, "file")]
    + [({"kind": "file", "file": "run.csv"}, "needs column")]
    + [({"kind": "file", "file": ".", "column": "speed"}, "does not exist")]
    + [({"kind": "table", "times": [0, True], "values": [1, 2]}, "truth values"), ({"kind": ["ramp"]}, "kind")]
    + [({"kind": "ramp", "value": 3.0}, "unknown key 'value'"), ({"kind": "ramp", "start": "1"}, "start")],
)
def test_bad_tables_of_a_scene_are_refused(tmp_path, table, words):
    write(tmp_path, LINES)
    with pytest.raises(lubfric.InputError, match=words):
        history("speed", table, "m/s", tmp_path)


def test_too_many_repetitions_are_refused():
    with pytest.raises(lubfric.InputError, match="repeated 1e"):
        Transient(1.0, speed=Table(times=(0.0, 1e-9), values=(0.0, 1.0), repeat=True))


def test_a_message_names_the_key_that_was_written(tmp_path):
    """A history in its own section is told by that key, one in [transient] by the one there."""
    write(tmp_path, LINES)
    text = lubfric.load_scene("paper").to_toml()
    given = '{ kind = "file", file = "run.csv", column = "speed" }\n'
    lines = [line for line in text.splitlines() if not line.startswith(("entrainment_speed", "speeds"))]
    at = lines.index("[motion]") + 1
    for place, name in ((f"entrainment_speed = {given}", "motion.entrainment_speed"), ("", "transient.speed")):
        plan = "\n[transient]\nduration = 3.0\n" + ("" if place else f"speed = {given}")
        (tmp_path / "s.toml").write_text("\n".join([*lines[:at], place, *lines[at:]]) + plan)
        with pytest.raises(lubfric.InputError, match=f"{name}: the table ends at 1 s, the run lasts 3 s"):
            lubfric.load_scene(tmp_path / "s.toml")
