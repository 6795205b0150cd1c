"""The files of a run: `RUN_FILES` is the one list of them. The check before a run, what the next run removes, and the
captions of the report follow from it."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain

RESULT = "result.json"
RESOLVED_SCENE = "resolved.toml"
BIBTEX_FILE = "references.bib"  # what the result cites, as BibTeX

# The file of a study folder that says what was solved: with the scene, all that `lubfric study` needs to repeat it.
RESOLVED_STUDY = "resolved_study.toml"
SO_FAR = "so_far"  # folder within that of an unfinished study or curve, for its picture
PICTURES_SO_FAR = ("study", "stribeck", "traction")  # names of that picture
PICTURE_FORMATS = ("png", "pdf", "svg")  # in which 'lubfric plot' draws a picture again


@dataclass(frozen=True, kw_only=True)
class RunFile:
    """A file that `lubfric run` writes, or `lubfric plot` to the folder of a run.

    Attributes
    ----------
    name : of the file; a * is what differs between several of them
    runs : the runs that may write it whatever their options, "stribeck", "traction" or "history"; none: only an option
        or another command makes it
    caption : what the report says below it; "": it is no picture of the report
    shows_answer : whether the report shows it beside the answer, and not at its end
    is_drawn_again : whether 'lubfric plot' draws it in each of the `PICTURE_FORMATS`
    """

    name: str
    runs: tuple[str, ...] = ()
    caption: str = ""
    shows_answer: bool = False
    is_drawn_again: bool = False

    @property
    def patterns(self) -> tuple[str, ...]:
        """The names under which it may be in the folder of a run."""
        if not self.is_drawn_again:
            return (self.name,)
        stem = self.name.rpartition(".")[0]
        return tuple(f"{stem}.{kind}" for kind in PICTURE_FORMATS)


EVERY_RUN = ("stribeck", "traction", "history")
RUN_FILES = (
    RunFile(name="stribeck.csv", runs=("stribeck",)),
    RunFile(
        name="stribeck.png",
        runs=("stribeck",),
        caption="Friction, load ratios and film over the entrainment speed",
        shows_answer=True,
        is_drawn_again=True,
    ),
    RunFile(name="traction.csv", runs=("traction",)),
    RunFile(
        name="traction.png",
        runs=("traction",),
        caption="Friction over the slide-roll ratio",
        shows_answer=True,
        is_drawn_again=True,
    ),
    RunFile(name="history.csv", runs=("history",)),
    RunFile(
        name="history.png",
        runs=("history",),
        caption="Speed, load, film, friction and power loss over time",
        shows_answer=True,
        is_drawn_again=True,
    ),
    RunFile(name="animation.gif"),
    RunFile(
        name="contact.png",
        runs=("stribeck",),
        caption="The contact at one speed. This picture may use other cells than f and the warnings. Its shear stress is "
        "isothermal, f includes heat",
        is_drawn_again=True,
    ),
    RunFile(name="contact_at_*.png", is_drawn_again=True),
    RunFile(name="contact_*.vtk"),
    RunFile(
        name="sharing.png",
        runs=("stribeck",),
        caption="The same contact by the load-sharing model: pressure, and film and surfaces on a section",
    ),
    RunFile(name="surface.png", runs=EVERY_RUN, caption="The rough surface"),
    RunFile(name="law.json", runs=("stribeck",)),
    RunFile(name="law.c", runs=("stribeck",)),
    RunFile(name="fields.npz", runs=EVERY_RUN),
    RunFile(name="report.html", runs=EVERY_RUN),
    RunFile(name=BIBTEX_FILE, runs=EVERY_RUN),
    RunFile(name=RESOLVED_SCENE, runs=EVERY_RUN),
    RunFile(name=RESULT, runs=EVERY_RUN),
)
# Names of the files of all runs, which take each other's place in a folder.
OUTPUTS = tuple(chain.from_iterable(file.patterns for file in RUN_FILES))


def names_of_run(run: str) -> list[str]:
    """Return the names of the files that a ``run``, one of `EVERY_RUN`, may write whatever its options."""
    return [file.name for file in RUN_FILES if run in file.runs]


def captions(names: Iterable[str], *, shows_answer: bool) -> dict[str, str]:
    """Return the captions of those of the pictures ``names`` that the report shows beside its answer, or at its end."""
    present = frozenset(names)
    return {
        file.name: file.caption
        for file in RUN_FILES
        if file.caption and file.shows_answer == shows_answer and file.name in present
    }
