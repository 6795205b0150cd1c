"""`lubfric info` names every input with its unit and tells what will be refused; `lubfric init` writes what runs."""

import csv
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from instrument_files import write_x3p
from small_study import SCENE as SMALL_SCENE

import lubfric
from lubfric.models import model_named
from lubfric.models.quick.strips_on_long_cells import solve_on_long_cells
from lubfric.output import describe_scene, described_scene, main, wrapped
from lubfric.output.inputs_as_given import inputs_as_given as input_tables
from lubfric.scene import Harmonic, Ramp, Table, Transient

HEAVY = lubfric.load_scene("paper").with_(
    bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "material": "steel"},
    lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 2e-8},
    motion={"entrainment_speed": 1.0, "speeds": [1.0]},
    contact={"shape": (128, 64), "spacing": 4e-6},
    surface={"sq": 5e-8, "correlation_length": 3e-5},
)


def test_each_speed_states_what_it_takes_if_its_cells_have_to_be_shorter():
    """As the strip does: by what shorter cells add to it. A film of half Sq between rolling bodies may require them."""
    rough = {"sq": 1.25e-7, "correlation_length": 1e-5, "acf": "gaussian"}
    steel = {
        "radius": 1.5e-3,
        "width": 0.01,
        "load": 800.0,
        "material": "100Cr6",
        "boundary_friction_coefficient": 0.11,
    }
    scene = HEAVY.with_(
        bodies=steel | {"hertz_pressure": None},
        motion={"slide_roll_ratio": 0.01, "entrainment_speed": 2.0, "speeds": None},
        surface=rough,
        counterface=rough,
        contact={"shape": (128, 128), "spacing": 2.5e-6},
    )
    text = describe_scene(scene, [2.0])
    numbers = r"takes about (\S+) s of processor time by the deterministic model, and (\S+) s if"
    ((strip, longest),) = re.findall(numbers, text)
    ((seconds, on_shorter),) = re.findall(r" (\d+) \((\d+) on shorter cells\)", text)
    assert float(on_shorter) - float(seconds) == pytest.approx(float(longest) - float(strip), abs=10.0)  # one digit
    assert "the quick model replaces it where one strip takes above 120 s of work counted" in text
    assert "(60 to 120 s of processor time on a free core;" in text


def test_every_input_stands_with_its_unit():
    scene = HEAVY.with_(
        lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "density": 870}
        | {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.07, "limiting_stress_offset": 2e6},
        motion={"slip_percent": 5},
        bodies={"hardness_hv": 700},
    )
    text = describe_scene(scene)
    stated = "reduced radius: 10 mm  (bodies.radius)|length of the line contact: 10 mm|N/mm|peak 900 MPa|°C|mPa s|Gold"
    stated += "|plastic limit of the contact pressure: 7.404 GPa|boundary friction coefficient: 0.09|46 and 46 W/(m K)"
    stated += "|1/K|Sq|/GPa by So and Klaus|Eyring stress: 5 MPa|limiting shear stress per pressure: 0.07"
    stated += "|slide-roll ratio: 0.05|limiting shear stress at ambient pressure: 2 MPa"
    stated += "|surface speeds 0.975 and 1.025 m/s"
    for words in stated.split("|"):
        assert words in text, words


def test_an_input_that_is_given_in_si_has_its_unit_in_the_report():
    """Density, temperature and radii were bare numbers: they are short forms, which no resolved scene holds."""
    given = {
        "bodies": {"radii": [8e-3, math.inf]},
        "lubricant": {"grade": "ISO VG 68", "viscosity_index": 95, "density": 870, "temperature_celsius": 70},
        "motion": {"speed_range": [1e-3, 10.0, 13]},
    }
    scene = lubfric.load_scene("paper").with_(**given)
    page = "".join(input_tables(scene, section, values) for section, values in given.items())
    used = set(re.findall(r'"value used">([^<]*)</td>', page))
    assert {"870 kg/m³", "70 °C", "8 mm, a plane", "95", "0.001 m/s, 10 m/s, 13"} <= used


def test_what_follows_from_a_named_oil_is_derived():
    """Its viscosity and its pressure-viscosity coefficient are no defaults."""
    given = {"oil": "mineral-100", "temperature": "60 °C"}
    own = {"viscosity": None, "pressure_viscosity_coefficient": None}
    page = input_tables(lubfric.load_scene("paper").with_(lubricant=given | own), "lubricant", given)
    row = page.partition("viscosity at ambient pressure")[2].partition("</tr>")[0]
    assert "derived" in row


