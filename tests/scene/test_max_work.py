"""``numerics.max_work``: the counted work of a point has a limit, and ends at the same step everywhere."""

import math
import pickle
import time

import pytest
from small_study import slowness

import lubfric
from lubfric._base import limited_work
from lubfric.errors import ConvergenceError, WorkLimitError
from lubfric.models.load_sharing import PaperModel
from lubfric.models.quick import quick_model

PAPER = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.3, "tolerance": 0.05})
CHEAP = PAPER.with_(numerics={"model": "paper", "tolerance": 0.2, "sampling_tolerance": 0.5})
SPEED = 0.03


def test_a_point_that_would_take_more_work_is_answered_by_load_sharing():
    """The interval holds the answer without a limit; the same limit gives the same bits; enough work changes
    nothing."""
    full = lubfric.friction(PAPER, SPEED)
    short = [lubfric.friction(PAPER.with_(numerics={"max_work": 0.05}), SPEED) for _ in range(2)]
    low, high = short[0].uncertainty.interval
    assert low <= full.coefficient <= high and high - low > 0
    assert (
        short[0].coefficient == short[1].coefficient and short[0].uncertainty.interval == short[1].uncertainty.interval
    )
    assert "max_work = 0.05 s" in short[0].decision.text
    alone = lubfric.friction(PAPER.with_(numerics={"model": "quick"}), SPEED)
    assert short[0].coefficient == alone.coefficient
    enough = lubfric.friction(PAPER.with_(numerics={"max_work": "1 min"}), SPEED)
    assert enough.coefficient == full.coefficient


@pytest.mark.parametrize("call", ["friction", "stribeck", "traction"])
def test_a_model_that_was_chosen_is_refused_with_its_limit(call):
    scene = PAPER.with_(numerics={"max_work": 0.05, "model": "deterministic"})
    before = time.process_time()
    if call == "friction":
        with pytest.raises(WorkLimitError, match="numerics.max_work = 0.05 s; raise it"):
            lubfric.friction(scene, SPEED)
    elif call == "stribeck":
        with pytest.raises(ConvergenceError, match="max_work = 0.05 s"):
            lubfric.stribeck(scene, [SPEED, 0.05])
    else:
        with pytest.raises(ConvergenceError, match="max_work = 0.05 s"):
            lubfric.traction(scene, [0.05, 1.0], speed=SPEED)
    assert (time.process_time() - before) / slowness() < 15


def test_load_sharing_has_the_limit_too():
    with pytest.raises(ConvergenceError, match="max_work"):
        lubfric.friction(PAPER.with_(numerics={"max_work": 0.001, "model": "paper"}), SPEED)


def test_the_error_survives_a_pickle_and_names_the_key():
    error = pickle.loads(pickle.dumps(WorkLimitError(2.5)))
    assert error.limit == 2.5 and "numerics.max_work = 2.5 s" in str(error)
    for wrong in (0, -1, "1 m", float("nan"), True):
        with pytest.raises(lubfric.InputError, match="numerics.max_work"):
            PAPER.with_(numerics={"max_work": wrong})
    written = PAPER.with_(numerics={"max_work": "2 min"}).to_toml()
    assert "max_work = 120" in written


def test_the_limit_is_of_the_thread_that_set_it():
    from concurrent.futures import ThreadPoolExecutor

    limits = [0.05, None, 0.05, None]
    scenes = [PAPER.with_(numerics={"max_work": limit, "model": "deterministic"}) for limit in limits]

    def ended(scene):
        try:
            return lubfric.friction(scene, SPEED).coefficient
        except WorkLimitError:
            return None

    with ThreadPoolExecutor(2) as executor:
        answers = list(executor.map(ended, scenes))
    assert answers[0] is answers[2] is None and answers[1] == answers[3]


def test_parts_on_processes_count_their_work_as_if_done_in_order():
    """Whatever does the parts, the same one passes the limit."""
    from concurrent.futures import ThreadPoolExecutor

    from lubfric._base import count_work, limited_work
    from lubfric._base.jobs import map_parts, parts_on

    def job(part):
        for _ in range(part):
            count_work(1.0)
        if part == 4:
            raise ValueError("four")
        return part

    for parts, limit, expected in (
        ([3, 2, 1], 6.0, [3, 2, 1]),
        ([3, 2, 1], 5.0, WorkLimitError),
        ([9, 1], 5.0, WorkLimitError),
        ([1, 4, 9], 20.0, ValueError),
        ([1, 9, 4], 5.0, WorkLimitError),
    ):
        outcomes = []
        for executor in (None, ThreadPoolExecutor(2)):
            with parts_on(executor), limited_work(limit) as meter:
                try:
                    outcomes.append((map_parts(job, parts), meter.spent))
                except (ValueError, WorkLimitError) as error:
                    outcomes.append((type(error), None))
        assert outcomes[0] == outcomes[1]
        assert outcomes[0][0] == expected


