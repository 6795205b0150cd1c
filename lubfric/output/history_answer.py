"""The answer of a run in time, in sentences."""

import math
from dataclasses import replace

import numpy as np

from ..models.shared import percent_or_less, sentence
from ..quantities import counted
from ..scene import Scene, moment_in_words, why_gap_not_resolved
from ..time import (
    TransientResult,
    counts_in_average,
    has_steady_film,
    in_motion,
    intervals_to_zero,
    rolls,
    run_model_of,
)
from ..units import plain_number, with_interval, worded
from .films_in_words import GAP_OF_TOUCHING, is_gap_of_touching
from .markup import number_or_dash
from .status import wide_by_model


def history_answer(scene: Scene, result: TransientResult, *, complete: bool) -> list[str]:
    """Return the answer of a run of ``scene`` in time in sentences; of one that is not ``complete`` what its outputs
    show."""
    if result.time.size < 2:
        return ["The run has no answer."]
    mean = result.average()
    f = result.coefficient
    peak = largest_friction(result)
    low, high = result.uncertainty.interval[peak]
    first = float(result.time[0])
    last = float(result.time[-1])
    span = worded(last, "s") if first == 0.0 else f"the time from {worded(first, 's')} to {worded(last, 's')}"
    are_the_same = np.array_equal(counts_in_average(result.columns), in_motion(result.columns))
    part = f"{100 * mean.in_motion:.3g} % of {span}"
    when = f"over the {part} in which rolling resistance does not make most of f"
    if are_the_same:
        when = f"over {span}" if mean.in_motion == 1 else f"while the surfaces move ({part})"
    head = "" if complete else "The run has no valid answer. Its outputs so far show: "
    at_floor = f": {GAP_OF_TOUCHING}" if is_gap_of_touching(float(np.nanmin(result.min_film))) else ""
    level = " at 95 %" + (", without the model-form error, which is not known" if result.model_form_unknown else "")
    mean_text = with_interval(mean.coefficient, *mean.interval, level)
    sentences = [sentence(f"{head}the mean friction coefficient {when} is {mean_text}.")]
    if math.isfinite(mean.coefficient_of_losses):
        sentences.append(
            "The mean weighted by load and sliding speed, which gives the losses by sliding, is "
            f"{mean.coefficient_of_losses:.3g}."
        )
    if result.model_form_unknown:
        sentences.append(sentence(f"why the model-form error is not known: {result.model_form_unknown}"))
    range_ = with_interval(float(f[peak]), low, high, level)
    sentences.append(f"The largest f is {range_}, at t = {_moment(result, peak)}.")
    sentences.append(_largest_force(result))
    power = result.power_loss
    if np.isfinite(power).any():
        loss = with_interval(mean.power_loss, *mean.power_loss_interval, unit="W")
        duration = last - first
        (low, high) = mean.power_loss_interval
        taken = with_interval(duration * mean.power_loss, duration * low, duration * high, unit="J")
        sentences.append(
            f"The mean power loss is {loss}, {_largest_power_loss(result)}. Friction takes {taken} in "
            f"{worded(duration, 's')}."
        )
    with_ratio = have_lambda_ratio(scene, result)
    ratio = result.lambda_ratio[with_ratio]
    if ratio.size:
        sq = plain_number(float(np.median(result.full_load_film[with_ratio] / ratio)), "m")
        thinnest = thinnest_full_load_film(scene, result)
        full_load = plain_number(float(result.full_load_film[thinnest]), "m")
        sentences.append(
            f"The full-load film is thinnest at t = {_moment(result, thinnest)}: {full_load}, a lambda ratio of "
            f"{number_or_dash(float(result.lambda_ratio[thinnest]))}. At the outputs in motion, the lambda ratio "
            f"(full-load film thickness in steady motion over {sq}, the Sq of the surface used) lies between "
            f"{number_or_dash(float(ratio.min()))} and "
            f"{number_or_dash(float(ratio.max()))}{_without_lambda_ratio(scene, result)}."
        )
    sentences.append(
        f"The smallest film thickness is {_least_film(result)}{at_floor}."
        if run_model_of(scene).solves_rough_film
        else _thinnest_solved_film(result)
    )
    solved = result.film_to_roughness_ratio[np.isfinite(result.film_to_roughness_ratio)]
    if solved.size:
        sentences.append(
            f"The solved central separation lies between {number_or_dash(float(solved.min()))} and "
            f"{number_or_dash(float(solved.max()))} times Sq."
        )
    if why := _why_to_zero(scene, result):
        sentences.append(why)
    if result.start_in_words:
        sentences.append(result.start_in_words)
    return sentences