@pytest.mark.parametrize("width", [100, 60])
def test_no_line_of_info_is_wider_than_the_terminal(width, monkeypatch, capsys):
    """The table is as wide as its numbers are; all other lines break between words, and lose none."""
    monkeypatch.setenv("COLUMNS", str(width))
    assert main(["info", "paper"]) == 0
    broken = capsys.readouterr().out
    table = broken.partition("and cost\n")[2].partition("\n  bodies")[0].splitlines()
    longest = max(len(line) for line in broken.splitlines() if width >= 100 or line not in table)
    assert width / 2 < longest <= width
    monkeypatch.setenv("COLUMNS", "10000")
    assert main(["info", "paper"]) == 0
    whole = capsys.readouterr().out
    assert whole.split() == broken.split() or width < 100
    assert max(map(len, whole.splitlines())) > 150


@pytest.mark.parametrize("width", range(40, 60))
def test_no_line_ends_before_a_percent_sign_or_beside_an_equals_sign(width, monkeypatch):
    monkeypatch.setenv("COLUMNS", str(width))
    text = "f is 0.05 (0.04 to 0.06 at 95 %), sampling 12 %, F_C = 1.5 N and a long remainder: 7 % of it, U = 2 m/s"
    broken = wrapped(text, None).splitlines()
    assert len(broken) > 1 and " ".join(line.strip() for line in broken) == text
    assert not any(re.search(r"(=|F_C|U)$", line) or re.match(r" *[%=]", line) for line in broken)


def test_info_refuses_no_newtonian_oil_between_asperities_that_friction_answers():
    rough = HEAVY.with_(surface={"sq": 1e-6}, numerics={"model": "paper"})
    assert math.isfinite(lubfric.friction(rough).coefficient)
    stated = describe_scene(rough).partition("  validity\n")[2]
    assert "not valid" not in stated and "the result is refused only if the share is above 0.2" in stated


def test_few_or_no_asperities_are_stated_only_above_a_lambda_ratio_of_3():
    """At 0.046 m/s, lambda ratio some 2, the paper's contact has F_C/F_T = 0.116."""
    rows = describe_scene(lubfric.load_scene("paper"), [0.001, 0.01, 0.0464, 0.1, 0.3, 3.0]).partition("U [m/s]")[2]
    said = re.findall(r"^ +[\d.]+ +[\d.]+ +[\d.]+ +[\d.]+ +([\d.]+) +(yes|likely|few or none|no) ", rows, re.M)
    assert len(said) >= 5 and {words for _, words in said} >= {"likely", "no"}
    assert all(float(ratio) >= 3 for ratio, words in said if words == "few or none")


def test_info_reports_beforehand_what_friction_refuses():
    with pytest.raises(lubfric.ValidityError, match="Newtonian"):
        lubfric.friction(HEAVY)
    stated = describe_scene(HEAVY)
    assert "not valid" in stated and "Newtonian" in stated.partition("validity")[2]
    mended = HEAVY.with_(lubricant={"eyring_stress": 5e6, "limiting_stress_coefficient": 0.07})
    assert "not valid" not in describe_scene(mended)
    paper = describe_scene(lubfric.load_scene("paper"), [0.03, 0.3])  # at 1 m/s heat is
    assert "no limit of the model is exceeded" in paper
    places = [paper.index(word) for word in ("  model\n", "processor time", "full-load film", "Hertz", "  lubricant\n")]
    assert places == sorted(places)  # what a user looks for comes first
    assert "Did you mean 8 mm (0.008 m)?" in describe_scene(HEAVY.with_(bodies={"radius": 8.0, "load": 1.0}))


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"bodies": {"radius": 8.0, "load": 1.0}},  # mm were meant
        {"numerics": {"accept": True}},
        {"lubricant": {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.07}},
    ],
    ids=["oil without a limit", "radius", "accepted", "mended"],
)
def test_info_ends_with_the_code_of_run(changed, tmp_path, capsys):
    """After all that it says of the scene."""
    patch = {"model": "paper", "sampling": "patch", "heat": "off", "tolerance": 0.2}
    scene = HEAVY.with_(motion={"speeds": ()}, numerics=patch, contact={"shape": (128, 32)}).with_(**changed)
    (tmp_path / "s.toml").write_text(scene.to_toml())
    code = main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")])
    capsys.readouterr()
    assert main(["info", str(tmp_path / "s.toml")]) == code
    stated = capsys.readouterr()
    assert "estimate with closed forms" in stated.out and ("lubfric: " in stated.err) == (code != 0)


