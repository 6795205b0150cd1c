"""Likely slips: every usual range holds the built-in scenes, and a value in a mistaken unit is told with the right
one."""

import pickle
import tomllib
from dataclasses import replace

import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric.output import describe_scene, main
from lubfric.quantities import KEYS
from lubfric.scene import Harmonic, Table, unusual_values
from lubfric.scene.plausible import slip
from lubfric.units import converted, printed

OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 343.15}


@pytest.mark.parametrize("name", ["paper", "flat"])
def test_built_in_scenes_are_usual(name):
    assert unusual_values(lubfric.load_scene(name)) == ()


@pytest.mark.parametrize("name", [name for name, q in KEYS.items() if q.meant])
def test_a_usual_value_in_each_mistaken_unit_is_found_out(name):
    (low, high) = KEYS[name].usual
    unit = KEYS[name].unit
    middle = (max(low, high / 1e6) * high) ** 0.5
    assert slip(name, middle) is None
    for other in KEYS[name].meant:
        given = converted(middle, unit, other if isinstance(other, str) else other[0])
        if not low <= given <= high:
            meant = slip(name, given)
            assert meant and meant.startswith("did you mean ") and printed(unit) in meant
    assert slip(name, [middle, middle]) is None


def test_a_value_that_no_unit_explains_is_still_reported():
    (result,) = unusual_values(lubfric.load_scene("paper").with_(bodies={"radius": 900.0}))
    assert (result.key, result.value, result.limit, result.unit) == ("bodies.radius", 900.0, 1.0, "m")
    assert "900 mm (0.9 m)" in result.question


def test_an_error_carries_what_it_says():
    """Quantity, range and hints are data, and words only in its text; they survive a process."""
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene("paper").with_(counterface={"sq": 5.0, "correlation_length": 1e-5})
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.quantity == "counterface.sq" and error.allowed == "0 to 1 m"
    assert error.hints == ("counterface.sq = 5 is read as 5 m; did you mean 5 µm (5e-06 m)?",)
    error.hint("another")
    error.hint("another")
    worded = f"{error.quantity}{error.said}; allowed: {error.allowed}"
    assert str(error) == f"{error.hints[0]} another If not: {worded}"
    plain = lubfric.InputError(" = 5 m", "x")
    plain.hint("the file says 'did you mean'.")
    assert str(plain) == "the file says 'did you mean'. x = 5 m"
    plain.hint("is x in millimetres?", asks=True)
    assert str(plain) == "the file says 'did you mean'. is x in millimetres? If not: x = 5 m"


@pytest.mark.parametrize(
    "motion, question",
    [
        ({"slip_percent": 0.01}, "Did you mean slide_roll_ratio = 0.01, which is 1 %?"),
        ({"slip_percent": "0.01 %"}, ""),
        ({"slip_percent": 0.5}, ""),
        ({"slip_percent": 0}, ""),
        ({"slide_roll_ratio": 1}, "Did you mean slip_percent = 1?"),
        ({"slide_roll_ratio": "100 %"}, ""),
        ({"slide_roll_ratio": 2}, ""),
        ({"slide_roll_ratio": 0.01}, ""),
    ],
)
def test_a_sliding_that_looks_like_the_other_convention_is_questioned(motion, question, tmp_path):
    """In a file and in the result; a ratio that a call sets, as traction curves do, is what it is."""
    text = lubfric.load_scene("paper").to_toml()
    lines = [line for line in text.splitlines() if not line.startswith("slide_roll_ratio")]
    ((key, value),) = motion.items()
    at = lines.index("[motion]") + 1
    lines.insert(at, f"{key} = {value!r}".replace("'", '"'))
    (tmp_path / "scene.toml").write_text("\n".join(lines))
    scene = lubfric.load_scene(tmp_path / "scene.toml").with_(numerics={"model": "paper", "sampling": "patch"})
    texts = [entry.text for entry in lubfric.friction(scene, 0.1).validity if entry.what.startswith("motion.")]
    assert [question in text for text in texts] == [True] * bool(question)
    assert scene.with_(motion={"slide_roll_ratio": 1.0}).doubtful == ()
    ratio = scene.motion.slide_roll_ratio
    assert scene == scene.with_(motion={"slide_roll_ratio": ratio})  # the doubt is no part of the problem


