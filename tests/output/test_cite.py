"""A result cites what it used, and nothing else; the command tells its version."""

import importlib.metadata
import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy
import pytest
from scene_text import paper_scene

import lubfric
from lubfric._base import packaged
from lubfric.estimate import cited, inputs_to_quote
from lubfric.models.quick import error_models
from lubfric.output import main
from lubfric.scene import Ramp, Transient


def test_the_papers_are_those_of_what_was_used():
    scene = paper_scene(numerics={"sampling": "patch"})
    film = lubfric.friction(scene, 1.0).cite()
    mixed = lubfric.friction(scene, 0.01, fields=True).cite()
    assert film.startswith("A. Akchurin") and "10.1007/s11249-015-0536-z" in film and "Polonsky" not in film
    assert "Polonsky" in mixed and "Gupta" not in mixed


def test_a_result_cites_the_load_sharing_model_that_it_was_compared_with():
    """The built-in scene in mixed lubrication: the deterministic model corrects the load-sharing model."""
    loose = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.3, "tolerance": 0.05})
    point = lubfric.friction(loose, 0.01)
    assert point.decision.model == "deterministic" and "10.1007/s11249-015-0536-z" in point.cite()


def test_a_paragraph_to_quote_has_what_was_used():
    """Of a curve by two models: every DOI and every purpose of its list, both models with their points, the version,
    and the parts of its intervals; of a single point its own model alone. A run in time and a study have theirs too."""
    loose = {"sampling_tolerance": 0.3, "tolerance": 0.05}
    curve = lubfric.stribeck(lubfric.load_scene("paper").with_(numerics=loose), [0.01, 1.0])
    text = curve.cite("methods")
    assert text.startswith(f"Friction was computed with lubfric {lubfric.__version__} by its ")
    assert "deterministic model (1 of 2 points)" in text and "load-sharing model (1 of 2 points)" in text
    listed = curve.cite()
    for doi in re.findall(r"doi:(\S+):", listed):
        assert text.count(f"doi:{doi}") == 1, doi
    for purpose in {line.rpartition(": ")[2] for line in listed.splitlines()}:
        assert f"{purpose} (" in text
    (low, high) = sorted(
        50 * (each.interval[1] - each.interval[0]) / each.coefficient for each in (p.uncertainty for p in curve.points)
    )
    assert text.endswith(f" Half the width of the interval is {low:.2g} to {high:.2g} % of f.")
    (low, high) = sorted(100 * each.budget["numerical"] for each in (p.uncertainty for p in curve.points))
    (_, largest) = sorted(100 * each.budget["sampling"] for each in (p.uncertainty for p in curve.points))
    assert f"the numerical error ({low:.2g} to {high:.2g} %)" in text
    assert f"the sampling error (< 0.001 to {largest:.2g} %)" in text
    known = r"- the model-form error \(.* %\)\n- the assumed range of the boundary film, half to twice 20 nm \([\d.]+"
    assert re.search(known, text) and "a method of lubfric" in text and "Hu and Zhu 2000" in text
    (head, _, listed_methods, interval) = text.split("\n\n")
    assert interval.startswith("The 95 % interval of f contains")
    assert "root of the sum of their squares" in interval and "95 % limits of independent inputs" in interval
    assert max(len(sentence.split()) for sentence in head.split(". ")) < 60 and head.count(";") == 0
    methods = (listed_methods, "", head.partition("Credit is due to the origin of ")[2])
    assert "Hu and Zhu 2000" in methods[2] and "Hu and Zhu" not in methods[0]
    assert "1 strip of " in text and "Giles 2008" in text and "2 entrainment speeds" in text
    point = curve.points[1]
    assert "by its load-sharing model." in point.cite("methods") and "Polonsky" not in point.cite("methods")
    assert "stated range" not in text and "stated range of the boundary friction coeff" in cites_methods(ANTI_WEAR)


