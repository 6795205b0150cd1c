"""Scenes: the built-in ones, strict reading, and a clear error for each bad value."""

import math

import numpy as np
import pytest

import lubfric
from lubfric.scene import builtin_scenes

PAPER = lubfric.load_scene("paper")


def write(folder, text):
    path = folder / "scene.toml"
    path.write_text(text)
    return path


def toml(**changes):
    """A small valid scene; ``section__key=text`` replaces or adds a line, None removes it."""
    sections = {
        "bodies": {"radius": "2e-3", "width": "6e-3", "load": "5.5", "e_prime": "231e9"}
        | {"boundary_friction_coefficient": "0.09"},
        "lubricant": {"viscosity": "0.36", "pressure_viscosity_coefficient": "25e-9"},
        "motion": {"entrainment_speed": "0.01"},
        "surface": {"sq": "1e-7", "correlation_length": "8e-6"},
        "contact": {"shape": "[64, 64]", "spacing": "0.9e-6"},
    }
    for place, value in changes.items():
        section, key = place.split("__")
        sections.setdefault(section, {})[key] = value
    return "\n".join(
        f"[{s}]\n" + "\n".join(f"{k} = {v}" for k, v in t.items() if v is not None) for s, t in sections.items()
    )


def test_paper_tables():
    assert set(builtin_scenes()) >= {"paper", "flat"}
    b = PAPER.bodies
    assert (b.radius, b.width, b.load, b.e_prime, b.hardness) == (2e-3, 6e-3, 5.5, 231e9, 6e9)
    assert b.mean_hertz_pressure == pytest.approx(102e6, rel=5e-3)  # Sec. 3.2
    assert b.half_width == pytest.approx(4.5e-6, rel=5e-3)
    assert PAPER.contact.shape == (200, 200) and PAPER.contact.spacing == 0.45e-6
    assert PAPER.motion.slide_roll_ratio == 2 and len(PAPER.motion.speeds) >= 20
    flat = lubfric.load_scene("flat")
    assert flat.bodies.hardness is None and flat.surface.sq == 240e-9 and flat.contact.shape == (816, 816)


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"bodis__load": "5.5"}, ["bodis", "did you mean 'bodies'"]),
        ({"bodies__load": "-1.0"}, ["bodies.load", "-1", "1e-12 to", " N"]),
        ({"bodies__load": "'heavy'"}, ["bodies.load", "'heavy'"]),
        ({"bodies__hardness": "1e8"}, ["bodies.load", "hardness", "allowed: below", " N"]),
        ({"lubricant__viscosity": "0.0"}, ["viscosity", "0", "Pa s"]),
        ({"lubricant__pressure_viscosity_coefficient": "0.0"}, ["pressure_viscosity_coefficient", "constant"]),
        ({"lubricant__viscosity_law": "'rolands'"}, ["did you mean 'roelands'"]),
        ({"surface__correlation_length": "-1e-6"}, ["correlation_length", "m"]),
        ({"contact__geometry": "'cylindre'"}, ["did you mean 'cylinder'"]),
        ({"contact__shape": "[0, 64]"}, ["contact.shape", "0"]),
        ({"contact__shape": "200"}, ["contact.shape", "pair"]),
        ({"contact__shape": "[200000, 200000]"}, ["contact.shape", "4e+10 cells"]),
        ({"numerics__tolerance": "1e-6"}, ["numerics.tolerance", "0.0001"]),
        ({"motion__speed_range": "[1.0, 1e-3, 4]"}, ["speed_range highest"]),
        ({"motion__surface_speeds": "[0.0, 0.6]"}, ["surface_speeds", "entrainment_speed", "give one of"]),
        (
            {"motion__speeds": "[0.1]", "motion__speed_range": "[1e-3, 1.0, 4]"},
            ["speeds and speed_range", "give one of"],
        ),
    ],
)
def test_bad_input_is_a_clear_error(tmp_path, changes, words):
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene(write(tmp_path, toml(**changes)))
    for word in words:
        assert word in str(caught.value)


def test_all_that_is_missing_is_reported_at_once(tmp_path):
    """In one message: every section, every key, and for each what else would do."""
    keys = ("width", "load", "e_prime")
    changes = {f"bodies__{key}": None for key in keys} | {"surface__sq": None, "motion__entrainment_speed": None}
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene(write(tmp_path, toml(**changes)))
    for word in (*map(repr, keys), "'sq'", "'entrainment_speed'", "surface_speeds", "hertz_pressure", "material"):
        assert word in str(caught.value)
    assert "radius" not in str(caught.value) and "[lubricant]" not in str(caught.value)
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene({})
    for section in ("bodies", "lubricant", "motion", "surface"):
        assert f"[{section}] needs" in str(caught.value)
    with pytest.raises(lubfric.InputError, match="hertz_pressure needs 'width', 'e_prime'"):
        lubfric.load_scene(
            write(
                tmp_path, toml(bodies__width=None, bodies__load=None, bodies__e_prime=None, bodies__hertz_pressure=1e9)
            )
        )
    with pytest.raises(lubfric.InputError, match="did you mean 'load'"):  # a slip comes before what it leaves missing
        lubfric.load_scene(write(tmp_path, toml(bodies__load=None, bodies__laod="5.5")))


