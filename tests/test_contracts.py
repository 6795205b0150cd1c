"""Each contract, as any implementation has to keep it: `Sample`, `RoughContact.close`, `Model`, and a further model."""

import math
import re
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH
from toys import Spring

import lubfric
from lubfric.contact import FlatContact
from lubfric.errors import CONVERGED, Report
from lubfric.estimate.choice import choose
from lubfric.estimate.solve_to_tolerance import solve_to_tolerance
from lubfric.estimate.work_of_point import estimated_work_of_point
from lubfric.models import (
    MODELS,
    AnswerErrors,
    DeterministicModel,
    Model,
    ModelAnswer,
    PaperModel,
    QuickModel,
    SampleSolution,
    registry,
)
from lubfric.models.deterministic import DeterministicSolution, answer
from lubfric.models.shared import Assumption, Decision, StandardError, Violation, contact_on_joined_strips
from lubfric.output import budget_bars, describe_scene, main, study_answer, study_report
from lubfric.quantities import CHOICES, COLUMNS
from lubfric.samples import Cells, Sample

PAPER = lubfric.load_scene("paper")
FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (64, 64), "spacing": 8e-6}, surface={"correlation_length": 24e-6, "acf": "gaussian"}
)
# Few strips and a loose solve: where their errors are not the matter.
LOOSE = PAPER.with_(
    contact={"shape": (96, 96), "spacing": 0.9e-6}, numerics={"sampling_tolerance": 0.1, "tolerance": 0.05}
)
TWO = PAPER.with_(counterface={"sq": 50e-9, "correlation_length": 4e-6})


def measured(tmp_path) -> lubfric.Scene:
    surface = lubfric.generate_surface((500, 240), 0.5e-6, sq=100e-9, correlation_length=5e-6, seed=3)
    np.save(tmp_path / "map.npy", surface.heights)
    given = {"file": str(tmp_path / "map.npy"), "spacing": 0.5e-6, "sq": None, "correlation_length": None}
    return PAPER.with_(surface=given, contact={"shape": None, "spacing": None})


@pytest.fixture(params=["generated", "two bodies", "measured", "patch", "flat"])
def prepared(request, tmp_path) -> lubfric.Prepared:
    scenes = {
        "generated": PAPER,
        "two bodies": TWO,
        "measured": measured(tmp_path),
        "patch": PAPER.with_(numerics={"sampling": "patch"}),
        "flat": FLAT,
    }
    return lubfric.prepare(scenes[request.param])


@pytest.fixture
def sample(prepared) -> Sample:
    return prepared.sample


