"""Measured maps in scenes: two bodies, short maps, spikes, keys that do not apply; what a scene keeps is its own."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from instrument_files import write_sdf, write_sur
from scene_text import BODIES_AND_OIL, paper_scene

import lubfric
from lubfric.models.shared import violations_by_strips, why_sample_too_short
from lubfric.output import main
from lubfric.samples import contact_maps, sample_of, whole_maps
from lubfric.scene import ContactDomain, Roughness

SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.001\n"
GENERATED = (
    "[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\nacf = 'gaussian'\n[contact]\nshape = [96, 64]\nspacing = 0.6e-6\n"
)
GRID = 0.6e-6


def scene_file(folder, text):
    path = folder / "scene.toml"
    path.write_text(SCENE + text, encoding="utf-8")
    return path


def loaded(folder, text):
    """The scene of a file, by load sharing: what is seen here of a map does not depend on the model."""
    return lubfric.load_scene(scene_file(folder, text)).with_(numerics={"model": "paper"})


@pytest.fixture
def maps(tmp_path):
    """Two measured maps; the first long enough, the second shorter than the Hertz strip (9 um)."""
    for name, shape, seed in (("long.npy", (160, 96), 1), ("short.npy", (200, 200), 2)):
        rough = lubfric.generate_surface((200, 200), GRID, sq=1e-7, correlation_length=4e-6, acf="gaussian", seed=seed)
        size = shape if name.startswith("long") else (12, 80)
        np.save(tmp_path / name, rough.cropped(size).heights)
    return tmp_path


def test_two_generated_bodies_are_independent_also_with_one_seed(tmp_path):
    both = GENERATED + "[counterface]\nsq = 1e-7\ncorrelation_length = 4e-6\nacf = 'gaussian'\n"
    two, one = (loaded(tmp_path, text) for text in (both, GENERATED))
    result = contact_maps(two)[0]
    alone = contact_maps(one)[0]
    other = result.heights - (alone.heights - alone.heights.mean())
    assert abs(np.corrcoef(other.ravel(), alone.heights.ravel())[0, 1]) < 0.3
    assert other.std() == pytest.approx(1e-7, rel=1e-6) and result.periodic_axes == (True, True)
    assert lubfric.friction(two).film_load < 0.8 * lubfric.friction(one).film_load


def test_the_order_of_two_measured_bodies_does_not_matter(maps):
    """The pair turned over is the pair mirrored in y."""
    one = f"file = 'long.npy'\nspacing = {GRID}\n"
    texts = [f"[surface]\n{a}[counterface]\n{b}" for a, b in ((one, one + "sq = 3e-8\n"), (one + "sq = 3e-8\n", one))]
    result = [lubfric.friction(loaded(maps, text)).coefficient for text in texts]
    assert result[0] == pytest.approx(result[1], rel=5e-3)


def oblique(seed, degrees, count=128, step=1e-6):
    """Ridges (m) of random heights and distances, whose normal lies at an angle to x."""
    rng = np.random.default_rng(seed)
    angle = np.deg2rad(degrees)
    x = (np.arange(count) - count / 2) * step
    along = x[:, None] * np.cos(angle) + x[None, :] * np.sin(angle)
    z = sum(np.cos(2 * np.pi * along / rng.uniform(8e-6, 25e-6) + rng.uniform(0, 6.3)) for _ in range(20))
    return z / z.std() * 80e-9


def pair_and_turned(folder, turned, *, holes=False):
    """Scenes of two bodies with ridges: as they lie, and with the files of some ``turned`` by a right angle.

    Point (x, y) of the body comes to (-y, x) of the file, in which its x lies along y: turned, not mirrored.
    """
    texts = {"numerics": "[numerics]\nsampling = 'patch'\n"}
    for name, seed in (("surface", 1), ("counterface", 2)):
        z = oblique(seed, 60)
        if holes:
            z[20 * seed : 20 * seed + 6, 30:35] = np.nan
        np.save(folder / f"{name}.npy", z)
        np.save(folder / f"{name}-turned.npy", np.array([[z[y, -1 - x] for y in range(128)] for x in range(128)]))
        texts[name] = f"[{name}]\nfile = '{name}.npy'\nspacing = 1e-6\n"
    other = {name: texts[name].replace(".npy'", "-turned.npy'\nmotion_axis = 'y'") for name in turned}
    return [loaded(folder, "".join(parts.values())) for parts in (texts, texts | other)]


@pytest.mark.parametrize("turned", [("counterface",), ("surface", "counterface")])
def test_a_sample_that_was_measured_turned_by_a_right_angle_slides_the_same(tmp_path, turned):
    as_it_lies, after = (lubfric.friction(scene, 0.03) for scene in pair_and_turned(tmp_path, turned=turned))
    assert 0.1 < as_it_lies.contact_load / as_it_lies.film_load < 10
    assert after.coefficient == pytest.approx(as_it_lies.coefficient, rel=1e-5)


@pytest.mark.parametrize("turned", [("counterface",), ("surface",), ("surface", "counterface")])
def test_unmeasured_points_of_a_turned_sample_lie_where_they_lie_on_the_body(tmp_path, turned):
    """The pair turned is the pair itself or its mirror image in y, heights and unmeasured points alike."""
    as_it_lies, after = (whole_maps(scene)[0] for scene in pair_and_turned(tmp_path, turned=turned, holes=True))
    sides = slice(None), slice(None, None, -1)
    (side,) = [y for y in sides if np.allclose(after.heights, as_it_lies.heights[:, y], rtol=0, atol=1e-10)]
    assert np.count_nonzero(~as_it_lies.mask) == 60
    np.testing.assert_array_equal(after.mask, as_it_lies.mask[:, side])
    assert any("mirrored in y: one of the two" in note for note in after.notes) == (len(turned) == 1)


@pytest.mark.parametrize("generated", ["surface", "counterface"])
def test_a_generated_body_that_faces_a_measured_map_is_as_large_as_that(tmp_path, generated):
    """Repeated along the map, the summits of one patch would stand for all of it, and its stated error would be too
    small."""
    large = lubfric.generate_surface((300, 320), GRID, sq=1e-9, correlation_length=4e-6, acf="gaussian", seed=5)
    np.save(tmp_path / "large.npy", large.heights)
    other = {"surface": "counterface", "counterface": "surface"}[generated]
    text = GENERATED.replace("[surface]", f"[{generated}]") + f"[{other}]\nfile = 'large.npy'\nspacing = {GRID}\n"
    scene = loaded(tmp_path, text)
    nx, ny = scene.contact.shape
    z = whole_maps(scene)[0].heights
    assert z.shape == large.shape and z.std() == pytest.approx(1e-7, rel=0.1)
    for first, second in ((z[:-nx], z[nx:]), (z[:, :-ny], z[:, ny:])):
        assert abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) < 0.3
    unlimited = scene.with_(contact={"shape": None, "spacing": None})  # the map has a grid for both
    assert whole_maps(unlimited)[0].shape == large.shape


def test_a_map_shorter_than_the_strip_leads_to_what_can_be_done(maps):
    text = f"[surface]\nfile = 'short.npy'\nspacing = {GRID}\n"
    scene = loaded(maps, text)
    with pytest.raises(lubfric.InputError, match=r"surface.extension = 'mirror'.*contact.geometry = 'flat'"):
        lubfric.prepare(scene)
    longer = scene.with_(surface={"extension": "mirror"})
    strip = 2 * scene.bodies.half_width
    assert contact_maps(longer)[0].size[0] > 5 * strip and 0 < lubfric.friction(longer).coefficient < 0.1
    flat = lubfric.friction(scene.with_(contact={"geometry": "flat"}))
    assert 0 < flat.coefficient < 0.1


def test_a_spike_is_pointed_at_and_can_be_masked_or_believed(maps):
    z = np.load(maps / "long.npy")
    z[41, 17] += 3e-6
    np.save(maps / "long.npy", z)
    scene = loaded(maps, f"[surface]\nfile = 'long.npy'\nspacing = {GRID}\n")
    with pytest.raises(lubfric.InputError, match=r"\(41, 17\).*outliers = 'mask'"):
        lubfric.prepare(scene)
    masked = lubfric.friction(scene.with_(surface={"outliers": "mask"}))
    believed = lubfric.friction(scene.with_(surface={"outliers": "keep"}))
    assert masked.film_load > 5 * believed.film_load  # the spike keeps the film away


@pytest.mark.parametrize(
    "text, words",
    [
        (GENERATED.replace("[contact]", "unit = 'm'\n[contact]"), ["surface.unit", "map from a file"]),
        (GENERATED.replace("[contact]", "spacing = 1e-6\n[contact]"), ["surface.spacing"]),
        (GENERATED.replace("[contact]", "motion_axis = 'x'\n[contact]"), ["surface.motion_axis"]),
        ("[surface]\nfile = 'long.npy'\nspacing = 1e-6\nseed = 0\n", ["surface.seed", "generated"]),
        ("[surface]\nfile = 'long.npy'\nspacing = 1e-6\nacf = 'exponential'\n", ["surface.acf"]),
        (GENERATED + "[counterface]\nsq = 1e-7\ncorrelation_length = 4e-6\nform = 'plane'\n", ["counterface.form"]),
        (GENERATED + "[counterface]\nsq = 1e-7\n", ["counterface", "correlation_length"]),
        (GENERATED + "[counterface]\nfile = 'nowhere.npy'\n", ["counterface.file", "nowhere.npy", "no such file"]),
        (GENERATED + "[counterface]\nsq = -1.0\ncorrelation_length = 4e-6\n", ["counterface.sq", "-1"]),
        (GENERATED + "[counterface]\nsqq = 1.0\n", ["counterface", "did you mean 'sq'"]),
    ],
)
def test_keys_that_do_not_apply_are_refused(maps, text, words):
    with pytest.raises(lubfric.InputError) as caught:
        loaded(maps, text)
    for word in words:
        assert word in str(caught.value)


def test_a_given_map_with_unmeasured_points_is_refused_as_one():
    heights = np.where(np.eye(64) > 0, np.nan, 1e-9)
    surface = lubfric.Surface(heights, 1e-6, mask=np.isfinite(heights))
    with pytest.raises(lubfric.InputError, match=r"1.56 % of the heights are unmeasured.*level\(\) and fill\(\) first"):
        lubfric.prepare(paper_scene(), surface)


def test_the_same_by_call():
    with pytest.raises(lubfric.InputError, match="surface.s_filter"):
        Roughness(sq=1e-7, correlation_length=1e-6, s_filter=1e-5)
    paper = paper_scene()
    with pytest.raises(lubfric.InputError, match="counterface.outliers"):
        paper.with_(counterface={"file": "a.npy", "outliers": "perhaps"})
    turned = paper.with_(surface={"file": "a.npy"})  # a file in place of a generated map leaves nothing of that
    assert turned.surface == Roughness(file="a.npy")
    assert paper.with_(counterface={"sq": 1e-8, "correlation_length": 1e-5}).with_(counterface=None) == paper


@pytest.mark.parametrize("name", ["smooth.sdf", "spikes.sur"])
def test_instrument_files_from_scene_command_and_reader(tmp_path, capsys, instruments, name):
    """The same Sq in each; the map with outliers asks for a word."""
    rough = lubfric.generate_surface((80, 60), 2e-6, sq=1e-7, correlation_length=9e-6, acf="gaussian", seed=1)
    z = rough.heights.copy()
    path = tmp_path / name
    if name == "spikes.sur":
        z[30, 40] = 5e-6
    (write_sur if name == "spikes.sur" else write_sdf)(path, z, rough.spacing)
    sq = lubfric.read_surface(path).sq
    wide = SCENE.replace("radius = 2e-3", 'radius = "2 m"').replace("load = 5.5", "load = 300.0")
    text = f"[surface]\nfile = '{path}'\n[contact]\ngeometry = 'flat'\n"
    (tmp_path / "scene.toml").write_text(wide + text)
    if name.endswith(".sur"):
        assert main(["info", str(tmp_path / "scene.toml")]) == 2
        assert "outliers = 'mask'" in capsys.readouterr().err
        (tmp_path / "scene.toml").write_text(wide + text.replace("[contact]", "outliers = 'keep'\n[contact]"))
    assert main(["info", str(tmp_path / "scene.toml")]) == 0
    assert f"Sq {sq * 1e9:.4g} nm" in capsys.readouterr().out


def test_scenes_and_results_keep_no_hold_of_the_callers_lists():
    shape = [64, 64]
    spacing = [2e-6, 2e-6]
    speeds = [0.01, 0.02]
    patch = ContactDomain(geometry="flat", shape=shape, spacing=spacing)
    scene = lubfric.load_scene("flat").with_(contact=patch, surface={"correlation_length": 8e-6})
    scene = scene.with_(motion={"speeds": speeds})
    shape[0] = 1
    spacing[0] = 1.0
    speeds[0] = 9.0
    assert scene.contact.shape == (64, 64) and scene.contact.spacing == (2e-6, 2e-6)
    assert scene.motion.speeds == (0.01, 0.02) and hash(scene) == hash(scene.with_(name=scene.name))
    requested = np.array([0.05, 0.1])
    curve = lubfric.stribeck(scene.with_(numerics={"accept": True}), requested)
    requested[0] = 7.0
    assert curve.speed.tolist() == [0.05, 0.1]


def test_reader_and_scene_advise_one_form_whatever_the_outliers(maps):
    """A dome, ten times higher along x, under spikes: a cylinder leaves little more than a paraboloid until the spikes
    are masked."""
    heights = np.load(maps / "long.npy")
    x, y = np.meshgrid(*(np.linspace(-1, 1, n) for n in heights.shape), indexing="ij")
    heights = heights - 4e-6 * x**2 - 1e-6 * y**2
    heights[5::40, 5::40] += 2e-5
    np.save(maps / "spiked.npy", heights)
    assert read_note(maps / "spiked.npy").endswith("give form = 'quadratic'")
    for outliers in ("mask", "keep"):
        text = f"[surface]\nfile = 'spiked.npy'\nspacing = {GRID}\noutliers = {outliers!r}\n"
        (advice,) = (
            violation.recommendation
            for violation in lubfric.prepare(loaded(maps, text)).violations
            if violation.what.startswith("share of the form")
        )
        assert advice == "give surface.form = 'quadratic'", outliers


def read_note(path):
    return next(note for note in lubfric.read_surface(path, spacing=GRID).notes if note.startswith("Sq"))


@pytest.mark.parametrize(
    "curved, key, advised",
    [
        ("y", "", "cylinder"),
        ("xy", "", "quadratic"),
        ("xy", "form = 'cylinder'", "quadratic"),
        ("y", "form = 'cylinder'", ""),
    ],
)
def test_a_form_that_is_most_of_a_map_is_a_warning(maps, curved, key, advised):
    """A barrel or a dome of ten times Sq: its share of Sq² is 1 - 1/(1 + ratio²); each form is advised where it is
    enough."""
    heights = np.load(maps / "long.npy")
    x, y = np.meshgrid(*(np.linspace(-1, 1, n) for n in heights.shape), indexing="ij")
    heights = heights - 4e-6 * ((y**2 if curved == "y" else x**2 + y**2) - x / 9)
    np.save(maps / "formed.npy", heights)
    text = f"[surface]\nfile = 'formed.npy'\nspacing = {GRID}\n{key}\n"
    result = lubfric.prepare(loaded(maps, text)).violations
    found = [violation for violation in result if violation.what.startswith("share of the form")]
    assert len(found) == bool(advised)
    for violation in found:
        assert f"{advised!r} in Sq² of [surface] (formed.npy)" in violation.what and not violation.severe
        assert violation.recommendation == f"give surface.form = {advised!r}"
        levelled = lubfric.read_surface(maps / "formed.npy", spacing=GRID, form="cylinder" if key else "plane").sq
        without = lubfric.read_surface(maps / "formed.npy", spacing=GRID, form=advised).sq
        assert violation.value == pytest.approx(100 * (1 - (without / levelled) ** 2), rel=1e-3)


@pytest.mark.parametrize("ratio, is_warned", [(1.9, False), (2.2, True)])
def test_a_form_that_doubles_sq_is_a_warning(maps, ratio, is_warned):
    """A barrel along y on a map without one: Sq is the root of the sum of both squares."""
    rough = lubfric.Surface(np.load(maps / "long.npy"), GRID).level("cylinder").heights
    barrel = (
        lubfric.Surface(-(np.linspace(-1, 1, rough.shape[1]) ** 2)[None, :] * np.ones(rough.shape), GRID)
        .level()
        .heights
    )
    formed = rough + math.sqrt(ratio**2 - 1) * rough.std() / barrel.std() * barrel
    np.save(maps / "formed.npy", formed)
    scene = loaded(maps, f"[surface]\nfile = 'formed.npy'\nspacing = {GRID}\n")
    assert any("share of the form" in violation.what for violation in lubfric.prepare(scene).violations) == is_warned


@pytest.mark.parametrize("axis", ["x", "y"])
@pytest.mark.parametrize("sampling", ["strips", "patch"])
def test_a_map_too_short_is_refused_with_the_length_of_its_file(tmp_path, axis, sampling):
    """13 cells, of which strips take a multiple of 4; the other axis of the file is long enough, where it is."""
    rng = np.random.default_rng(1)
    for across, named in ((80, True), (14, False)):
        heights = 1e-8 * rng.standard_normal((13, across))
        np.save(tmp_path / "own.npy", heights if axis == "x" else heights.T)
        text = (
            f"[surface]\nfile = 'own.npy'\nspacing = {GRID}\nmotion_axis = '{axis}'\n[numerics]\nsampling = "
            f"'{sampling}'\n"
        )
        with pytest.raises(lubfric.InputError, match="own.npy") as caught:
            lubfric.prepare(loaded(tmp_path, text))
        assert "is 7.8 µm long in x" in str(caught.value)
        other = "yx"[axis == "y"]
        found = f"surface.motion_axis = '{other}' (if the motion is along {other} of the file, 48 µm long)" in str(
            caught.value
        )
        assert found == named and ("motion_axis" in str(caught.value)) == named


def test_a_form_of_the_second_body_is_named_and_one_of_a_given_map_too(maps):
    """Also under a map that is continued by its mirror image; a new load keeps the warning."""
    heights = np.load(maps / "short.npy")
    np.save(maps / "formed.npy", heights - 4e-6 * np.linspace(-1, 1, heights.shape[1]) ** 2)
    pair = [
        f"[{name}]\nfile = '{file}.npy'\nspacing = {GRID}\nextension = 'mirror'\n"
        for name, file in (("surface", "long"), ("counterface", "formed"))
    ]
    prepared = lubfric.prepare(loaded(maps, "".join(pair)))
    heavier = lubfric.prepare(prepared.scene.with_(motion={"entrainment_speed": 1.0}), like=prepared)
    for violations in (prepared.violations, heavier.violations):
        (found,) = [violation for violation in violations if violation.what.startswith("share of the form")]
        assert "[counterface] (formed.npy)" in found.what and "counterface.form = 'cylinder'" in found.recommendation
    given = lubfric.Surface(np.load(maps / "formed.npy"), GRID).continued(40 * GRID)
    given = lubfric.Surface(given.heights, GRID, periodic_axes=(False, True))
    (found,) = [
        v for v in lubfric.prepare(prepared.scene.with_(counterface=None), given).violations if "form" in v.what
    ]
    assert found.recommendation == "remove the form from the map: level('cylinder')"


@pytest.mark.parametrize("load, is_asked", [(0.1, True), (1e-5, False)])
def test_a_load_that_was_meant_in_kilonewtons_leads(load, is_asked):
    """The peak Hertz pressure rises with the root of the load, so in kN it is 31.6 times as high."""
    scene = lubfric.load_scene("paper")
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.prepare(scene.with_(bodies={"load": load}, contact={"shape": (64, 64), "spacing": 3e-6}))
    words = str(caught.value)
    assert words.startswith(f"bodies.load = {load:g} N gives a peak Hertz pressure of") == is_asked
    assert (f"did you mean {load:g} kN" in words) == is_asked
    if is_asked:
        low, high = (
            float(number) * {"MPa": 1, "GPa": 1e3}[unit] for number, unit in re.findall(r"([\d.]+) ([MG]Pa)", words)
        )
        assert high / low == pytest.approx(1000**0.5, rel=1e-2)


def test_the_shorter_of_two_maps_is_named(maps):
    """By section and file: in the refusal of one shorter than the strip, and where its width leaves no interval."""
    pair = [
        f"[{name}]\nfile = '{file}.npy'\nspacing = {GRID}\n"
        for name, file in (("surface", "long"), ("counterface", "short"))
    ]
    scene = loaded(maps, "".join(pair))
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.prepare(scene)
    assert re.match(r"the map of the counterface \(.*short.npy\) is 7.2 µm long in x", str(caught.value))
    assert "counterface.extension = 'mirror'" in str(caught.value)
    mirrored = scene.with_(counterface={"extension": "mirror"})
    prepared = lubfric.prepare(mirrored)
    words = why_sample_too_short(mirrored, 5.0, prepared.sample)
    assert "omit" not in words  # without the extension the map would be refused
    assert "a map of [counterface] that is longer across the motion (y of its file), in place of short.npy" in words
    turned = mirrored.with_(counterface={"motion_axis": "y"})
    assert "(its file is turned: x of the file)" in why_sample_too_short(turned, 5.0, prepared.sample)


@pytest.mark.parametrize("columns, gives_interval", [(160, True), (40, False)])
def test_to_omit_a_patch_is_advised_only_where_strips_of_its_map_give_an_interval(maps, columns, gives_interval):
    """A map for one strip alone has no more correlation lengths than the patch; the advice, followed, gives an
    interval."""
    np.save(maps / "own.npy", np.load(maps / "long.npy")[:columns])
    scene = loaded(maps, f"[surface]\nfile = 'own.npy'\nspacing = {GRID}\n")
    patch = lubfric.prepare(scene.with_(numerics={"sampling": "patch"}))
    words = why_sample_too_short(patch.scene, 5.0, patch.sample)
    assert ("omit numerics.sampling, or" in words) == gives_interval and "longer across the motion" in words
    interval = lubfric.friction(scene, 0.01).uncertainty.interval
    assert math.isfinite(interval[0]) == gives_interval


@pytest.mark.parametrize(
    "rise, is_short", [(0.5, True), (2.0, False)]
)  # of the cylinder at the ends of the map, over Sq
def test_a_map_whose_ends_cut_the_contact_off_is_named_beforehand(rise, is_short, tmp_path):
    """By the parabola of the cylinder over the ends of the map; with its mirror image no map is too short, and to omit
    it is not advised."""
    sq = 1e-7
    scene = lubfric.load_scene("paper").with_(bodies={"load": 2000.0}, contact={"shape": None, "spacing": None})
    half = math.sqrt(scene.bodies.half_width**2 + 2 * scene.bodies.radius * rise * sq)
    shape = (4 * round(2 * half / GRID / 4), 192)
    rough = lubfric.generate_surface(shape, GRID, sq=sq, correlation_length=4e-6, acf="gaussian", seed=1)
    np.save(tmp_path / "m.npy", rough.heights)
    file = {"file": str(tmp_path / "m.npy"), "spacing": GRID, "sq": sq, "correlation_length": None}
    short = lubfric.prepare(scene.with_(surface=file))
    ends = [v for v in short.violations if v.what == "length of the patch along the motion"]
    assert len(ends) == is_short
    assert all("surface.extension = 'mirror'" in violation.recommendation for violation in ends)
    assert not any("is cut" in violation.text for violation in ends)
    longer = lubfric.generate_surface((shape[0] + 2, 192), GRID, sq=sq, correlation_length=4e-6, acf="gaussian", seed=1)
    np.save(tmp_path / "longer.npy", longer.heights)
    cut = lubfric.prepare(scene.with_(surface=file | {"file": str(tmp_path / "longer.npy")}))
    ends = [v for v in cut.violations if v.what == "length of the patch along the motion"]
    assert len(ends) == is_short and all("is cut to a whole number" in violation.text for violation in ends)
    mirrored = lubfric.prepare(scene.with_(surface=file | {"extension": "mirror"}))
    assert not [v for v in mirrored.violations if v.what == "length of the patch along the motion"]
    if is_short:
        assert "omit" not in why_sample_too_short(mirrored.scene, 5.0, mirrored.sample)


def test_how_much_of_each_of_two_maps_is_used_is_noted():
    """The sum covers the shorter of both along each axis, on the finer cells."""
    long = lubfric.Surface(np.random.default_rng(1).normal(size=(64, 32)), (1e-6, 1e-6), periodic_axes=(False, False))
    wide = lubfric.Surface(np.random.default_rng(2).normal(size=(16, 32)), (2e-6, 2e-6), periodic_axes=(False, False))
    notes = long.combined(wide).notes
    assert "surface: 32 x 32 of its 64 x 32 µm used" in notes
    assert "counterface: 32 x 32 of its 32 x 64 µm used, interpolated from cells of 2 x 2 µm to 1 x 1 µm" in notes


def test_the_refusal_of_outliers_counts_what_their_mask_takes(tmp_path):
    """Two spikes and three pits, 40 Sq each."""
    rough = lubfric.generate_surface((96, 80), GRID, sq=1e-7, correlation_length=4e-6, acf="gaussian", seed=1)
    heights = rough.heights.copy()
    heights[[10, 60], [20, 40]] = 4e-6
    heights[[30, 50, 80], [10, 30, 60]] = -4e-6
    np.save(tmp_path / "a.npy", heights)
    text = f"[surface]\nfile = 'a.npy'\nspacing = {GRID}\noutliers = "
    with pytest.raises(lubfric.InputError) as caught:
        whole_maps(loaded(tmp_path, f"{text}'refuse'\n"))
    (note,) = (n for n in whole_maps(loaded(tmp_path, f"{text}'mask'\n"))[0].notes if "outliers masked" in n)
    assert "2 isolated points are above their neighbours" in str(caught.value)
    assert note.startswith("outliers masked: 5 ") and "2 above and 3 below" in note and note in str(caught.value)


@pytest.mark.parametrize("acf", ["gaussian", "exponential"])
def test_the_sq_of_a_strip_is_stated_beside_that_of_its_map_with_what_sampling_explains(acf, tmp_path):
    """Of 20 maps that are alike everywhere one lies outside; a strip on the smooth side of a map always does."""
    np.savetxt(tmp_path / "m.txt", np.zeros((4, 4)))
    rough = {"file": str(tmp_path / "m.txt"), "spacing": 1e-6, "unit": "nm", "sq": None, "correlation_length": None}
    scene = lubfric.load_scene("paper").with_(surface=rough, contact={"shape": None, "spacing": None})
    inside = 0
    for seed in range(20):
        made = lubfric.generate_surface((300, 150), 1e-6, sq=1e-7, correlation_length=6e-6, acf=acf, seed=seed)
        made = replace(made, periodic_axes=(False, False))
        sample = sample_of(scene, read=(made,))
        strips = sample.stated_map()
        deviation, explained = sample.sq_deviation(strips)
        assert deviation == pytest.approx(strips.heights.std() / made.heights.std() - 1)
        inside += abs(deviation) <= explained
    assert inside >= 17
    half = replace(made, heights=made.heights * np.where(np.arange(300) < 150, 0.2, 1.0)[:, None])
    sample = sample_of(scene, read=(half,))
    smooth = min((sample.strip(index) for index in range(sample.available_strips)), key=lambda strip: strip.sq)
    (warning,) = violations_by_strips(*sample.sq_deviation(smooth))
    assert warning.text.startswith("warning: difference of Sq between the strips that are solved first and the map is ")
    assert "smoother than the map" in warning.text
    assert any(line.startswith("Sq of the strips is ") and "below" in line for line in sample.described(smooth))


def test_the_middle_of_a_mirrored_map_is_under_that_of_the_strip(maps):
    """Its seams lie at both sides: the measured piece of 12 columns carries the load in the middle, not its edge
    twice."""
    given = f"[surface]\nfile = 'short.npy'\nspacing = {GRID}\nextension = 'mirror'\n"
    sample = lubfric.prepare(loaded(maps, given)).sample
    assert sample.cells.coarsening[1] == 1 and sample.available_strips == 1
    step = sample.cells.coarsening[0]
    heights = sample.strip(0).heights
    measured = np.load(maps / "short.npy")[step // 2 :: step]
    before = (heights.shape[0] - measured.shape[0]) // 2
    middle = heights[before : before + measured.shape[0], 20:40]
    assert np.corrcoef(middle.ravel(), measured[:, 20:40].ravel())[0, 1] > 0.98