def test_a_key_with_its_section_is_answered_with_how_to_be_changed():
    scene = lubfric.load_scene("paper")
    with pytest.raises(lubfric.InputError, match=r"with_\(numerics=\{'tolerance': 0.1\}\)"):
        scene.with_(**{"numerics.tolerance": 0.1})


def test_text_of_other_encodings(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(b"\xef\xbb\xbf" + toml().encode())  # a byte order mark is no part of the text
    assert lubfric.load_scene(path).bodies.load == 5.5
    path.write_bytes("# \u00b5".encode("latin-1") + toml().encode())
    with pytest.raises(lubfric.InputError, match="UTF-8"):
        lubfric.load_scene(path)


def test_another_surface_keeps_its_own_grid(tmp_path):
    np.save(tmp_path / "map.npy", np.zeros((4, 4)))
    scene = lubfric.load_scene("paper", surface_file=tmp_path / "map.npy")
    assert scene.surface.file.endswith("map.npy") and scene.surface.sq is None and scene.contact.shape is None
    with pytest.raises(lubfric.InputError, match="no such file"):
        lubfric.load_scene("paper", surface_file=tmp_path / "nothing.npy")


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"spacing": 0.4}, ["rms slope", "check the unit of the heights"]),
        ({"spacing": 9e-6}, ["contact.spacing", "half-width of 4.496 µm", "bodies.load = 5.5 N", "check the load"]),
        ({"shape": (8, 200), "spacing": 0.9e-6}, ["Hertz strip", "bodies.load = 5.5 N", "check the load"]),
    ],
)
def test_a_grid_that_cannot_hold_the_contact_is_an_error(changes, words):
    from lubfric.samples import check_map

    patch = {"shape": (200, 200), "spacing": 0.45e-6} | changes
    rng = np.random.default_rng(1)
    heights = rng.standard_normal(patch["shape"]) * (1.0 if "rms slope" in words else 1e-8)
    surface = lubfric.Surface(heights, patch["spacing"])
    with pytest.raises(lubfric.InputError) as caught:
        check_map(PAPER, surface, surface)
    for word in words:
        assert word in str(caught.value)


def test_with_replaces_one_value_and_is_strict():
    heavier = PAPER.with_(bodies={"load": 11.0}, name="heavier")
    assert heavier.bodies.load == 11.0 and heavier.bodies.radius == PAPER.bodies.radius
    assert PAPER.bodies.load == 5.5
    assert heavier.bodies.half_width == pytest.approx(math.sqrt(2) * PAPER.bodies.half_width)
    with pytest.raises(lubfric.InputError, match="did you mean 'load'"):
        PAPER.with_(bodies={"lod": 1.0})
    with pytest.raises(lubfric.InputError, match="did you mean 'bodies'"):
        PAPER.with_(body={"load": 1.0})
    with pytest.raises(lubfric.InputError, match="bodies = 3"):
        PAPER.with_(bodies=3)


@pytest.mark.parametrize(
    "sections, words",
    [
        ({"motion": {"slide_ratio": 1}}, ["did you mean 'slide_roll_ratio'", "speeds"]),
        ({"transient": {"duration": 1.0}}, ["transient", "allowed: a Transient"]),
        ({"transient": 3}, ["transient = 3", "Transient"]),
        ({"name": {"x": 1}}, ["name", "a str"]),
        ({"surface": lubfric.Surface(np.zeros((300, 300)), 1e-6)}, ["surface = a Surface", "a Roughness"]),
    ],
)
def test_with_names_what_is_allowed(sections, words):
    with pytest.raises(lubfric.InputError) as caught:
        PAPER.with_(**sections)
    for word in words:
        assert word in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    ("contact", "words"),
    [
        ({"geometry": "flat", "region": "box"}, "contact.region = 'box' does nothing.*geometry = 'cylinder'"),
        ({"asperity_separation": "mean-plane"}, "contact.asperity_separation = 'mean-plane' does nothing.*'summits'"),
    ],
)
def test_contact_keys_that_would_do_nothing_are_refused(contact, words):
    with pytest.raises(lubfric.InputError, match=words):
        PAPER.with_(contact=contact)


@pytest.mark.parametrize(
    "numerics, recommendation",
    [
        ({"closure": "one-way"}, "omit it, or give numerics.model = 'deterministic'"),
        ({"closure": "separation"}, "lubfric.paper"),
        ({"closure": "load"}, "omit it"),
        ({"film_level": "ehl"}, "omit it"),
        ({"contact_level": "flat"}, "contact.geometry"),
        ({"model": "full"}, "numerics.tolerance a smaller value"),
        ({"film_deflection": "auto"}, "'scaled'"),
        ({"ehl_tolerance": 1e-3}, "numerics.film_tolerance"),
        ({"sampling": "line"}, "'strips'"),
    ],
)
def test_a_key_that_there_is_no_more_says_what_to_do(tmp_path, numerics, recommendation):
    ((key, value),) = numerics.items()
    file = write(tmp_path, toml(**{f"numerics__{key}": repr(value)}))
    for act in (
        lambda: lubfric.load_scene(file),
        lambda: PAPER.with_(numerics=numerics),
        lambda: lubfric.Numerics(**numerics),
    ):
        with pytest.raises(lubfric.InputError, match=f"numerics.{key} = {value!r}.*{recommendation}"):
            act()