def cites_methods(scene):
    """The paragraph of f of ``scene`` at 0.03 m/s, with an interval that is known."""
    point = lubfric.friction(scene, 0.03, raise_on_failure=False)
    known = replace(point.uncertainty, interval=(0.9 * point.coefficient, 1.1 * point.coefficient))
    return replace(point, uncertainty=known).cite("methods")


def test_the_paragraph_states_the_inputs_that_all_points_share():
    """With their units; the peak pressure of Hertz is sqrt(F E'/(2 π B R))."""
    scene = KNOWN.with_(
        lubricant={"eyring_stress": 5e6, "density_law": "dowson-higginson"}, bodies={"boundary_film": 15e-9}
    )
    point = lubfric.friction(scene, 0.03, raise_on_failure=False, fields=True)
    (head, inputs, *_) = point.cite("methods").split("\n\n")
    stated = head + inputs.replace("\n- ", "; ")
    assert "f is the force on surface 2 against its sliding over surface 1, over the load" in head
    (nx, ny) = point.decision.shape
    by_length = 1e6 * (point.fields.x[1] - point.fields.x[0])
    by_width = 1e6 * (point.fields.y[1] - point.fields.y[0])
    assert (
        f"The dry contact was solved on 1 strip of {nx} x {ny} cells in all, {by_length:.4g} µm long along the motion and {by_width:.4g} µm"
        in stated
    )
    b = scene.bodies
    peak = (b.load * b.e_prime / (2 * math.pi * b.width * b.radius)) ** 0.5
    for words in (
        "viscosity over pressure of Roelands; density over pressure of Dowson and Higginson",
        "film of the load-sharing model deformed by its own pressure alone",
        "error targets of f 5 % (numerical), 2 % (sampling, standard error), 5 % (model-form)",
        f"Sq {1e9 * scene.surface.sq:.4g} nm (Ra {1e9 * math.sqrt(2 / math.pi) * scene.surface.sq:.4g} nm); correlation "
        f"length {1e6 * scene.surface.correlation_length:.4g} µm",
        f"height map generated with the seed {scene.surface.seed}; smooth counterface",
        f"viscosity index {scene.lubricant.oil.index:.4g}; oil temperature 60 °C; density ",
        f"load {b.load:.4g} N",
        f"peak Hertz pressure {1e-6 * peak:.4g} MPa",
        "pressure-viscosity coefficient 20 1/GPa;",
        "Eyring stress 5 MPa",
        f"boundary friction coefficient {b.boundary_friction_coefficient:.4g}",
        f"slide-roll ratio S = {scene.motion.slide_roll_ratio:.4g}; ",
        "one patch of the surface in place of strips",
        "boundary film 15 nm",
        f"{nx} x {ny} points, ",
        "surface 1 is at rest, surface 2 moves at 2 U",
        "U = (u1 + u2)/2 and S = (u2 - u1)/U, u1 the speed of rough surface 1, u2 of smooth surface 2",
        "height map periodic along the line",
        "autocorrelation, 1/e at this length)",
    ):
        assert words in stated, words
    paper = lubfric.friction(scene.with_(numerics={"model": "paper"}), 0.03)
    thin = lubfric.friction(scene.with_(numerics={"model": "paper"}, bodies={"boundary_film": 5e-9}), 0.03)
    is_same = paper.coefficient == thin.coefficient
    assert is_same and "boundary film 15 nm, which limits the interval of f alone" in paper.cite("methods")
    estimated = lubfric.friction(PATCH.with_(lubricant=OIL), 0.03, raise_on_failure=False).cite("methods")
    assert "is not in the interval" in estimated and "boundary film " not in estimated.partition("Methods:")[0]
    study = lubfric.study(PATCH, {"bodies.load": [2.0, 3.0]}, [0.03]).cite("methods")
    assert "boundary friction coefficient" in study and "load 2 N" not in study and "load 2 to 3 N" in study
    assert "by its load-sharing model." in study and "\n- 2 points\n" in study
    one = lubfric.study(KNOWN.with_(numerics={"sampling": "strips", "sampling_tolerance": 0.3}), {}, [0.03])
    sides = [one[f"model_error_{end}"].item() for end in ("low", "high")]
    assert f"the model-form error ({50 * sum(sides):.2g} %)" in one.cite("methods") and sides[0] != sides[1]
    by_any = cited([], "methods", models=["paper", "quick", "deterministic"])
    assert "load-sharing model, quick model or deterministic model, the cheapest" in by_any
    assert "docs/" not in estimated + study