def _why_to_zero(scene: Scene, result: TransientResult) -> str:
    """Return at which outputs the interval of f contains 0, by which part of its error, and what narrows it, in
    sentences; "" where it does so nowhere."""
    reached = intervals_to_zero(scene, result)
    if not reached.outputs:
        return ""
    first, last = (_moment(result, index) for index in (reached.outputs[0], reached.outputs[-1]))
    place = f"between t = {first} and {last}" if len(reached.outputs) > 1 else f"t = {first}"
    causes = "; ".join(
        f"{cause} ({counted(count, 'outputs')})" if len(reached.causes) > 1 else cause
        for cause, count in reached.causes
    )
    ways = f" To narrow it, {', or '.join(reached.ways)}." if reached.ways else ""
    return (
        f"At {counted(len(reached.outputs), 'outputs')}, {place}, the interval of f contains 0, so f there is known to "
        f"its order of magnitude at best; the largest part of its error is {causes}.{ways}"
    )


def _moment(result: TransientResult, index: int) -> str:
    """Return the time of an output, and the angle of rotation where it is known, as text."""
    return moment_in_words(float(result.time[index]), float(result.angle_of_rotation[index]))


def _without_lambda_ratio(scene: Scene, result: TransientResult) -> str:
    """Return at how many outputs there is no lambda ratio, because no oil is entrained or no film is steady, as text to
    be appended; "" for none."""
    entrains = rolls(result.columns)
    numbers = {
        "without entrainment": int(np.sum(~entrains)),
        "at a reversal or start, where no film is steady,": int(np.sum(entrains & ~have_lambda_ratio(scene, result))),
    }
    return "".join(
        f"; {counted(number, 'outputs')} {where} {'have' if number > 1 else 'has'} none"
        for where, number in numbers.items()
        if number
    )


def _largest_force(result: TransientResult) -> str:
    """Return the largest friction force of a run in motion, against the sliding, with its interval and its time, in a
    sentence."""
    index = largest_force(result)
    load = float(result.load[index])
    (low, high) = (load * float(end) for end in result.uncertainty.interval[index])
    largest = with_interval(load * float(result.coefficient[index]), low, high, unit="N")
    return f"The largest friction force against the sliding is {largest}, at t = {_moment(result, index)}."


def _largest_power_loss(result: TransientResult) -> str:
    """Return the largest power loss of a run, with its interval where that is known, and its time, as text."""
    columns = result.columns
    index = largest_power_loss(result)
    (low, high) = (float(columns[f"power_loss_{end}"][index]) for end in ("low", "high"))
    largest = with_interval(float(result.power_loss[index]), low, high, unit="W")
    return f"the largest {largest} at t = {_moment(result, index)}"


def _thinnest_solved_film(result: TransientResult) -> str:
    """Return when the film of a run by load sharing is thinnest, and which part of the load it carries then, in a
    sentence."""
    index = thinnest_film(result)
    head = f"The solved film is thinnest at t = {_moment(result, index)}: {_least_film(result)}"
    film = 1.0 - float(result.contact_load[index] / result.load[index])
    if film <= 0.0:
        return f"{head}; asperities carry all of the load there."
    others = ", and asperities carry the rest" if film < 1.0 else ""
    return f"{head}; it carries {percent_or_less(film, 3)} of the load there{others}."