@pytest.mark.parametrize(("ratio", "strips"), [(2.0, "one to 4 strips"), (0.1, "one strip")], ids=["rests", "moves"])
def test_info_states_on_how_many_strips_the_quick_answer_is_solved(ratio, strips, monkeypatch):
    """As many as are solved, whatever the tolerance asks for."""
    scene = lubfric.load_scene("paper").with_(
        motion={"slide_roll_ratio": ratio}, numerics={"model": "quick", "sampling_tolerance": 1e-3}
    )
    assert strips in describe_scene(scene) and "tolerance requires" not in describe_scene(scene)
    solved: list[int] = []
    strip = SimpleNamespace(work=0.0, slope=0.0)

    def solve(prepared, speed, index, **_):
        solved.append(index)
        return SimpleNamespace(resolved=strip)

    class Solved(Exception):
        pass

    def stop(*_):
        raise Solved

    home = "lubfric.models.quick.strips_on_long_cells."
    monkeypatch.setattr(f"{home}_solve_pair", solve)
    monkeypatch.setattr(f"{home}_sampling_target", lambda *_: 1e-3)
    monkeypatch.setattr(f"{home}two_levels", lambda *_, **__: (None, 1000))
    monkeypatch.setattr(f"{home}_features_of", stop)
    with pytest.raises(Solved):
        solve_on_long_cells(lubfric.prepare(scene), 0.03)
    assert len(solved) == int(strips.split()[-2].replace("one", "1"))


def test_info_looks_at_what_is_solved():
    """A patch of few asperities is no doubt about a scene that is solved on a long line of its roughness."""
    small = lubfric.load_scene("paper").with_(contact={"shape": (100, 100)})
    for sampling, stated in (("strips", False), ("patch", True)):
        scene = small.with_(numerics={"sampling": sampling})
        known = [entry.what for entry in lubfric.prepare(scene).violations]
        assert (
            ("The sample has few asperities" in describe_scene(scene))
            == stated
            == any("length of the sample" in what for what in known)
        )
    patch = small.with_(numerics={"sampling": "patch", "model": "auto"})
    assert lubfric.friction(patch).decision.model == "deterministic" and "deterministic model" in describe_scene(patch)
    smaller = small.with_(contact={"shape": (64, 64)})  # too small to be generated, which it need not be
    assert lubfric.friction(smaller).coefficient > 0 and "strips of the rough surface" in describe_scene(smaller)