def test_the_paragraph_says_what_the_quick_model_is():
    """With the numbers of solved cases in its calibration; where load sharing stands in for it, this is stated."""
    study = lubfric.study(PATCH, {}, [0.03])
    as_quick = replace(study, model=numpy.full(study.model.shape, "quick", dtype=object)).cite("methods")
    assert (
        "quick model (the deterministic model of film and asperity contact on long cells, with a bias and" in as_quick
    )
    cases = {kind: model.cases for kind, model in error_models().items()}
    assert f"{cases['rest']} solved cases of roughness at rest and {cases['rolling']} of moving roughness)" in as_quick
    stands_in = lubfric.friction(PATCH.with_(lubricant={"inlet_length": 3e-4}, numerics={"model": "quick"}), 0.1)
    assert "by its load-sharing model in place of the quick model. The" in stands_in.cite("methods")


def test_heights_that_are_not_gaussian_have_no_ra_of_their_sq():
    honed = {"sq": None, "sk": 1e-6, "spk": 3e-7, "svk": 1e-6, "correlation_length": (2e-5, 1e-5)}
    stated = "; ".join(inputs_to_quote(PATCH.with_(surface=honed)))
    assert "nominal Sq" in stated and "(Ra " not in stated
    warm = PATCH.with_(lubricant=WARM)
    assert "heat modelled where it changes f by more than its share of the numerical tolerance" in inputs_to_quote(warm)


def test_the_paragraph_of_a_study_names_each_model_with_its_points():
    """Two loads of three speeds each, of which the deterministic model answers two points."""
    study = lubfric.study(PATCH, {"bodies.load": [2.0, 3.0]}, [0.03, 0.1, 0.3])
    assert "by its load-sharing model. The" in study.cite("methods") and "Jakobsson" not in study.cite()
    names = numpy.full((2, 3), "paper", dtype=object)
    names[:, 0] = "deterministic"
    mixed = replace(study, model=names)
    both = "by its load-sharing model (4 of 6 points) and deterministic model (2 of 6 points). The"
    assert both in mixed.cite("methods") and "Jakobsson" in mixed.cite()


def test_the_paragraph_states_ranges_and_what_a_curve_and_a_run_in_time_vary():
    ranged = PATCH.with_(bodies={"boundary_friction_coefficient": [0.1, 0.12]})
    assert "boundary friction coefficient 0.11 (range 0.1 to 0.12)" in cites_methods(ranged)
    traction = lubfric.traction(PATCH, [0.5, 1.0], raise_on_failure=False).cite("methods")
    assert "slide-roll ratios 0.5 to 1" in traction and "slide-roll ratio 2" not in traction
    history = Transient(0.01, outputs=5, load=Ramp(start=100.0, end=200.0, until=0.01))
    without = inputs_to_quote(PATCH, has_sampling_error=False)
    assert sorted({*without} - {*inputs_to_quote(PATCH)}) == ["sampling error of f not known"]
    strips = {*inputs_to_quote(PATCH.with_(numerics={"sampling": "strips"}))}
    of_patch = ["grid of the height map: 64 x 48 points, 1.4 µm apart", "one patch of the surface in place of strips"]
    assert sorted({*inputs_to_quote(PATCH)} - strips) == of_patch
    # a generated map may be on another grid than contact.spacing: the one that was solved is stated
    whole_map = lubfric.Surface(numpy.zeros((64, 48)), 2e-6)
    assert "grid of the height map: 64 x 48 points, 2 µm apart" in inputs_to_quote(PATCH, [whole_map])
    of_strips = inputs_to_quote(PATCH.with_(numerics={"sampling": "strips"}), [whole_map])
    assert "grid of the height map: 64 points along the motion, 2 µm apart" in of_strips
    inputs = inputs_to_quote(replace(PATCH, transient=history))
    assert "run in time over 10 ms" in inputs
    starved = inputs_to_quote(KNOWN.with_(lubricant={"inlet_length": 3e-4}, bodies={"hardness": 2.5e9}))
    assert "lubricant from 300 µm upstream of the middle on" in starved
    assert "plastic limit of the contact pressure 2.5 GPa" in starved
    assert "load 100 to 200 N" in inputs and not any("peak" in text for text in inputs)