def test_the_ratio_of_given_speeds_is_in_no_other_unit():
    """U = 0.1 m/s and 2 m/s of sliding: a ratio of 20, which 20 % were not meant to be; the limit has the sign of the
    value."""
    paper = lubfric.load_scene("paper")
    speeds = {"surface_speeds": [-0.9, 1.1], "entrainment_speed": None, "slide_roll_ratio": None}
    assert unusual_values(paper.with_(motion=speeds)) == ()
    (unusual,) = unusual_values(paper.with_(motion={"entrainment_speed": -3000}))
    assert (unusual.value, unusual.limit) == (-3000, -100)


def test_the_likely_cause_begins_a_message():
    """A load that its own unit makes heavy is refused for the Hertz area; the unit comes first."""
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene("paper").with_(bodies={"hardness": 700})
    assert str(caught.value).startswith(
        "bodies.hardness = 700 is read as 700 Pa; did you mean 700 HV (7.404e+09 Pa)? Give hardness_hv. If not: "
        "bodies.load"
    )


def test_a_doubtful_ratio_keeps_its_sign_in_a_message_with_one_alternative():
    given = lubfric.load_scene("paper").to_toml().replace("slide_roll_ratio = 2.0", "slide_roll_ratio = -1.5")
    lines = [line for line in given.splitlines() if not line.startswith(("shape", "spacing"))]
    with pytest.raises(lubfric.InputError, match="contact.shape") as caught:
        lubfric.friction(lubfric.load_scene(tomllib.loads("\n".join(lines))))
    assert "slip_percent = -1.5?" in str(caught.value) and '"-150 %" if the ratio is meant.' in str(caught.value)
    assert str(caught.value).count("If not") == 1


def test_a_height_in_another_unit_is_questioned_by_the_key_that_was_written():
    paper = lubfric.load_scene("paper")
    with pytest.raises(lubfric.InputError, match="^surface.ra = 150 is read as 150 m; did you mean 150 nm"):
        paper.with_(surface={"ra": 150})
    with pytest.raises(lubfric.InputError, match="^surface.ra = 0.15 is read as 0.15 m; did you mean 0.15 µm"):
        lubfric.prepare(paper.with_(surface={"ra": 0.15}))
    (unusual,) = unusual_values(paper.with_(surface={"ra": "150 um"}))
    assert unusual.key == "surface.ra" and unusual.written == "150 um"
    assert unusual.question == "did you mean 150 nm (1.5e-07 m)?"


@pytest.mark.parametrize(
    "section, given, key, question",
    [
        ("surface", {"correlation_length": "10 mm"}, "surface.correlation_length", "did you mean 10 µm (1e-05 m)?"),
        ("surface", {"ra": "0.15 mm"}, "surface.ra", "did you mean 0.15 µm (1.5e-07 m)?"),
        ("bodies", {"radii": [3, 30]}, "bodies.radii", "did you mean 3 mm and 30 mm?"),
        ("bodies", {"radii": [0.01, 30]}, "bodies.radii", "did you mean 30 mm (0.03 m)?"),
        ("lubricant", {"eyring_stress": 5}, "lubricant.eyring_stress", "did you mean 5 MPa (5e+06 Pa)?"),
    ],
)
def test_a_slip_is_reported_by_the_key_and_the_number_that_were_written(section, given, key, question):
    """In the number as it was written, 10 of "10 mm", not in that of the unit of the key; and no more once mended."""
    paper = lubfric.load_scene("paper")
    scene = paper.with_(**{section: given})
    assert [(entry.key, entry.question) for entry in unusual_values(scene) if entry.question] == [(key, question)]
    assert unusual_values(scene.with_(lubricant={"viscosity": 0.1})) == unusual_values(scene)
    usual = {
        "surface": {"sq": 1e-7, "correlation_length": 1e-5},
        "bodies": {"radius": 0.01},
        "lubricant": {"eyring_stress": 5e6},
    }
    assert unusual_values(scene.with_(**{section: usual[section]})) == ()