def test_init_writes_a_scene_that_runs_and_overwrites_nothing(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    assert main(["init", str(path)]) == 0
    scene = lubfric.load_scene(path)
    assert scene.lubricant.oil.index == pytest.approx(95, abs=1e-6)
    assert describe_scene(scene).count("warning") == 0
    small = scene.with_(contact={"shape": (128, 64), "spacing": 3.2e-6}, numerics={"model": "paper"})
    result = lubfric.friction(small, 0.01)
    assert 0.05 < result.coefficient <= 0.12
    assert main(["init", str(path)]) == 2
    assert "exists" in capsys.readouterr().err
    assert main(["init", str(tmp_path / "nowhere" / "x.toml")]) == 2


def test_the_roller_of_the_examples_is_an_answer(root, tmp_path):
    """One scene of 25 lines, one command, on a ground surface such as the measured one that is not shipped."""
    scene = root / "docs" / "examples" / "roller.toml"
    lay = {"correlation_length": (2.2e-6, 20e-6), "acf": "gaussian"}
    assert len(scene.read_text(encoding="utf-8").splitlines()) <= 25
    ground = lubfric.generate_surface((166, 102), (0.5e-6, 2e-6), sq=77e-9, **lay, seed=3)
    path = write_x3p(tmp_path / "ground.x3p", ground.heights, steps=ground.spacing)
    shared = lubfric.load_scene(scene, surface_file=path).with_(numerics={"model": "paper"})
    curve = lubfric.stribeck(shared, [1.0, 1e-2, 1e-4])
    assert 0.02 < curve.coefficient[0] < 0.05 and not any("not valid" in text for text in curve.validity)
    assert curve.coefficient[2] == pytest.approx(0.12, rel=2e-3)  # f -> f_b
    assert curve.coefficient[0] < curve.coefficient[1] < curve.coefficient[2]


def test_info_states_rest_of_the_deterministic_model_and_of_one_patch():
    still = describe_scene(HEAVY.with_(motion={"entrainment_speed": 0.0, "speeds": [0.0, 1.0]}))
    assert "no entrainment: all load" in still
    assert "periodic along the line, on 128 x 64 cells" in describe_scene(HEAVY.with_(numerics={"sampling": "patch"}))
    one = HEAVY.with_(numerics={"model": "deterministic"})
    assert "deterministic model (numerics.model)" in describe_scene(one.with_(motion={"slide_roll_ratio": 2.0}))


TRANSIENT = lubfric.load_scene("paper").with_(transient=lubfric.Transient(duration=1e-3))


@pytest.mark.parametrize(
    "scene, options, told",
    [
        (None, ["--ratios", "0.1", "--vtk"], "--vtk is for a Stribeck curve"),
        (None, ["--animation"], "--animation is for a scene with"),
        (TRANSIENT, ["--ratios", "0.1"], "--ratios is for a traction curve"),
        (TRANSIENT, ["--workers", "2"], "--workers is for a Stribeck curve or a traction curve (--ratios), and"),
        (TRANSIENT, ["--vtk"], "--vtk is for a Stribeck curve, and this is a scene with [transient]"),
    ],
)
def test_an_option_that_would_do_nothing_is_refused(tmp_path, capsys, scene, options, told):
    path = tmp_path / "scene.toml"
    path.write_text((scene or lubfric.load_scene("paper")).to_toml())
    assert main(["run", str(path), *options, "--out", str(tmp_path / "out")]) == 2
    assert told in capsys.readouterr().err and not (tmp_path / "out").exists()


SWINGING = lubfric.load_scene("paper").with_(
    contact={"shape": (48, 48), "spacing": 1.1e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "tolerance": 0.03},
)


@pytest.mark.parametrize(
    "plan, words",
    [
        (
            {"speed": Harmonic(amplitude=0.05, frequency=100.0), "duration": 0.02},
            ("harmonic, -0.05 to 0.05 m/s, 2 periods: the motion reverses", "0.05 m/s;"),
        ),
        (
            {"speed": Table(times=(0, 5e-3, 1e-2), values=(0.0, 0.2, 0.0), repeat=True), "duration": 0.01},
            ("speed: table, 0 to 0.2 m/s, 1 period", "top speed 0.2 m/s"),
        ),
        ({"load": Ramp(start=1.0, end=5.5, until=5e-3), "duration": 0.01, "speed": 0.1}, ("load: ramp, 1 to 5.5 N",)),
    ],
)
def test_info_tells_the_history_of_a_run_and_what_it_costs(plan, words):
    """Also of one that begins at rest, as a reciprocating scene does. Steps within a factor of 2.5 of those taken."""
    scene = SWINGING.with_(transient=lubfric.Transient(outputs=10, **plan))
    stated = describe_scene(scene)
    for each in (*words, f"{plan['duration']:g} s in about", "10 outputs", "within a factor of", "a run in time"):
        assert each in stated, (each, stated)
    before_the_table = stated.partition("estimate with closed forms")[0]  # which has moments at which nothing moves
    assert "no entrainment" not in before_the_table and "surface speeds" not in stated
    steps = float(stated.partition(" in about ")[2].partition(" steps")[0])
    assert 1 / 2.5 < steps / lubfric.transient(scene).report.iterations < 2.5


def test_info_of_a_run_in_time_is_one_story():
    """One sample for all times, no table of what single speeds would take, and what changes is told as changing."""
    plan = lubfric.Transient(0.02, outputs=10, speed=Harmonic(amplitude=0.05, frequency=100.0))
    stated = describe_scene(lubfric.load_scene("paper").with_(transient=plan, motion={"slide_roll_ratio": 0.1}))
    head = stated.partition("U [m/s]")[2].partition("\n")[0]
    assert "strips" not in head and "time (s)" not in head and "(below)" not in stated and "alone" not in stated
    assert (
        "-0.05 to 0.05 m/s  (motion.entrainment_speed) over the run: transient.speed" in stated
        and stated.count("strips of the roughness, ") == 1
    )
    assert "moving roughness is treated as stationary" in stated
    squeeze = describe_scene(SWINGING.with_(transient=lubfric.Transient(1e-3, speed=0.0, initial_film=2e-6)))
    assert "no entrainment" in squeeze and "all load" not in squeeze and "film of 2 µm" in squeeze


@pytest.mark.parametrize(
    ("model", "moves"), [("auto", False), ("paper", False), ("quick", False), ("deterministic", True)]
)
def test_info_of_a_run_in_time_states_that_the_roughness_does_not_move(model, moves):
    """Only the deterministic model moves it in time, though a steady point by "quick" includes its motion."""
    steady = lubfric.load_scene("paper").with_(motion={"slide_roll_ratio": 0.1}, numerics={"model": model})
    run = steady.with_(transient=lubfric.Transient(1e-3, outputs=1))
    effect = "motion of the roughness through the contact"
    assert (effect in describe_scene(run)) is not moves
    assert (effect in describe_scene(steady)) is (model == "paper")


def test_info_takes_the_speeds_of_a_run(capsys, tmp_path):
    for speeds, rows in (("1 mm/s:1 m/s:4", 4), ("auto", 6)):
        assert main(["info", "paper", "--speeds", speeds]) == 0
        stated = capsys.readouterr().out
        assert all(
            word in stated for word in ("half-width 4.496 µm", "102 MPa", "lambda", "on strips of the rough surface")
        )
        assert (
            f"; {4 if rows == 4 else 12} speeds" in stated and len(stated.partition("U [m/s]")[2].splitlines()) > rows
        )
    (tmp_path / "scene.toml").write_text(TRANSIENT.to_toml())
    assert main(["info", str(tmp_path / "scene.toml"), "--speeds", "1"]) == 2
    assert "--speeds is for a curve" in capsys.readouterr().err


def test_the_map_that_was_given_comes_before_its_strips(tmp_path):
    heights = 1e-7 * np.random.default_rng(1).normal(size=(60, 40)).cumsum(axis=0)
    path = write_x3p(tmp_path / "mine.x3p", heights, steps=(2e-6, 2e-6))
    rough = {"file": path, "sq": None, "correlation_length": None}
    stated = describe_scene(lubfric.load_scene("paper").with_(surface=rough, contact={"shape": None, "spacing": None}))
    assert "mine.x3p: 60 x 40 points, 120 x 80 µm" in stated and "statistics of " in stated


@pytest.mark.slow
def test_info_of_a_model_that_takes_too_long_says_what_answers():
    """As the answer has it: the error of long cells is larger than requested, and known."""
    moving = HEAVY.with_(
        motion={"slide_roll_ratio": 0.03},
        contact={"shape": (640, 512), "spacing": 0.8e-6},
        surface={"sq": 2e-7, "correlation_length": 6.5e-6},
        lubricant={"eyring_stress": 5e6},
    )
    text = describe_scene(moving)
    assert "on its own cells the deterministic model would take too long" in text
    result = lubfric.friction(moving.with_(numerics={"sampling_tolerance": 0.2})).uncertainty
    assert result.model > 0.05 and np.isfinite(result.interval).all()


def test_info_states_the_limits_of_the_model_that_auto_is_expected_to_take(monkeypatch):
    """Where the deterministic model would take too long, they are those of the quick model."""
    monkeypatch.setattr("lubfric.models.deterministic.estimated_work.MOST_WORK_OF_POINT", 1e-3)
    light = lubfric.load_scene("paper").with_(
        bodies={"load": 2.0}, motion={"slide_roll_ratio": 0.1, "speeds": [0.03]}, numerics={"model": "quick"}
    )
    stated = {}
    for name in ("quick", "auto"):
        text = describe_scene(light.with_(numerics={"model": name}))
        stated[name] = text.partition("  validity\n")[2].partition("\n  estimate")[0]
    words = {name: " ".join(text.split()) for name, text in stated.items()}
    (named, chosen) = (re.search(r"(note|warning): (.*?)\. (.*)", words[name]) for name in ("quick", "auto"))
    assert named[2] == chosen[2] and (named[1], chosen[1]) == ("warning", "note")
    assert "is not calibrated for such contacts" in named[3] and "the quick model is calibrated end there" in chosen[3]
    assert "Recommendation" in named[3] and "Recommendation" not in chosen[3]


@pytest.mark.parametrize(
    "sections, why",
    [
        ({"contact": {"geometry": "flat"}}, "contact.geometry = 'flat'"),
        ({"surface": {"sq": 0.0}}, "the surfaces are smooth"),
    ],
)
def test_info_describes_what_answers_for_a_named_quick_model_without_an_answer(sections, why):
    """The model that the result names, and no strips on long cells."""
    scene = lubfric.load_scene("paper").with_(numerics={"model": "quick"}, **sections)
    (line, *_) = describe_scene(scene).partition("  model\n")[2].splitlines()
    assert "load-sharing model in place of the quick model" in line and why in line and "long cells" not in line
    assert lubfric.friction(scene.with_(contact={"shape": (96, 96)}), 1.0).decision.model == "paper"


def test_info_counts_no_strips_of_a_model_that_has_no_answer():
    """Streamers are sheared in the load-sharing model alone, so it answers for every model."""
    streamers = lubfric.load_scene("paper").with_(motion={"speeds": [0.03]}, numerics={"cavitated_shear": "striated"})
    costs = set()
    for name in ("paper", "quick", "auto"):
        text = describe_scene(streamers.with_(numerics={"model": name}))
        costs.add(text.partition("cost: ")[2].partition("\n")[0])
    assert len(costs) == 1


def test_info_of_a_traction_curve_promises_no_model_at_the_points_where_f_is_near_zero():
    """In pure rolling the film may be thick and the model-form error of f large."""
    (text, _) = described_scene(HEAVY.with_(surface={"sq": 2e-9}), ratios=[0.0, 0.05])
    (line, *_) = text.partition("  model\n")[2].splitlines()
    assert "load-sharing model alone where the film is thick" in line and "pure rolling" in line


def test_info_says_what_a_strip_takes_if_its_cells_have_to_be_shorter():
    """On cells half a correlation length long along y a strip may be solved again; on the shorter cells of the scene,
    and with a wider target of the error, it is not."""
    rough = {"sq": 2e-7, "correlation_length": 20e-6, "acf": "gaussian"}
    scene = lubfric.load_scene("paper").with_(
        bodies={"radius": 3e-3, "width": 10e-3, "load": 800.0},
        lubricant={"viscosity": 0.0105, "pressure_viscosity_coefficient": 17e-9},
        motion={"slide_roll_ratio": 0.01, "entrainment_speed": 2.0, "speeds": [2.0]},
        surface=rough,
        contact={"shape": (96, 96), "spacing": 5e-6},
    )
    may_be = describe_scene(scene)
    assert "if the error of its cells requires shorter cells" in may_be
    for numerics in {"grid": "given"}, {"model_tolerance": 0.09}:
        other = describe_scene(scene.with_(numerics=numerics))
        assert "strip of moving roughness" in other and "requires shorter" not in other


def test_the_peak_pressure_of_a_run_in_time_is_that_of_its_cycle():
    """Not that of the largest load on the mean radius: sqrt(F E'/(2 pi R L)) of a cam whose nose is sharp."""
    load = Harmonic(mean=3.0, amplitude=2.0, frequency=50.0)
    radius = Harmonic(mean=2e-3, amplitude=1.5e-3, frequency=50.0)
    scene = SWINGING.with_(transient=lubfric.Transient(0.02, speed=0.1, load=load, radius=radius))
    time = np.linspace(0.0, 0.02, 20001)
    bodies = scene.bodies
    force, curve = (np.array([history.at(t) for t in time]) for history in (load, radius))
    peak = np.sqrt(force * bodies.e_prime / (2 * np.pi * curve * bodies.width)) / 1e6
    stated = describe_scene(scene)
    low, high = stated.partition("peak pressure ")[2].partition(" MPa over the run")[0].split(" to ")
    assert float(low) == pytest.approx(peak.min(), rel=2e-3) and float(high) == pytest.approx(peak.max(), rel=2e-3)


def test_the_speeds_of_a_command_are_those_solved_and_one_of_them_is_the_answer(tmp_path, capsys):
    """The scene's own speed is solved where no speed is given alone; --fields adds its speeds, and says so."""
    scene = SWINGING.with_(motion={"entrainment_speed": 0.05, "speeds": ()}, numerics={"model": "paper"})
    (tmp_path / "scene.toml").write_text(scene.to_toml())

    def run(*options):
        assert main(["run", str(tmp_path / "scene.toml"), *options, "--out", str(tmp_path / "o")]) == 0
        with np.load(tmp_path / "o" / "fields.npz") as fields:
            drawn = fields["speed"].tolist()
        page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
        answer = page.partition('<p class="answer">')[2].partition("</p>")[0]
        rows = (tmp_path / "o" / "stribeck.csv").read_text().splitlines()[1:]
        return drawn, answer.partition(" m/s")[0].rpartition(" ")[2], [float(row.partition(",")[0]) for row in rows]

    assert run("--speeds", "0.1") == ([0.1], "0.1", [0.1])
    assert run("--speeds", "0.01,0.1") == ([0.1], "0.1", [0.01, 0.1])  # the nearest by ratio
    assert run() == ([0.05], "0.05", [0.05])
    assert "requested; added" not in capsys.readouterr().err
    assert run("--speeds", "0.1", "--fields", "0.04") == ([0.04], "0.04", [0.04, 0.1])
    assert "1 speed requested; added: 0.04 m/s, whose fields are drawn (--fields)" in capsys.readouterr().err


def test_init_leaves_the_choice_of_the_model_to_the_program(tmp_path):
    assert main(["init", str(tmp_path / "mine.toml")]) == 0
    scene = lubfric.load_scene(tmp_path / "mine.toml")
    lines = (tmp_path / "mine.toml").read_text().splitlines()
    assert not any(line.startswith("model") for line in lines) and scene.numerics.model == "auto"
    assert scene.lubricant.limiting_stress_coefficient is not None


def test_a_run_in_time_that_fails_has_a_report_that_begins_with_that(tmp_path, capsys, monkeypatch):
    """Its status is marked as failed, and no number stands as its answer."""
    monkeypatch.setattr("lubfric.time.result.MASS", 1e-15)
    plan = lubfric.Transient(0.01, outputs=4, speed=Harmonic(amplitude=0.05, frequency=100.0, phase=1.0))
    (tmp_path / "s.toml").write_text(SWINGING.with_(transient=plan, numerics={"model": "quick"}).to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")]) == 1
    message = capsys.readouterr().err.splitlines()[-1]
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    head = page.partition("<h2>Answer</h2>")[0]
    assert 'class="status failed"' in head and "Not converged: all 5 outputs are solved, but the balance" in head
    assert "the balance of the lubricant is" in message and "at output" in message
    assert page.partition('<p class="answer">')[2].startswith("The run has no valid answer.")


def test_a_sentence_begins_with_a_capital_letter_unless_a_key_does():
    from lubfric.models.shared import sentence

    assert sentence("give a map") == "Give a map." and sentence("which?") == "Which?"
    assert sentence("numerics.model = 'auto' helps") == "numerics.model = 'auto' helps."


def test_a_value_that_equals_a_typical_one_is_taken_as_exact():
    plain = lubfric.load_scene("paper").with_(bodies={"boundary_friction_coefficient": 0.12})
    assert "taken as exact; the name 'anti-wear' gives the typical range, 0.09 to 0.15" in describe_scene(plain)
    named = plain.with_(bodies={"boundary_friction_coefficient": "anti-wear"})
    assert "taken as exact" not in describe_scene(named)


def test_the_report_divides_the_power_loss_of_a_rolling_contact(tmp_path):
    """The rolling part is the loss less the work of shear, by the numbers of the table: also where rolling resistance
    lowers f, at a negative slide-roll ratio, a part is less than the whole."""
    file = tmp_path / "s.toml"
    thick = {
        "motion": {"slide_roll_ratio": -0.1, "speeds": (), "entrainment_speed": 0.5},
        "numerics": {"model": "paper"},
    }
    file.write_text(lubfric.load_scene("paper").with_(**thick).to_toml())
    assert main(["run", str(file), "--speeds", "0.5", "--out", str(tmp_path / "out")]) == 0
    row = next(csv.DictReader((tmp_path / "out" / "stribeck.csv").read_text().splitlines()))
    shear = abs(float(row["couette_force [N]"]) + float(row["boundary_force [N]"]))
    rolling = float(row["power_loss [W]"]) - shear * 0.1 * 0.5
    page = (tmp_path / "out" / "report.html").read_text()
    stated = re.search(r"of which ([\d.]+) mW is rolling resistance \(± ([\d.]+) %\)", page)
    assert stated and float(stated[1]) == pytest.approx(1e3 * rolling, rel=5e-3) and rolling > 0
    of_points = page.split("<h2>Operating points</h2>")[1].partition("</table>")[0]
    place = re.findall(r"<th[^>]*>([^<]*)</th>", of_points).index("part of P by rolling resistance [mW]")
    cells = re.findall(r"<td[^>]*>([^<]*)</td>", of_points)
    assert float(cells[place]) == pytest.approx(1e3 * rolling, rel=5e-3)
    half_width = float(row["power_loss_high [W]"]) - float(row["power_loss [W]"])
    assert 1 < float(stated[2]) and float(stated[2]) / 100 * rolling <= half_width * (1 + 0.05)


def test_the_film_before_the_solve_is_the_full_load_film_of_the_result():
    """A hot inlet halves the film: the estimate had twice that of the result, under the same name."""
    scene = SMALL_SCENE.with_(
        lubricant={"temperature": 313.15, "temperature_coefficient": 0.04},
        motion={"speeds": (), "entrainment_speed": 3.0},
        numerics={"model": "paper"},
    )
    point = lubfric.friction(scene, 3.0)
    assert point.inlet_film_factor < 0.6
    (row,) = (line.split() for line in describe_scene(scene).splitlines() if line.startswith("  3  "))
    assert float(row[3]) == pytest.approx(1e9 * point.full_load_film, rel=1e-3)
    assert float(row[4]) == pytest.approx(point.lambda_ratio, rel=5e-3)


def test_the_report_states_how_speed_and_viscosity_change_f_in_mixed_lubrication(tmp_path):
    """As points at a tenth more speed, and of a tenth more viscosity, have it."""
    scene = SWINGING.with_(motion={"entrainment_speed": 0.01, "speeds": ()}, numerics={"model": "paper"})
    (tmp_path / "s.toml").write_text(scene.to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.008,0.01,0.0125", "--out", str(tmp_path / "o")]) == 0
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    (of_f, of_lambda) = map(
        float, re.findall(r"10 % more speed changes f by (\S+) % and the lambda ratio by (\S+) %", page)[0]
    )
    thicker = scene.with_(lubricant={"viscosity": 1.1 * scene.lubricant.viscosity})
    middle = lubfric.friction(scene, 0.01)
    assert 0.05 < middle.contact_load / scene.bodies.load < 0.95
    for other in (lubfric.friction(scene, 0.011), lubfric.friction(thicker, 0.01)):
        assert 100 * (other.coefficient / middle.coefficient - 1) == pytest.approx(of_f, rel=0.15)
        assert 100 * (other.lambda_ratio / middle.lambda_ratio - 1) == pytest.approx(of_lambda, rel=0.1)
    assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.01", "--out", str(tmp_path / "o")]) == 0
    assert "more speed changes f" not in (tmp_path / "o" / "report.html").read_text(encoding="utf-8")


def test_the_table_of_a_run_in_time_has_the_values_of_each_moment():
    """Load and speed never have their largest values together; nor does a run tell less of its inlet than a steady
    point."""
    scene = HEAVY.with_(lubricant={"inlet_length": 4e-4}).with_(
        transient=Transient(
            duration=1.0,
            outputs=5,
            speed=Table(times=(0.0, 0.5, 1.0), values=(0.1, 2.0, 0.1)),
            load=Table(times=(0.0, 0.5, 1.0), values=(900.0, 100.0, 900.0)),
        )
    )
    text = describe_scene(scene)
    rows = text.partition("  t [s] ")[2].splitlines()[1:]
    numbers = [
        [float(word) for word in row.split()[:4]]
        for row in rows[: next(i for i, r in enumerate(rows) if "bodies" in r)]
    ]
    assert {0.0, 0.5} <= {row[0] for row in numbers}
    for time, speed, load, radius in numbers:
        assert speed == pytest.approx(np.interp(time, (0.0, 0.5, 1.0), (0.1, 2.0, 0.1)), rel=2e-3)
        assert (
            load == pytest.approx(np.interp(time, (0.0, 0.5, 1.0), (900.0, 100.0, 900.0)), rel=2e-3) and radius == 10.0
        )
    stated = " ".join(text.split())
    of_inlet = stated.partition("film thickness over that of a fully flooded inlet (Moes) is ")[2]
    assert "(at 0.5 s) to" in of_inlet.partition(". ")[0]  # the smallest one, at the largest speed


def test_the_options_of_a_scene_file_are_those_of_a_run(tmp_path, capsys):
    (tmp_path / "s.toml").write_text('options = ["--load=3"]\n' + SMALL_SCENE.to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")]) == 2
    assert 'allowed: a list of "--ratios=..."' in capsys.readouterr().err
    assert lubfric.load_scene(tmp_path / "s.toml").bodies == SMALL_SCENE.bodies


def test_a_range_in_words_is_answered_with_the_form_of_a_range(tmp_path, capsys):
    (tmp_path / "s.toml").write_text(SMALL_SCENE.to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--ratios", "0 to 0.5", "--out", str(tmp_path / "o")]) == 2
    assert "such as 0:0.5:11" in capsys.readouterr().err


def test_info_says_that_load_sharing_answers_in_place_of_the_quick_model_under_a_starved_inlet():
    """As the result does; the range of the calibration, which has flooded contacts only, is not mentioned."""
    scene = lubfric.load_scene("paper").with_(
        lubricant={"inlet_film": 100e-9, "eyring_stress": 5e6}, numerics={"model": "quick", "sampling": "patch"}
    )
    text = describe_scene(scene, [0.03])
    assert "load-sharing model in place of the quick model (numerics.model)" in text
    assert "calibrated for flooded contacts only" in text and "not calibrated for such contacts" not in text
    result = lubfric.friction(scene, 0.03)
    assert "load-sharing model in place of the quick model" in result.decision.text
    assert not any("not calibrated for such contacts" in entry.consequence for entry in result.validity)


def test_info_states_between_which_ratios_a_traction_curve_will_not_show_f():
    """Ratios in equal steps from 0 on do not show the knee of the Eyring stress; the solved curve finds the same
    gap."""
    scene = HEAVY.with_(surface={"sq": 0.0}, lubricant={"eyring_stress": 5e6})
    coarse = [0.0, 0.1, 0.2, 0.3, 0.4]
    (gap, *_) = lubfric.traction(scene, coarse, speed=1.0).gaps
    text = " ".join(described_scene(scene, (), coarse)[0].split())
    assert gap.low == 0.0 and f"between the slide-roll ratios 0 and {gap.high:g} the solved points do not" in text
    fine = [*gap.ratios, *coarse[1:]]
    assert "between the slide-roll ratios 0" not in described_scene(scene, (), fine)[0]


def test_info_names_the_speed_that_a_run_adds_and_notes_gaps_as_a_run_does():
    """Ratios from 0 in two steps pass over the knee of an Eyring oil."""
    speeds = HEAVY.with_(motion={"entrainment_speed": 0.3, "speeds": [0.1, 1.0]}, lubricant={"eyring_stress": 5e6})
    assert "3 speeds, with the entrainment speed of 0.3 m/s" in describe_scene(speeds)
    text = described_scene(speeds, ratios=[0.0, 0.1, 0.2])[0]
    assert "note: by closed forms, between the slide-roll ratios 0 and 0.1" in " ".join(text.split())


def test_info_names_no_strips_where_the_scene_requests_a_patch():
    """One patch has no strips of the load-sharing model beside it, which the sample of strips takes as a control."""
    for sampling, is_control in (("patch", False), ("strips", True)):
        scene = lubfric.load_scene("paper").with_(numerics={"sampling": sampling})
        sample = lubfric.prepare(scene).sample
        text = model_named("deterministic").described_in_auto(scene, "at 0.01 m/s", is_everywhere=True)
        assert model_named("deterministic").takes_control(scene, sample) == is_control
        assert ("as differences from the load-sharing model" in text) == is_control and ("patch" in text) != is_control
