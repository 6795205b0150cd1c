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