def test_the_paragraph_names_oil_materials_and_asperities():
    """As the scene gives them; moduli of no named material name none."""

    def quoted(**changed):
        return inputs_to_quote(PATCH.with_(**changed))

    fva = quoted(lubricant={"oil": "FVA 3", "temperature": 333.15})
    assert "lubricant FVA 3, paraffinic mineral oil, VI 92 (mineral)" in fva
    assert "lubricant 68 mm²/s at 40 °C and 8.6 mm²/s at 100 °C (mineral)" in quoted(lubricant=OIL)
    grade = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 333.15}
    assert "lubricant ISO VG 68 (mineral)" in quoted(lubricant=grade)
    for names in (["steel", "bronze"], ["bronze", "steel"], ["16MnCr5", "42CrMo4"]):
        assert f"material of the bodies {' and '.join(names)}" in quoted(bodies={"material": names})
    assert "material of the bodies 100Cr6" in quoted(bodies={"material": "100Cr6"})
    for unnamed in ({"e_prime": 2.3e11}, {"material": "steel", "conductivity": (46.0, 47.0)}):
        assert not any(text.startswith("material") for text in quoted(bodies=unnamed))
    assert any("summit" in text for text in quoted(contact={"model": "summits"}))
    assert not any("summit" in text for text in quoted())


def test_a_mirrored_map_is_quoted_as_it_was_measured(tmp_path):
    """Its file has 60 x 40 points 2 µm apart, one of them unmeasured."""
    z = 1e-7 * numpy.random.default_rng(1).standard_normal((60, 40))
    z[3, 4] = math.nan
    numpy.save(tmp_path / "map.npy", z)
    surface = {"file": str(tmp_path / "map.npy"), "spacing": 2e-6, "extension": "mirror"}
    scene = lubfric.load_scene("paper").with_(surface=surface)
    whole = lubfric.read_surface(tmp_path / "map.npy", spacing=2e-6)
    (text, *_) = inputs_to_quote(scene, [whole])
    assert text.startswith("height map map.npy (60 x 40 points, 120 x 80 µm, Sq ")
    assert "0.042 % of the points unmeasured" in text and text.endswith("extended by its mirror image)")


def test_both_models_of_one_gap_cite_the_same_film():
    small = PATCH.with_(surface={"acf": "gaussian", "correlation_length": 16e-6})
    given = {"grid": "given", "accept": True}
    for model in ("quick", "deterministic"):
        cites_it = lubfric.friction(
            small.with_(numerics=given | {"model": model}, contact={"shape": (48, 48), "spacing": 1.9e-6}),
            0.03,
            raise_on_failure=False,
        ).cite()
        assert "Jakobsson" in cites_it and "Olsson" in cites_it, model


def test_a_curve_cites_every_paper_once():
    by_speed = lubfric.stribeck(PATCH, [0.01, 0.03, 1.0])
    by_ratio = lubfric.traction(PATCH.with_(lubricant=LAWS), [0.0, 0.5], speed=0.1)
    for curve in (by_speed, by_ratio):
        lines = curve.cite().splitlines()
        assert len(lines) == len(set(lines)) and set(lines) == {
            line for point in curve.points for line in point.cite().splitlines()
        }
    assert "Bair" not in by_ratio.points[0].cite() and "Bair" in by_ratio.points[1].cite()