def _least_film(result: TransientResult) -> str:
    """Return the smallest solved film of a run as text."""
    return plain_number(float(np.nanmin(result.min_film)), "m")


def have_lambda_ratio(scene: Scene, result: TransientResult) -> np.ndarray:
    """Return at which outputs a run of ``scene`` has a lambda ratio, (nt,): where its film may be a steady one."""
    is_steady = np.array([has_steady_film(scene, time) for time in result.time.tolist()], bool)
    has_ratio: np.ndarray = np.isfinite(result.lambda_ratio) & rolls(result.columns) & is_steady
    return has_ratio


def history_notes(scene: Scene, result: TransientResult) -> list[str]:
    """Return what a reader of f and of its mean should know: which model answers, and where a steady point may have a
    narrower interval; and why f is negative at some times."""
    notes = [_model_of_run(scene, result)]
    negative = int(np.sum((result.coefficient < 0) & (result.sliding_speed != 0) & in_motion(result.columns)))
    if negative:
        notes.append(
            f"f is the force on surface 2 against its sliding, over the load. It is negative at "
            f"{counted(negative, 'outputs')}, where the rolling resistance of this surface exceeds the friction of "
            "sliding; the power loss includes both surfaces."
        )
    return notes


def _model_of_run(scene: Scene, result: TransientResult) -> str:
    """Return which model answers at all times, as a sentence, and at which outputs a steady point by another one may
    have a narrower interval."""
    answers = f"The {run_model_of(scene).model_in_words} answers at all times."
    wide = wide_by_model(scene, result)
    if not wide.any():
        return answers
    if why := why_gap_not_resolved(replace(scene, transient=None)):
        return f"{answers} No steady point has a narrower interval: {why}."
    cool = wide & ~(np.abs(result.columns["heat_change"]) >= result.uncertainty.model)  # half of the change is an error
    if not cool.any():
        return f"{answers} Heat causes half or more of its model-form error, which no steady point reduces."
    where = "" if np.array_equal(cool, wide) else f", at the {counted(int(cool.sum()), 'outputs')} less changed by heat"
    return (
        f"{answers} For a narrower interval at one time{where}, solve a steady point with its values and "
        "numerics.model = 'deterministic' (a scene without [transient])."
    )


def largest_friction(result: TransientResult) -> int:
    """Return the index of the output in motion with the largest friction coefficient, without its sign."""
    return int(np.nanargmax(np.where(in_motion(result.columns), np.abs(result.coefficient), -1.0)))


def largest_force(result: TransientResult) -> int:
    """Return the index of the output in motion with the largest friction force, without its sign."""
    return int(np.nanargmax(np.where(in_motion(result.columns), np.abs(result.friction_force), -1.0)))


def largest_power_loss(result: TransientResult) -> int:
    """Return the index of the output with the largest power loss, which is known at some."""
    return int(np.nanargmax(result.power_loss))


def thinnest_film(result: TransientResult) -> int:
    """Return the index of the output with the thinnest solved film."""
    return int(np.nanargmin(result.min_film))


def thinnest_full_load_film(scene: Scene, result: TransientResult) -> int:
    """Return the index of the output with the thinnest full-load film, of those that have a lambda ratio, of which
    there are some."""
    return int(np.nanargmin(np.where(have_lambda_ratio(scene, result), result.full_load_film, np.inf)))


def named_outputs(scene: Scene, result: TransientResult) -> set[int]:
    """Return the indices of the outputs that `history_answer` names."""
    named = {largest_friction(result), largest_force(result), thinnest_film(result)}
    if np.isfinite(result.power_loss).any():
        named.add(largest_power_loss(result))
    if have_lambda_ratio(scene, result).any():
        named.add(thinnest_full_load_film(scene, result))
    return named