def test_what_answers_after_a_model_gave_up_has_a_limit_as_well(monkeypatch: pytest.MonkeyPatch) -> None:
    """A soft seal in water: neither the deterministic model nor the quick model is solved within the limit. The quick
    model, which solves its strips when it is asked for them, took 130 s more than the limit."""
    monkeypatch.setattr("lubfric.estimate.choice.LEAST_WORK_OF_CHEAPEST", 1.0)
    seal = PAPER.with_(
        bodies={
            "radius": 2e-3,
            "width": 20e-3,
            "load": 20.0,
            "e_prime": 2.1e7,
            "hardness": None,
            "boundary_friction_coefficient": 0.3,
        },
        lubricant={"viscosity": 1e-3, "viscosity_law": "constant", "pressure_viscosity_coefficient": 0.0},
        motion={"entrainment_speed": 0.5, "slide_roll_ratio": 2.0},
        surface={"sq": 0.8e-6, "correlation_length": 20e-6},
        contact={"shape": (160, 48), "spacing": 8e-6},
        numerics={"accept": True, "max_work": 0.5},
    )
    with limited_work(math.inf) as meter:
        result = lubfric.friction(seal)
    assert meter.spent < 4.0
    assert "was not solved" in result.decision.text and "max_work" in result.decision.text
    low, high = result.uncertainty.interval
    assert 0 <= low < result.coefficient < high


def test_what_a_prepared_scene_remembers_is_counted_as_if_it_were_solved_again():
    """So no result depends on the points that were solved before."""
    prepared = lubfric.prepare(CHEAP)
    works, results = [], []
    for _ in range(2):
        with limited_work(math.inf) as meter:
            results.append(solved(prepared).numbers["coefficient"])
        works.append(meter.spent)
    assert works[1] == pytest.approx(works[0], rel=1e-9) and works[0] > 0
    assert results[0] == results[1]


def test_a_point_that_ran_out_of_work_leaves_nothing_to_the_next():
    """The reference point from which a point starts is solved within the limit of that point, and kept for others."""
    with limited_work(math.inf) as meter:
        fresh = solved(lubfric.prepare(CHEAP))
    prepared = lubfric.prepare(CHEAP)
    for _ in range(2):  # the second time what took that work is remembered
        with pytest.raises(WorkLimitError), limited_work(0.1 * meter.spent):
            solved(prepared)
        after = solved(prepared)
        assert after.numbers["coefficient"] == fresh.numbers["coefficient"]
        assert (
            after.numbers["mean_gap"] == fresh.numbers["mean_gap"] and after.errors.numerical == fresh.errors.numerical
        )


def test_the_contact_of_a_prepared_scene_is_counted_before_and_after_a_pickle():
    """The curve of a flat contact is made once, by `lubfric.prepare`: a limit that it exceeds alone ends every
    point."""
    scene = lubfric.load_scene("flat").with_(
        contact={"shape": (64, 64), "spacing": 8e-6},
        surface={"correlation_length": 24e-6},
        numerics={"model": "paper", "tolerance": 0.2},
    )
    with limited_work(math.inf) as of_prepare:
        prepared = lubfric.prepare(scene)
    assert of_prepare.spent == 0.0
    spent = []
    for each in (prepared, pickle.loads(pickle.dumps(prepared)), prepared):
        with limited_work(math.inf) as meter:
            each.sample.contact(scene, 1, None)
        curve = meter.spent
        with limited_work(math.inf) as meter:
            solved(each)
        spent.append(meter.spent)
    assert spent[0] == spent[1] == spent[2] > curve > 0
    limited = lubfric.prepare(scene.with_(numerics={"max_work": 0.9 * curve}))
    for each in (limited, pickle.loads(pickle.dumps(limited))):
        with pytest.raises(WorkLimitError):
            lubfric.friction(each, SPEED)


def solved(prepared):
    sample = prepared.sample
    return PaperModel().solve(prepared, sample, sample.first_strips, SPEED).answer()


def test_a_thick_film_over_asperities_in_contact_takes_no_balance(monkeypatch):
    """Λ 3.4 at 0.4 GPa: load sharing cannot answer, because asperities touch, so that all it takes is the full-load
    film."""

    def strips(*_):
        raise StopIteration

    monkeypatch.setattr(quick_model, "solve_on_long_cells", strips)
    scene = lubfric.load_scene("paper").with_(
        bodies={"hertz_pressure": 4e8},
        motion={"slide_roll_ratio": 0.1, "entrainment_speed": 0.16},
        surface={"correlation_length": 15e-6},
        numerics={"model": "quick"},
    )
    with limited_work(math.inf) as meter, pytest.raises(StopIteration):
        lubfric.friction(scene)
    assert 0 < meter.spent < 0.02  # of a balance on these strips: 0.3