def test_a_run_in_time_cites_the_model_that_was_solved():
    """A run by "quick" is one by load sharing."""
    plan = lubfric.Transient(1e-5, outputs=1)
    by_model = [lubfric.transient(PATCH.with_(transient=plan, numerics={"model": name})) for name in ("paper", "quick")]
    assert by_model[0].coefficient.tobytes() == by_model[1].coefficient.tobytes()
    assert by_model[0].cite() == by_model[1].cite()
    paragraph = by_model[1].cite("methods")
    assert "by its load-sharing model." in paragraph and f"\n- {by_model[1].time.size} outputs\n" in paragraph
    assert "interval" not in paragraph  # a patch: without the error of the sample


def test_a_run_in_time_quotes_the_width_of_the_interval_of_its_mean():
    short = {"shape": (64, 16), "spacing": 1.4e-6}
    run = lubfric.transient(paper_scene(contact=short, transient=lubfric.Transient(1e-5, outputs=1)))
    mean = run.average()
    (quoted,) = re.findall(r"Half the width of the interval is ([0-9.]+) % of f", run.cite("methods"))
    assert float(quoted) == pytest.approx(100 * (mean.interval[1] - mean.interval[0]) / 2 / mean.coefficient, rel=0.02)


PATCH = paper_scene(contact={"shape": (64, 48), "spacing": 1.4e-6}, numerics={"sampling": "patch", "tolerance": 0.05})
OIL = {"nu40": 68e-6, "nu100": 8.6e-6, "temperature": 333.15}
LAWS = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.05}
WARM = {"temperature": 313.15, "temperature_coefficient": 0.04}
HOT = PATCH.with_(lubricant=WARM | LAWS, numerics={"heat": "on"})
ANTI_WEAR, BASE_OIL, OWN_RANGE = (
    PATCH.with_(bodies={"boundary_friction_coefficient": given}) for given in ("anti-wear", "base oil", [0.1, 0.15])
)
KNOWN = PATCH.with_(lubricant=OIL | {"pressure_viscosity_coefficient": 2e-8})


@cache
def cites(scene):
    """What stands behind f of ``scene`` at 0.03 m/s."""
    return lubfric.friction(scene, 0.03, raise_on_failure=False).cite()


@pytest.mark.parametrize(
    ("author", "used", "not_used"),
    [
        ("Roelands", PATCH, PATCH.with_(lubricant={"viscosity_law": "constant"})),
        ("Barus", PATCH.with_(lubricant={"viscosity_law": "barus"}), PATCH),
        ("Higginson", PATCH.with_(lubricant={"density_law": "dowson-higginson"}), PATCH),
        ("Tevaarwerk", PATCH.with_(lubricant={"eyring_stress": 5e6}), PATCH),
        ("Tevaarwerk", HOT, HOT.with_(motion={"slide_roll_ratio": 0.0})),
        ("Bair", PATCH.with_(lubricant={"limiting_stress_coefficient": 0.05}), PATCH),
        ("D341", PATCH.with_(lubricant=OIL), PATCH),
        ("D2270", PATCH.with_(lubricant={"grade": "VG 68", "viscosity_index": 95, "temperature": 333.15}), KNOWN),
        ("Klaus", PATCH.with_(lubricant=OIL), PATCH.with_(lubricant=OIL | {"alpha_estimate": "gold"})),
        ("Gold", PATCH.with_(lubricant=OIL | {"base": "pao"}), PATCH.with_(lubricant=OIL)),
        ("Ueda", ANTI_WEAR, BASE_OIL),
        ("Arana", BASE_OIL, OWN_RANGE),
        ("Arana", PATCH.with_(lubricant={"eyring_stress": "mineral"}), PATCH.with_(lubricant={"eyring_stress": 5e6})),
        ("Gupta|Sheu|Nahme|Jaeger", HOT, HOT.with_(numerics={"heat": "off"})),
        ("H. Eyring", HOT, HOT.with_(lubricant={"eyring_stress": None, "carreau": (5e6, 0.7)})),
        ("Houpert", HOT, HOT.with_(lubricant={"limiting_stress_coefficient": None})),
        ("Greenwood, J. B. P.", PATCH.with_(contact={"model": "summits"}), PATCH),
        ("Polonsky", PATCH, PATCH.with_(contact={"model": "summits"})),
        ("Johnson, J. A.", PATCH.with_(numerics={"film_deflection": "scaled"}), PATCH),
        ("Satterthwaite", PATCH.with_(numerics={"sampling": "strips", "sampling_tolerance": 0.2}), PATCH),
    ],
)
def test_an_option_is_cited_where_it_was_used(author, used, not_used):
    for name in author.split("|"):
        assert name in cites(used) and name not in cites(not_used)


