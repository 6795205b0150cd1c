"""A wrong key leads to the right one, by the words that others use or by its letters; what is no value is refused in
words."""

import threading

import pytest

import lubfric

PAPER = {
    "bodies": {"radius": 2e-3, "width": 6e-3, "load": 5.5, "e_prime": 231e9, "boundary_friction_coefficient": 0.1},
    "lubricant": {"viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9},
    "motion": {"entrainment_speed": 0.1},
    "surface": {"sq": 1e-7, "correlation_length": 8e-6},
}


def scene(**sections):
    """A scene with other keys: the dict of each section in ``sections`` over that of `PAPER`."""
    table = {name: {**PAPER.get(name, {}), **keys} for name, keys in (PAPER | sections).items()}
    return lambda: lubfric.load_scene(table)


@pytest.mark.parametrize(
    "section, key, meant",
    [("bodies", "diameters", "'radii' in m, half of the diameters"), ("bodies", "length", "'width' in m")]
    + [("bodies", "E", "'young_modulus' and 'poisson_ratio'"), ("oil", "grade", r"\[lubricant\]")]
    + [("lubricant", "alpha", "'pressure_viscosity_coefficient'"), ("motion", "SRR", "'slide_roll_ratio'")]
    + [("numerics", "tolerence", "'tolerance'"), ("motion", "entrainment-speed", "'entrainment_speed'")],
)
def test_a_wrong_key_leads_to_the_right_one(section, key, meant):
    with pytest.raises(lubfric.InputError, match=rf"unknown key .*did you mean {meant}"):
        scene(**{section: {key: 1.0}})()


def test_a_number_that_has_to_be_positive_is_told_so():
    with pytest.raises(lubfric.InputError, match="load = -800 N is out of range, as it has to be positive"):
        scene(bodies={"load": "-800 N"})()
    with pytest.raises(lubfric.InputError, match="does not convert to N.*a load per length times .*bodies.width"):
        scene(bodies={"load": "80 N/mm"})()


def test_a_key_like_no_other_has_no_guess():
    with pytest.raises(lubfric.InputError, match=r"unknown key 'qqqq' in \[bodies\]; allowed: radius"):
        scene(bodies={"qqqq": 1.0})()


def itself():
    made = []
    made.append(made)
    return made


ODD = {"generator": lambda: (u for u in (1.0, 2.0)), "lock": threading.Lock, "list of itself": itself}
PLACES = (
    "bodies.radius bodies.radii motion.speeds motion.surface_speeds motion.speed_range contact.shape contact.spacing "
    "contact.model surface.correlation_length surface.seed counterface.file lubricant.viscosity_table lubricant.oil "
    "lubricant.grade transient.speed transient.duration numerics.accept"
).split()


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", ODD)
def test_what_is_no_value_is_refused_in_words(kind, place):
    section, _, key = place.partition(".")
    table = {name: dict(keys) for name, keys in PAPER.items()}
    for name in ("radius",) if key == "radii" else ("viscosity",) if section == "lubricant" else ():
        table[{"radius": "bodies", "viscosity": "lubricant"}[name]].pop(name)
    table.setdefault(section, {})[key] = ODD[kind]()
    if key == "grade":
        table["lubricant"] |= {"viscosity_index": 95, "temperature": 340.0}
    with pytest.raises(lubfric.InputError):
        lubfric.load_scene(table)


@pytest.mark.parametrize("kind", ODD)
def test_what_is_no_table_is_refused_in_words(kind):
    for table in (PAPER | {"contact": ODD[kind]()}, PAPER | {"name": ODD[kind]()}):
        with pytest.raises(lubfric.InputError):
            lubfric.load_scene(table)


def test_a_dict_of_a_scene_stays_as_it_is(tmp_path):
    (tmp_path / "map.npy").touch()
    table = {name: dict(keys) for name, keys in PAPER.items()} | {"contact": {"shape": [8, 8], "spacing": 1e-6}}
    before = repr(table)
    lubfric.load_scene(table, surface_file=tmp_path / "map.npy", counterface_file=tmp_path / "map.npy")
    assert repr(table) == before


QUICK = {"sampling": "patch", "model": "paper"}


def test_a_slide_roll_ratio_in_percent_is_questioned_and_still_solved():
    """3 was meant to be 3 %. A ratio of 3 is possible, where the surfaces move against one another."""
    requested = lubfric.load_scene("paper").with_(motion={"slide_roll_ratio": 3.0}, numerics=QUICK)
    point = lubfric.friction(requested.with_(numerics={"tolerance": 0.1}), 0.1)
    stated = [entry.text for entry in point.validity if "slide" in entry.what]
    assert (
        stated
        and all("warning" in text for text in stated)
        and "3 % (0.03)" in stated[0]
        and "slip_percent" in stated[0]
    )
    usual = lubfric.friction(requested.with_(motion={"slide_roll_ratio": 2.0}, numerics={"tolerance": 0.1}), 0.1)
    assert not any("slide" in entry.what for entry in usual.validity)


@pytest.mark.parametrize("key", ["width", "load", "boundary_friction_coefficient"])
def test_a_forgotten_key_beside_values_with_units_is_named(key):
    bodies = {
        "radii": ["6 mm", "30 mm"],
        "width": "14 mm",
        "load": "2 kN",
        "material": "100Cr6",
        "boundary_friction_coefficient": 0.1,
    }
    lubricant = {"viscosity": 0.02, "pressure_viscosity_coefficient": 2e-8}
    surface = {"sq": 1e-7, "correlation_length": 1e-5}
    tables = {"bodies": bodies, "lubricant": lubricant, "surface": surface, "motion": {"entrainment_speed": 1.0}}
    tables["contact"] = {"shape": (64, 64), "spacing": 2e-6}
    del bodies[key]
    with pytest.raises(lubfric.InputError, match=f"needs '{key}'"):
        lubfric.load_scene(tables)


BROKEN = {  # text of a scene: what the message says of it
    '[bodies]\nload = "2 kN\n': "line 2: a text has no closing quotation mark; add it",
    "[bodies]\nload = 2\n[bodies]\nwidth = 1\n": "line 3: this section or key is there for the second time",
    "bodies = {load = 2}\nbodies = {width = 1}\n": "line 2: this section or key is there for the second time",
    "[bodies]\nload = [2\n": "a list has no closing bracket; add ]",
    "[lubricant]\neyring_stress = mineral\n": "line 2: write numbers with a decimal point; put names and numbers with a unit in quotes: "
    "'mineral', '12 mm'",
    "[bodies]\nload = 0,06\n": "line 2: write numbers with a decimal point",
}


@pytest.mark.parametrize("text", BROKEN)
def test_a_file_that_is_no_toml_is_explained_by_its_line(tmp_path, text):
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene(tmp_path / "scene.toml")
    assert f"({BROKEN[text]}" in str(caught.value) and "is not valid TOML: " in str(caught.value)


@pytest.mark.parametrize(
    "section, key, place",
    [
        ("bodies", "temperature", "[lubricant]"),
        ("lubricant", "hardness_hv", "[bodies]"),
        ("motion", "tolerance", "[numerics] or [transient]"),
        ("numerics", "spacing", "[surface] or [contact]"),
        ("bodies", "file", "[surface]"),
    ],
)
def test_a_key_of_another_section_is_named_with_that_section(section, key, place):
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene("paper").with_(**{section: {key: 1.0}})
    assert f"unknown key {key!r} in [{section}] (did you mean {key!r} in {place}?)" in str(caught.value)


@pytest.mark.parametrize(
    "section, key, value, words",
    [
        ("numerics", "model", "fast", "did you mean 'quick'?"),
        ("numerics", "model", "Exact", "did you mean 'deterministic'?"),
        ("contact", "geometry", "barrel", "did you mean 'cylinder'?"),
        ("surface", "outliers", "remove", "did you mean 'mask'?"),
        ("bodies", "load", "2,5 kN", "write a point in decimals, 2.5 kN;"),
        ("lubricant", "eyring_stress", ["10 MPa", "2 MPa"], "= ['10 MPa', '2 MPa']: low and high are exchanged"),
        ("surface", "seed", "a", "a whole number from 0 to 2^128 - 1"),
        ("numerics", "workers", 0, "a whole number from 1 to "),
    ],
)
def test_a_wrong_value_is_shown_as_it_was_written_with_what_to_write(section, key, value, words):
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene("paper").with_(**{section: {key: value}})
    assert words in str(caught.value)


def test_the_file_of_a_study_is_no_scene():
    with pytest.raises(lubfric.InputError, match="file of a study.*lubfric study FILE"):
        lubfric.load_scene({"scene": "paper", "speeds": [0.1], "vary": {"surface.sq": [1e-7]}})