def test_a_key_in_capitals_is_the_key_itself():
    with pytest.raises(lubfric.InputError, match=r"unknown key 'Ra' in \[surface\] \(did you mean 'ra'\?\)"):
        lubfric.load_scene("paper").with_(surface={"Ra": "0.15 um"})


def test_a_grade_that_is_none_is_refused_before_its_index_is_missed():
    with pytest.raises(lubfric.InputError, match="an SAE grade is not an ISO grade"):
        lubfric.load_scene("paper").with_(lubricant={"grade": "SAE 10W-30", "temperature": 343.15})


def test_a_number_in_another_unit_is_refused_before_any_work(tmp_path, capsys, monkeypatch):
    text = BODIES_AND_OIL.replace("radius = 2e-3", "radii = [3, 30]") + "[motion]\nentrainment_speed = 0.1\n"
    (tmp_path / "scene.toml").write_text(text + SMALL_PATCH)
    monkeypatch.setattr("lubfric.output.commands.prepare", None)  # no map is made
    assert main(["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert "not valid: bodies.radii" in said and "Did you mean 3 mm and 30 mm?" in said
    assert not (tmp_path / "out").exists()


def test_what_is_unusual_begins_the_description_of_a_scene():
    scene = lubfric.load_scene("paper").with_(lubricant={"eyring_stress": 5})
    first = describe_scene(scene).splitlines()[0]
    assert first.startswith("not valid: lubricant.eyring_stress") and "5 MPa" in first


@pytest.mark.parametrize(
    "section, given, is_refused",
    [
        ("lubricant", {"eyring_stress": 5}, True),
        ("lubricant", {"eyring_stress": "5 Pa"}, False),  # the unit was written
        ("bodies", {"radii": [6, 30]}, True),
        ("bodies", {"radii": [6, 8]}, True),  # twice the usual ones
        ("bodies", {"radii": ["6 m", "8 m"]}, False),  # the unit was written
        ("bodies", {"radius": 2.0}, False),  # twice the usual one
        ("bodies", {"load": 4e6, "width": 9.0, "hardness": None}, False),  # nine times the usual one
        ("bodies", {"radius": 900.0}, True),
        ("lubricant", {"limiting_stress_coefficient": 0.6}, False),  # no unit explains it
    ],
)
def test_a_plain_number_in_another_unit_by_orders_is_refused_unless_accepted(section, given, is_refused):
    scene = lubfric.load_scene("paper").with_(**{section: given})
    assert unusual_values(scene)
    violations = [each for each in lubfric.prepare(scene).violations if each.what.startswith(section)]
    assert any(each.severe for each in violations) == is_refused
    assert all("Did you mean" in each.text for each in violations if each.severe)


CAM = Table(times=(0.0, 0.01, 0.04), values=(1.0, 2.0, 1.0), repeat=True)
HOURS = "the table of motion.entrainment_speed lasts 40 ms, and the run has 3,000 of them"
WITHOUT_UNIT = "the table of motion.entrainment_speed lasts 40 s, 1,000 times as long"


@pytest.mark.parametrize(
    "duration, speed, told",
    [
        (120.0, CAM, HOURS),
        (0.04, replace(CAM, times=(0.0, 10.0, 40.0)), WITHOUT_UNIT),
        (0.12, Harmonic(amplitude=1.0, frequency=1000.0), "is 1 ms, and the run has 120 of them"),
        (0.12, Harmonic(amplitude=1.0, frequency=0.01), "is 100 s, 833 times as long"),
        (0.08, CAM, ""),
        (0.004, CAM, ""),
        (0.12, Harmonic(amplitude=1.0, frequency=16.67), ""),
    ],
)
def test_a_time_in_another_unit_is_questioned(duration, speed, told):
    plan = lubfric.Transient(duration, speed=speed, load=5.0)
    found = unusual_values(lubfric.load_scene("paper").with_(transient=plan))
    assert bool(found) == bool(told) and all(told in value.question for value in found)
    assert all(value.key == "transient.duration" and "unit?" in value.question for value in found)
