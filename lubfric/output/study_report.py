"""report.html of a study: status, answer, pictures, a table of its points, what was varied, inputs."""

import time
from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np

from .._base import __version__
from ..models.shared import sentence
from ..quantities import RADII_OF_SURFACES
from ..studies import StudyResult, columns_of_study
from ..units import plain_number
from .best_designs import best_table
from .effects_and_warnings import NO_WARNINGS, effects_table
from .films_in_words import FILMS_AND_GAPS, films_at_limit, note_on_touching
from .markup import folded_notes, picture
from .methods import methods_to_quote, scene_in_words
from .page import framed
from .status import status_of_study, study_in_words
from .study_inputs import common_inputs, range_in_a_line
from .study_points import effects_at
from .study_tables import MOST_ROWS, folded_details, table_of_points
from .study_warnings import counts_of_warnings, notes_without_warning, numbered_warnings, why_no_intervals

CAPTION = "The results of the study"


def study_page(
    result: StudyResult,
    contents: dict[str, bytes],
    answer: list[str],
    known: int = 0,
    given: Mapping[str, Any] | None = None,
) -> bytes:
    """Return the page of a study. ``contents``: pictures by the name of their file; ``answer``: lines of text;
    ``known``: number of points that earlier calls solved; ``given``: tables of the scene as the user wrote them."""
    import scipy

    warnings = numbered_warnings(result)
    notes = notes_without_warning(result)
    rows = min(MOST_ROWS, result.status.size)
    size = result.status.size
    about = (
        "no. is the row of study.csv, which has all numbers."
        if rows == size
        else f"About {rows} of {size} points, evenly spread, and those of the answer. No. is the row of study.csv, "
        "which has all."
    )
    about += (
        " The last column of this table has the numbers of the warnings above."
        if any(each.numbers for each in warnings)
        else ""
    )
    at_limit = films_at_limit(columns_of_study(result))
    touching = note_on_touching(np.ravel(result["min_film"]))
    about += f" {at_limit}" if at_limit else ""
    about += why_no_intervals(result)
    about += f" {touching}" if touching else ""
    about += f" {FILMS_AND_GAPS}"
    return framed(
        "study_report.html",
        "study of a lubricated line contact",
        f"{time.strftime('%Y-%m-%d %H:%M:%S UTC', time.gmtime())}, lubfric {__version__}",
        dict(
            name=escape(result.plan.scene.name),
            version=__version__,
            numpy=np.__version__,
            scipy=scipy.__version__,
            times=escape(times_in_words(result, known)),
            kind=status_of_study(result).kind(failed=result.failed > 0),
            status=escape(study_in_words(result)),
            answer="".join(
                f'<p class="{"answer" if i == 0 else ""}">{escape(line)}</p>' for i, line in enumerate(answer)
            ),
            pictures="".join(picture(content, CAPTION) for name, content in contents.items() if name.endswith(".png")),
            warnings=_counts_as_paragraph(result)
            + (_list([each.text for each in warnings], kind="ol") if warnings else f"<p>{NO_WARNINGS}</p>")
            + folded_notes(_list(notes), len(notes)),
            best=best_table(result),
            about=about,
            table=table_of_points(result, rows, warnings) + folded_details(result, rows) + _effects_table(result),
            varied=_list([range_in_a_line(key, values) for key, (_, values) in result.coords.items()]),
            inputs=common_inputs(result, given),
            sources=methods_to_quote(_common_facts(result), result) + _list(result.cite().splitlines()),
        ),
    )


def times_in_words(result: StudyResult, known: int) -> str:
    """Return the time that the points of a study took in a sentence, and how many of them were ``known``, from earlier
    calls, in another; identical ones count once."""
    text = f"Wall-clock time of all points together, each as it was solved: {plain_number(result.total_seconds, 's')}."
    return f"{text} Points that earlier calls solved: {known}." if known else text


def _common_facts(result: StudyResult) -> list[str]:
    """Return contact and oil in a line; none where the study varies one of their inputs."""
    varied = {key.partition(".")[0] for key in result.coords}
    return [] if varied & {"bodies", "lubricant", *RADII_OF_SURFACES} else [scene_in_words(result.plan.scene)]


def _counts_as_paragraph(result: StudyResult) -> str:
    """Return how many points have warnings and notes, as a paragraph; "" where there are none."""
    counts = counts_of_warnings(result)
    return f"<p>{escape(sentence(counts))}</p>" if counts else ""


def _effects_table(result: StudyResult) -> str:
    """Return the table of the effects that are not modelled, where |f| is largest; "" where no f is known."""
    if not np.isfinite(result["coefficient"]).any():
        return ""
    row = int(np.nanargmax(np.abs(columns_of_study(result)["coefficient"])))
    (effects,) = effects_at(result, [row])
    place = f"at point {row + 1}"
    which = " (largest f)"
    return f"<h3>Effects not modelled, {place}{which}</h3>{effects_table(effects, place, which)}"


def _list(lines: list[str], kind: str = "ul") -> str:
    """Return ``lines`` as a list, without numbers ("ul") or with them ("ol")."""
    return f"<{kind}>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</{kind}>"