class TestSample:
    def test_a_strip_depends_on_its_number_alone(self, prepared, sample):
        """And on no strip that was made before it: a second sample makes the same ones in another order."""
        count = min(sample.available_strips, 3)
        strips = [sample.strip(k).heights for k in range(count)]
        second = lubfric.prepare(prepared.scene).sample
        assert second is not sample
        backwards = [second.strip(k).heights for k in reversed(range(count))]
        assert np.array_equal(strips, backwards[::-1])
        assert sample.strip(0).shape == (sample.cells.columns, sample.rows)

    @pytest.mark.parametrize("prepared", ["generated", "two bodies", "measured"], indirect=True)
    def test_a_longer_sample_contains_a_shorter_one(self, sample):
        stack = sample.joined(range(2)).heights
        middle = slice(sample.rows // 2, sample.rows - sample.rows // 4)  # away from where strips are joined
        assert np.allclose(stack[:, middle], sample.strip(0).heights[:, middle], atol=1e-15)

    def test_one_strip_joined_is_one_strip_long(self, sample):
        assert sample.joined(range(1)).shape[1] == sample.rows_of(1)

    def test_native_cells_are_those_of_the_scene(self, sample):
        native = sample.native()
        assert native.cells.is_native and native.cells.spacing == pytest.approx(native.strip(0).spacing)
        assert native.cells.columns == sample.cells.columns * sample.cells.coarsening[0]
        assert native.correlation_lengths == sample.correlation_lengths and native.strip_length == sample.strip_length

    def test_every_nth_cell_of_a_piece_is_a_coarse_one(self, sample):
        piece = sample.piece(0)
        thinned = sample.cells.thinned(piece.heights, sample.cells.coarsening)
        assert thinned.shape[0] == sample.cells.axis().size == sample.cells.columns
        assert piece.spacing == pytest.approx(sample.cells.native_spacing)

    @pytest.mark.parametrize("prepared", ["two bodies"], indirect=True)
    def test_bodies_add_up(self, sample):
        parts = sum(sample.of_body(k).strip(0).heights for k in (0, 1))
        assert np.allclose(parts, sample.strip(0).heights, atol=1e-12)

    def test_it_is_on_its_surface_on_any_cells(self, sample):
        assert sample.is_on_surface_of(sample.native()) and sample.native().is_on_surface_of(sample)

    @pytest.mark.parametrize("prepared", ["two bodies"], indirect=True)
    def test_a_body_is_not_on_the_surface_of_both(self, prepared, sample):
        """So the contact on a body is its own, and not the remembered one of both."""
        body = sample.of_body(0)
        assert not body.is_on_surface_of(sample)
        on_both, on_body = (contact_on_joined_strips(prepared, each, 1).heights for each in (sample, body))
        assert np.allclose(on_body, body.strip(0).heights - body.strip(0).heights.mean(), atol=1e-15)
        assert not np.allclose(on_both, on_body, atol=1e-9)

    def test_it_makes_the_contact_that_is_solved_first(self, prepared):
        """On its cells, about their mean; the operator comes from whoever remembers it."""
        sample = prepared.sample
        requested = []

        def operator(shape, spacing):
            requested.append((shape, spacing))
            return prepared.rough_contact.operator

        contact = sample.contact(prepared.scene, sample.first_strips, operator)
        assert type(contact) is type(prepared.rough_contact) and np.array_equal(contact.x, prepared.rough_contact.x)
        if isinstance(prepared.rough_contact, FlatContact):  # it has no operator
            assert requested == []
            return
        first = sample.joined(range(sample.first_strips))
        assert requested == [(first.shape, first.spacing)]
        assert np.array_equal(contact.heights, first.heights - first.heights.mean())

    def test_only_a_map_that_is_all_there_is_has_images_and_no_renewal(self, prepared):
        """A map that is its own mirror image holds half of its rows; nothing else of it ever passes the contact."""
        sample = prepared.sample
        heights = np.hstack([np.arange(6.0)[None], np.arange(6.0)[None, ::-1]])
        half_width = prepared.scene.bodies.half_width
        distance = sample.renewal_length(half_width)
        if not sample.represents_more:
            assert sample.distinct_rows(heights) == 6 and math.isnan(distance) and sample.in_words(1) == "the patch"
            assert sample.on_field_cells().cells.is_native and sample.coarsening_to_look_at(half_width) == (1, 1)
        else:
            assert sample.distinct_rows(heights) == 12 and distance > 2 * half_width
            assert sample.on_field_cells() is sample and "2 strips" in sample.in_words(2)
            assert "statistics of" in sample.described(prepared.surface)[1]


@dataclass(frozen=True, kw_only=True)
class FromOutside(Sample):
    """The strips of another sample, under a class that lubfric does not know."""

    inner: Sample
    cells: Cells
    correlation_lengths: tuple[float, float]
    strip_length: float
    first_strips: int
    available_strips: int
    available_pieces: int
    has_exact_sq: bool
    represents_more: bool
    refines_in_place: bool

    @property
    def made(self) -> Sample:
        return replace(self.inner, cells=self.cells)

    def joined(self, indices):
        return self.made.joined(indices)

    def piece(self, index, *length):
        return self.made.piece(index, *length)

    def of_body(self, body):
        return replace(self, inner=self.inner.of_body(body))

    def rows_of(self, count):
        return self.made.rows_of(count)


@pytest.mark.parametrize("model", [model.name for model in MODELS])
@pytest.mark.parametrize("sampling", ["strips", "patch"])
def test_a_sample_of_any_class_is_solved_by_its_contract_alone(model, sampling):
    """By each model, on cells that shorten or not: f, its interval and its reasons are the same to the bit."""
    prepared = lubfric.prepare(LOOSE.with_(numerics={"sampling": sampling, "model": model}))
    inner = prepared.sample
    known = {name: getattr(inner, name) for name in FromOutside.__dataclass_fields__ if name != "inner"}
    other = replace(prepared, sample=FromOutside(inner=inner, **known))
    expected, result = (lubfric.friction(each, 0.03) for each in (prepared, other))
    assert result.coefficient == expected.coefficient
    assert result.uncertainty.interval == pytest.approx(expected.uncertainty.interval, rel=0, abs=0, nan_ok=True)
    assert result.decision.model == model and result.decision.shape == expected.decision.shape


class TestModel:
    @pytest.mark.parametrize("model", [PaperModel(), QuickModel(), DeterministicModel()], ids=lambda model: model.name)
    def test_a_solution_says_all_that_the_estimate_needs(self, model):
        prepared = lubfric.prepare(LOOSE)
        count = model.strips_to_begin_with(prepared.sample)
        solution = model.solve(prepared, prepared.sample, count, 0.03)
        assert isinstance(solution, SampleSolution) and solution.count == count
        assert solution.required_strips() >= count
        assert solution.answer().numbers == solution.completed().answer().numbers
        completed = solution.corrected().completed()
        assert completed.completed() is completed and (completed.may_suffice() or not completed.why_sufficient())
        answer = completed.answer()
        assert 0 < answer.numbers["coefficient"] < 0.1
        assert answer.errors.numerical > 0 and answer.errors.sampling_error.value > 0
        assert answer.report.converged
        assert answer.fields.heights.shape == answer.fields.shear.shape == answer.fields.pressure.shape
        again = model.solve(prepared, prepared.sample, count, 0.03, start=solution).corrected().completed()
        f = answer.numbers["coefficient"]
        assert again.answer().numbers["coefficient"] == pytest.approx(f, rel=1e-3)

    def test_shorter_cells_of_deterministic_strips_are_solved_once(self, monkeypatch):
        calls = []
        home = "lubfric.models.deterministic.deterministic_model."
        monkeypatch.setattr(home + "levels_of", lambda *arguments: calls.append(arguments) or "levels")
        monkeypatch.setattr(home + "answer_of", lambda prepared, speed, levels: levels)
        solution = DeterministicSolution(
            prepared=None, sample=None, count=1, speed=0.03, pairs=(), estimate=None, wanted=1
        )
        assert {solution.answer(), solution.corrected().answer(), solution.answer()} == {"levels"}
        assert len(calls) == 1

    def test_a_model_estimates_its_work_before_any_solve(self, monkeypatch):
        """Each beyond the cheaper ones; at an order of magnitude that a tighter tolerance raises."""
        for model in MODELS:
            monkeypatch.setattr(type(model), "solve", None)
        for scene in (PAPER, PAPER.with_(numerics={"sampling_tolerance": 0.002, "model_tolerance": 0.005})):
            sample = lubfric.prepare(scene).sample
            cheaper = None
            seconds = []
            for model in MODELS:
                cheaper = model.estimate_work(scene, sample, sample.stated_map(), 0.03, cheaper)
                seconds.append(cheaper.seconds)
                assert cheaper.strips >= 1
            if scene is PAPER:
                before = seconds
        assert all(a <= b for a, b in zip(before, seconds)) and sum(before) < sum(seconds)

    def test_neither_model_has_an_answer_without_its_needs(self):
        flat = lubfric.prepare(FLAT)
        assert PaperModel().why_unable(flat, 0.0) == "" and DeterministicModel().why_unable(flat, 0.03)
        assert DeterministicModel().why_unable(lubfric.prepare(PAPER), 0.0)


@dataclass(frozen=True, kw_only=True)
class Highest(SampleSolution):
    """f = 1e5/m times the mean over strips of their highest summit, which needs no solve."""

    prepared: lubfric.Prepared
    sample: Sample
    count: int
    speed: float

    @property
    def values(self) -> np.ndarray:
        return np.array([1e5 * self.sample.strip(k).heights.max() for k in range(self.count)])

    @property
    def sampling_error(self) -> StandardError:
        error = self.values.std(ddof=1) / math.sqrt(self.count) / self.values.mean()
        return StandardError(float(error), self.count - 1)

    def answer(self) -> ModelAnswer:
        load = self.prepared.scene.bodies.load
        f = float(self.values.mean())
        numbers = {"coefficient": f, "speed": self.speed, "contact_load": load, "film_load": 0.0}
        return ModelAnswer(
            numbers=numbers | {"boundary_force": f * load, "rolling_resistance": 1.0},
            errors=AnswerErrors(
                numerical=0.0,
                sampling_error=self.sampling_error,
                model_error=(0.5, 0.5),
                of_numbers={"rolling_resistance": 0.0},
            ),
            report=Report("highest summit", CONVERGED, iterations=1, residual=0.0, tolerance=1.0, residuals={}),
            decision=Decision(film_in_words="none", contact_in_words="none", tolerance=0.01, strips=self.count),
            length=self.count * self.sample.strip_length,
        )


class HighestSummit(Model):
    """A further model, of no physics."""

    name = "highest summit"

    def solve(self, prepared, sample, count, speed, *, start=None, control=None):
        return Highest(prepared=prepared, sample=sample, count=count, speed=speed)


def test_a_further_model_answers_through_the_same_contract():
    """The estimate takes strips until the standard error of their mean is as small as asked, and says so."""
    for tolerance in (0.05, 0.02):
        prepared = lubfric.prepare(PAPER.with_(numerics={"sampling_tolerance": tolerance}))
        result = lubfric.friction(prepared, 0.03, model=HighestSummit())
        values = [1e5 * prepared.sample.strip(k).heights.max() for k in range(result.decision.strips)]
        assert result.coefficient == pytest.approx(np.mean(values), rel=1e-12)
        error = np.std(values, ddof=1) / math.sqrt(len(values)) / result.coefficient
        assert result.uncertainty.sampling == pytest.approx(error) and error <= tolerance
        low, high = result.uncertainty.interval
        assert high - low >= result.coefficient and math.isnan(result.min_film)
        assert result.decision.model == "highest summit"
        reasons = result.errors.reasons
        assert reasons["contact_load"] == "not known" and reasons["min_film"] == "not computed by the model"
        assert reasons["film_load"] == "it is 0, and so has no relative error" and "coefficient" in reasons
    assert len(values) > prepared.sample.first_strips


@pytest.mark.parametrize("takes_cells", [True, False])
def test_a_model_is_asked_for_shorter_cells_where_it_takes_those_of_the_sample(monkeypatch, takes_cells):
    """Down to native ones, where its solutions require it; else on the first ones, whatever is shown."""
    monkeypatch.setattr(HighestSummit, "takes_cells_of_sample", takes_cells, raising=False)
    monkeypatch.setattr(Highest, "is_too_coarse", lambda self: True)
    monkeypatch.setattr(Highest, "sampling_error", StandardError(0.0, 3))
    loose = lubfric.prepare(PAPER.with_(numerics={"sampling_tolerance": 0.5}))
    solution = solve_to_tolerance(loose, 0.03, HighestSummit())
    assert not loose.sample.cells.is_native
    assert solution.sample.cells == (loose.sample.native().cells if takes_cells else loose.sample.cells)
    patch = lubfric.prepare(PAPER.with_(numerics={"sampling": "patch"}))
    shown = solve_to_tolerance(patch, 0.03, HighestSummit(), for_fields=True)
    assert shown.sample.cells.is_native is takes_cells


@dataclass(frozen=True, kw_only=True)
class Scattered(Highest):
    """The same, with a given standard error, of a sample that is short."""

    scatter: float

    @property
    def sampling_error(self) -> StandardError:
        return StandardError(self.scatter, self.count - 1)

    def answer(self) -> ModelAnswer:
        known = {"value": 5.0, "limit": 10.0, "unit": "", "consequence": "few asperities", "recommendation": "more"}
        short = Violation(assumption=Assumption.LONG_SAMPLE, what="length", **known)
        return replace(super().answer(), violations=(short,))


@pytest.mark.parametrize(("scatter", "matters"), [(0.01, True), (1e-6, False), (math.nan, True)])
def test_a_short_sample_is_a_warning_where_f_depends_on_it(monkeypatch, scatter, matters):
    def solve(self, prepared, sample, count, speed, **_):
        return Scattered(prepared=prepared, sample=sample, count=count, speed=speed, scatter=scatter)

    monkeypatch.setattr(HighestSummit, "solve", solve)
    result = lubfric.friction(PAPER, 0.03, model=HighestSummit())
    assert (Assumption.LONG_SAMPLE in [violation.assumption for violation in result.validity]) == matters


@pytest.fixture
def named(monkeypatch) -> lubfric.Scene:
    """A scene that names the further model, which is registered as the most expensive one."""
    monkeypatch.setattr("lubfric.models.registry.MODELS", (*MODELS, HighestSummit()))
    monkeypatch.setitem(CHOICES, "numerics.model", (*CHOICES["numerics.model"], HighestSummit.name))
    return PAPER.with_(
        numerics={"model": HighestSummit.name, "sampling_tolerance": 0.05}, motion={"slide_roll_ratio": 0.5}
    )


def test_a_registered_model_answers_wherever_a_scene_names_it(named, tmp_path):
    """Point, curve, traction and study have its f, and what they say of it is not another model's."""
    result = lubfric.friction(named, 0.03)
    assert result.coefficient == lubfric.friction(named, 0.03, model=HighestSummit()).coefficient
    assert result.balance is None and result.deterministic is None
    assert "motion of the roughness" in str(result.unmodelled_effects)
    curve = lubfric.stribeck(named, [0.01, 0.03], store=tmp_path / "store")
    again = lubfric.stribeck(named, [0.01, 0.03], store=tmp_path / "store")
    traction = lubfric.traction(named, [0.1, 0.5], speed=0.03)
    for swept in (curve, again, traction):
        assert swept.coefficient == pytest.approx([result.coefficient] * 2, rel=1e-12)
    study = lubfric.study(named, {"motion.slide_roll_ratio": [0.1, 0.5]}, speeds=[0.03])
    assert study["coefficient"].ravel() == pytest.approx([result.coefficient] * 2, rel=1e-12)
    assert curve.cite() == study.cite() == result.cite()


def test_a_registered_model_is_described_and_reported(named, tmp_path):
    """By the command line: what it is before the solve, and a report of its answer."""
    text = describe_scene(named)
    assert "highest summit model (numerics.model)" in text and "'deterministic' to model this motion" in text
    numerics = '[numerics]\nmodel = "highest summit"\nsampling_tolerance = 0.05\n'
    scene = BODIES_AND_OIL + SMALL_PATCH.split("[numerics]")[0] + numerics
    (tmp_path / "scene.toml").write_text(scene + "[motion]\nslide_roll_ratio = 0.5\nentrainment_speed = 0.03\n")
    assert main(["info", str(tmp_path / "scene.toml")]) == 0
    assert main(["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "run"), "--speeds", "0.01,0.03"]) == 0
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    page = re.sub(r"base64,[^\"]*", "", page)  # letters of pictures
    assert "The asperities carry 100 % of the load" in page and "Motion of the roughness" in page and "nan" not in page


@pytest.mark.parametrize("given", [None, 1e9])
def test_an_input_that_is_not_given_is_named_by_its_label(named, monkeypatch, tmp_path, given):
    """Of a model that needs another one than the boundary film: in the page of a curve and in that of a study."""
    key = "lubricant.shear_modulus"
    answer = Highest.answer
    missing = {key: (-0.1, 0.2)} if given is None else {}
    monkeypatch.setattr(Highest, "answer", lambda self: replace(answer(self), not_given=missing))
    monkeypatch.setattr("lubfric.scene.scene.ASSUMED_IN_A_RANGE", (key,))
    scene = named.with_(lubricant={"shear_modulus": given})
    curve = lubfric.stribeck(scene, [0.01, 0.03])
    bars = budget_bars.budget_labels([curve.points[0]])
    assert bars.get("not given") == (f"{COLUMNS[key].label} (not given)" if missing else None)
    study = lubfric.study(scene, {}, speeds=[0.03])
    page = study_report.study_page(study, {}, study_answer.answer_lines(study)).decode()
    assert ("elastic shear modulus of the film not given -10 to +20 %" in page) == bool(missing)
    assert (">elastic shear modulus of the film not given</th>" in page) == bool(missing)
    assert "boundary film not given" not in page


def test_a_registered_model_without_a_run_in_time_says_so(named):
    for run in (
        lambda: lubfric.transient(named, [0.0, 1e-3]),
        lambda: describe_scene(named.with_(transient=lubfric.Transient(1e-3))),
    ):
        with pytest.raises(
            lubfric.InputError, match="numerics.model = 'highest summit': this model has no run in time"
        ):
            run()
    with pytest.raises(lubfric.InputError, match="numerics.model = 'highest summit': wear takes"):
        lubfric.run_in(named.with_(bodies={"hardness": 8e9}), distance=1.0, wear_coefficient=1e-4)


def test_a_further_model_has_no_paper_and_no_error_of_another(monkeypatch):
    """Its rolling resistance, whose model-form error nobody stated, is as uncertain as f; alone it has no papers."""
    scene = PAPER.with_(numerics={"sampling_tolerance": 0.05}, motion={"slide_roll_ratio": 0.5})
    result = lubfric.friction(scene, 0.03, model=HighestSummit())
    assert set(result.methods) == {"interval", "generated map"}
    half_widths = [abs(end / result.coefficient - 1) for end in result.uncertainty.interval]
    parts = [(width * result.coefficient * scene.bodies.load * 0.015, width * (0.03 - 0.0075)) for width in half_widths]
    loss = result.power_loss
    expected = (loss - math.hypot(*parts[0]), loss + math.hypot(*parts[1]))
    assert result.power_loss_interval == pytest.approx(expected, rel=1e-12)
    monkeypatch.setattr(HighestSummit, "rolling_error", lambda self, lambda_ratio, film_growth: 0.25)
    result = lubfric.friction(scene, 0.03, model=HighestSummit())
    by_rolling = math.sqrt((result.power_loss_interval[1] - result.power_loss) ** 2 - parts[1][0] ** 2)
    assert by_rolling == pytest.approx(0.25 * (0.03 - 0.0075), rel=1e-9)


@pytest.mark.parametrize("takes", [True, False])
@pytest.mark.parametrize("requested", ["auto", "highest summit"])
def test_only_a_model_that_takes_a_control_is_given_one(monkeypatch, requested, takes):
    """Without one, the cheapest model is not solved beside a named one, nor kept with an answer."""

    class Recorder(HighestSummit):
        controls: ClassVar[list] = []

        def takes_control(self, scene, sample):
            return takes

        def solve(self, prepared, sample, count, speed, *, start=None, control=None):
            self.controls.append(control)
            return super().solve(prepared, sample, count, speed, start=start, control=control)

    monkeypatch.setattr(registry, "MODELS", (PaperModel(), Recorder()))
    choice = choose(lubfric.prepare(LOOSE), 0.03, requested)
    assert choice.model.name == "highest summit"
    assert all((control is not None) == takes for control in Recorder.controls) and Recorder.controls
    assert (choice.compared is not None) == takes


@pytest.mark.parametrize(
    "requested, speed, scene",
    [
        ("deterministic", 0.0, PAPER),
        ("quick", 0.01, FLAT),
        (QuickModel(), 0.0, PAPER),
        (DeterministicModel(), 0.01, FLAT),
    ],
)
def test_the_model_in_place_of_one_that_has_no_answer_is_named(requested, speed, scene):
    """Nothing is entrained, or nothing is rough: the answer is that of the paper's model, and says why."""
    result = lubfric.friction(scene, speed, model=requested)
    assert result.decision.model == "paper"
    name = requested.name if isinstance(requested, Model) else requested
    assert f"the load-sharing model in place of the {name} model: " in result.decision.text
    assert result.coefficient == lubfric.friction(scene, speed, model="paper").coefficient


@pytest.mark.parametrize("requested", ["auto", "highest summit"])
def test_a_speed_that_no_model_answers_is_refused_with_the_reasons(monkeypatch, requested):
    class Unable(HighestSummit):
        def why_unable(self, prepared, speed):
            return "no summit is high enough"

    monkeypatch.setattr(registry, "MODELS", (Unable(),))
    with pytest.raises(lubfric.InputError, match=r"speed = 0.03 m/s .*\(highest summit: no summit is high enough\)"):
        choose(lubfric.prepare(LOOSE), 0.03, requested)


def test_a_map_made_by_lubfric_is_cited_beside_a_given_contact():
    """The contact is the user's own, its map is not; a map that is given is cited by its owner."""
    flat = lubfric.prepare(FLAT)
    of_contact = lubfric.prepare(FLAT, contact=flat.rough_contact)
    of_map = lubfric.prepare(FLAT, flat.surface)
    assert "generated map" in lubfric.friction(of_contact, 0.03, model="paper").methods
    assert "generated map" not in lubfric.friction(of_map, 0.03, model="paper").methods


def test_two_given_maps_are_known_whose_they_are():
    """Both bodies move, each with a map of its own: every model takes them; of one map for both nobody knows."""
    scene = TWO.with_(motion={"slide_roll_ratio": 0.5})
    shape = {"shape": (240, 160), "spacing": 1e-6, "correlation_length": 5e-6}
    surface, counterface = (lubfric.generate_surface(**shape, sq=sq, seed=seed) for sq, seed in ((1e-7, 1), (5e-8, 2)))
    prepared = lubfric.prepare(
        scene, surface.periodic(axes=(False, True)), counterface=counterface.periodic(axes=(False, True))
    )
    assert [model.why_unable(prepared, 0.03) for model in MODELS] == [""] * len(MODELS)
    undivided = lubfric.prepare(scene, surface.periodic(axes=(False, True)))
    assert any("second rough body" in model.why_unable(undivided, 0.03) for model in MODELS)
    contact = contact_on_joined_strips(prepared, prepared.sample, 1)
    with_contact = lubfric.prepare(scene, contact=contact)
    again = lubfric.prepare(scene.with_(bodies={"load": 6.0}), like=with_contact)
    for given in (with_contact, again):
        assert given.is_given and not given.has_given_map and not given.has_one_map_for_all_bodies


def test_a_gap_that_the_given_film_does_not_fill_is_not_without_entrainment():
    scene = PAPER.with_(lubricant={"inlet_film": 20e-9})
    result = lubfric.friction(scene, 0.03, model="paper")
    assert result.film_load == 0 and result.uncertainty.model > 0
    assert "the film in the inlet does not fill the gap" in result.decision.text
    assert "no entrainment" not in result.decision.text + " ".join(result.errors.reasons.values())
    still = lubfric.friction(scene, 0.0, model="paper")
    assert "no entrainment" in still.decision.text and still.uncertainty.model == 0


@pytest.mark.parametrize("slide_roll_ratio, controls", [(2.0, 1), (1.0, 0)])
def test_the_cheapest_model_is_solved_beside_roughness_at_rest_alone(monkeypatch, slide_roll_ratio, controls):
    """What moves has the control of its own summits, so nothing else is solved for it."""
    solves = []

    class Refused(Exception):
        pass

    def solve(self, *args, **kwargs):
        raise Refused

    original = PaperModel.solve
    monkeypatch.setattr(PaperModel, "solve", lambda *args, **kwargs: solves.append(1) or original(*args, **kwargs))
    monkeypatch.setattr(DeterministicModel, "solve", solve)
    with pytest.raises(Refused):
        lubfric.friction(PAPER.with_(motion={"slide_roll_ratio": slide_roll_ratio}), 0.03, model="deterministic")
    assert bool(solves) == bool(controls)


def test_fields_of_other_cells_are_refused():
    fields = lubfric.friction(PAPER, 0.03, model="paper").fields
    with pytest.raises(ValueError, match=r"gap .* is not on the cells"):
        replace(fields, gap=fields.gap[::2])


@pytest.mark.parametrize("model", ["paper", "deterministic"])
def test_fine_fields_are_those_of_one_solve(model):
    """On every cell gap = rigid gap + deflection, up to one constant, and the pressure carries the load."""
    result = lubfric.friction(LOOSE, 0.01, model=model, fields="fine")
    fields = result.fields
    half_width = LOOSE.bodies.half_width
    assert max(fields.spacing) <= 2 * half_width / 20 or max(fields.spacing) == pytest.approx(LOOSE.contact.spacing)
    assert result.heights is fields.heights and result.gap is fields.gap and result.pressure is fields.pressure
    shape = fields.gap + fields.heights - fields.deflection  # of the film or the rigid cylinder, constant along y
    assert np.abs(shape - shape.mean(axis=1, keepdims=True)).max() < 1e-3 * fields.heights.std()
    load = fields.pressure.sum() * fields.spacing[0] / fields.y.size * PAPER.bodies.width
    expected = result.contact_load if model == "paper" else PAPER.bodies.load
    assert load == pytest.approx(expected, rel=0.1)  # upstream of the cells the film carries a few per cent


@pytest.mark.parametrize("model, is_solved_again", [("deterministic", False), ("quick", True)])
def test_the_picture_of_a_patch_is_on_cells_that_show_it_and_no_finer(monkeypatch, model, is_solved_again):
    """Cells of 1 µm, twice the native ones: 49 across the Hertz strip, where 2 µm are 25 and fewer than 40 are too
    few."""
    scene = LOOSE.with_(
        numerics={"sampling": "patch", "model": model, "tolerance": 0.01},
        contact={"shape": (192, 64), "spacing": 0.5e-6},
        surface={"correlation_length": 4e-6},
        bodies={"load": 165.0},
        lubricant={"limiting_stress_coefficient": "f_b"},
    )
    prepared = lubfric.prepare(scene)
    solves = []
    solve_strip = answer.solve_strip

    def counted(*arguments, **named):
        solves.append(named)
        return solve_strip(*arguments, **named)

    monkeypatch.setattr(answer, "solve_strip", counted)
    fine = lubfric.friction(prepared, 0.01, fields="fine")
    assert bool(solves) == is_solved_again
    assert fine.fields.spacing == pytest.approx((1e-6, 1e-6)) and "the patch, on cells of 1 x 1 µm" in fine.fields.solve
    estimate = estimated_work_of_point(scene, prepared.sample, prepared.surface, 0.01)
    assert estimate.fine_fields_seconds > 0  # f might have been found on cells of 2 µm


def test_fields_are_solved_again_or_not_as_requested():
    plain = lubfric.friction(PAPER, 0.01, model="paper")
    fine = lubfric.friction(PAPER, 0.01, model="paper", fields="fine")
    assert fine.coefficient == plain.coefficient and fine.fields.spacing[0] < plain.fields.spacing[0]
    with pytest.raises(lubfric.InputError, match="fields"):
        lubfric.friction(PAPER, 0.01, fields="coarse")


def test_a_map_too_fine_for_its_picture_keeps_its_friction(monkeypatch):
    """A patch on so many cells that no film is solved on them: f and its fields are those of the long cells, with a
    note."""
    scene = LOOSE.with_(
        numerics={"sampling": "patch", "model": "quick"}, contact={"shape": (96, 96), "spacing": 0.5e-6}
    )
    plain = lubfric.friction(scene, 0.01, fields=True)
    monkeypatch.setattr("lubfric.models.deterministic.problem.MOST_GRID_CELLS", plain.pressure.size)
    fine = lubfric.friction(scene, 0.01, fields="fine")
    assert fine.coefficient == plain.coefficient and np.array_equal(fine.pressure, plain.pressure)
    assert any("finer ones were not solved" in note for note in fine.report.notes)


def test_a_contact_with_one_area_says_what_a_changing_strip_needs():
    with pytest.raises(lubfric.InputError, match="Spring has one area A.*define Spring.over_strip"):
        Spring(1e-7, 2e-8, 1.0).over_strip(2e-5, 1e-5)