def test_the_shear_of_the_flow_is_cited_for_a_film_that_it_thins():
    whole = PATCH.with_(
        contact={"shape": (48, 48), "spacing": 1.9e-6},
        surface={"acf": "gaussian", "correlation_length": 16e-6},
        numerics={"model": "deterministic", "grid": "given", "accept": True},
    )
    eyring = whole.with_(lubricant={"eyring_stress": 5e6})
    newtonian, sheared = (lubfric.friction(s, 0.1, raise_on_failure=False).cite() for s in (whole, eyring))
    assert "Jakobsson" in newtonian and "in one gap, solved together" in newtonian
    assert "Akchurin" not in newtonian and "Conry" not in newtonian
    assert "Conry" in sheared and "Tevaarwerk" in sheared
    assert "Conry" in lubfric.friction(PATCH.with_(lubricant=LAWS), 0.1).cite()
    carreau = lubfric.friction(PATCH.with_(lubricant=LAWS | {"eyring_stress": None, "carreau": (5e6, 0.7)}), 0.1).cite()
    assert "Carreau" in carreau and "Tevaarwerk" not in carreau and "Conry" not in lubfric.friction(PATCH, 0.1).cite()


def test_filters_are_cited_and_a_map_that_was_handed_over_is_not(tmp_path):
    heights = lubfric.generate_surface((128, 128), 0.7e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=1)
    numpy.save(tmp_path / "map.npy", heights.heights)
    as_it_is = PATCH.with_(surface={"file": str(tmp_path / "map.npy"), "spacing": 0.7e-6}, contact={"shape": None})
    filtered = as_it_is.with_(surface={"s_filter": 4e-6})
    plain = lubfric.friction(as_it_is, 0.03).cite()
    assert "16610" in lubfric.friction(filtered, 0.03).cite() and "16610" not in plain and "Tønder" not in plain
    assert "Tønder" in lubfric.friction(PATCH, 0.03).cite()
    given = lubfric.prepare(PATCH, heights.periodic(axes=(False, True)))
    assert "Tønder" not in lubfric.friction(given, 0.03).cite()


def test_what_was_used_is_kept_with_a_stored_point(tmp_path):
    """The papers do not hang on the fields, which a store leaves out."""
    again = [lubfric.stribeck(PATCH, [0.01, 0.03], store=tmp_path).cite() for _ in range(2)]
    assert again[0] == again[1] == lubfric.stribeck(PATCH, [0.01, 0.03]).cite() and "Polonsky" in again[0]


def test_the_command_tells_its_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0 and capsys.readouterr().out.strip() == f"lubfric {lubfric.__version__}"
    assert importlib.metadata.version("lubfric")


def test_sources_come_as_bibtex():
    """Every source once, of its own kind, with its authors, title, place and year; keys differ."""
    papers = packaged("lubfric.estimate", "papers.toml")
    sources = [source for group in papers.values() for source in group]
    text = cited(papers, "bibtex")
    entries = {}
    for kind, key, body in re.findall(r"@(\w+)\{([^,]+),\n(.*?)\n\}", text, re.DOTALL):
        entries[key] = {"kind": kind} | dict(re.findall(r"  (\w+) = \{(.*)\},?", body))
    assert len(entries) == len(sources) == text.count("@") and text.count("{") == text.count("}")
    needed = {
        "article": {"journal", "volume"},
        "book": {"publisher"},
        "phdthesis": {"school"},
        "techreport": {"institution", "number"},
        "misc": {"howpublished", "version"},
    }
    for entry in entries.values():
        assert {"author", "title", "year"} | needed[entry["kind"]] <= set(entry), entry
        assert all(entry.values()) and re.fullmatch(r"(18|19|20)\d\d", entry["year"])
    articles = [entry for entry in entries.values() if entry["kind"] == "article"]
    assert sum("pages" in entry for entry in articles) >= len(articles) - 2  # a whole issue has none
    assert sum("doi" in entry for entry in articles) >= len(articles) - 6
    paper = entries["Akchurin2015"]
    assert paper["author"] == "A. Akchurin and R. Bosman and P. M. Lugt and M. van Drogen"
    assert paper["doi"] == "10.1007/s11249-015-0536-z" and paper["journal"] == "Tribology Letters"
    assert (paper["volume"], paper["pages"], paper["year"]) == ("59", "19", "2015")
    citation = (Path(__file__).parents[2] / "CITATION.cff").read_text(encoding="utf-8")
    for text in (paper["title"], entries["lubfric"]["title"]):
        assert text.replace("{", "").replace("}", "") in citation
    assert entries["lubfric"]["version"] == lubfric.__version__
    # styles of BibTeX print no "version"
    assert entries["lubfric"]["howpublished"].endswith(f"version {lubfric.__version__}")
    assert "(1999) 206-219, doi:10.1016/S0043-1648(99)00113-1: contact" in cited(papers)
    point = lubfric.friction(PATCH, 0.1)
    assert point.cite("bibtex").count("@") == len(point.cite().splitlines())
    with pytest.raises(lubfric.InputError, match="format"):
        point.cite(format="word")


def test_every_result_cites_lubfric_once():
    """Whatever model answered: the program with its version, as a line and as an entry of BibTeX."""
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    curve = lubfric.traction(PATCH, [0.0, 0.5], speed=0.1)
    for result in (
        curve,
        lubfric.friction(PATCH, 0.03),
        lubfric.study(PATCH, {}, [0.03]),
        lubfric.friction(scene, 1.0),
    ):
        lines = [line for line in result.cite().splitlines() if line.startswith(f"lubfric {lubfric.__version__}")]
        assert len(lines) == 1 and result.cite("bibtex").count("@misc{lubfric,") == 1


def test_degrees_and_letters_in_an_entry_are_of_latex():
    assert r"K. T{\o}nder" in cited(["generated map"], "bibtex") and "K. Tønder" in cited(["generated map"])
    entry = cited(["viscosity index"], "bibtex")
    assert "at 40 {$^\\circ$C} and 100 {$^\\circ$C}" in entry and "°" not in entry
    every_entry = cited(packaged("lubfric.estimate", "papers.toml"), "bibtex")
    assert every_entry.isascii() and r"{Beitr{\"a}ge}" in every_entry and r"Larra{\~n}aga" in every_entry
    assert "{Journal and Proceedings of the Royal Society of New South Wales}" in cited(["flash"], "bibtex")


def test_commands_write_the_sources_as_bibtex(tmp_path):
    """Beside the report of a run and of a study: the entries of what it cites."""
    (tmp_path / "small.toml").write_text(PATCH.to_toml())
    (tmp_path / "study.toml").write_text('scene = "small.toml"\nspeeds = [0.03]\n')
    out = {name: tmp_path / name for name in ("curve", "traction", "study")}
    assert main(["run", str(tmp_path / "small.toml"), "--speeds", "0.03", "--out", str(out["curve"])]) == 0
    assert main(["run", str(tmp_path / "small.toml"), "--ratios", "0.5", "--out", str(out["traction"])]) == 0
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(out["study"])]) == 0
    expected = lubfric.friction(PATCH, 0.03).cite("bibtex") + "\n"
    assert (out["curve"] / "references.bib").read_text(encoding="utf-8") == expected
    assert (out["study"] / "references.bib").read_text(encoding="utf-8") == expected
    assert "@misc{lubfric," in (out["traction"] / "references.bib").read_text(encoding="utf-8")
