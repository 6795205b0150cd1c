"""``python -m verification mutants [--places PLACE ...] [--budget S]``: errors in the text of `lubfric`, one at a time,
which tests or studies must detect.

The table `mutants.txt` has one mutant on a line: ``place | text | replacement | detected by``. The place is a file or
folder below `lubfric` that contains the text once. The last field names tests, as files below `tests` or
``file::test``, or studies, at their quick level, separated by blanks.

The table `mutants_tried.csv` keeps what came of each mutant, with a fingerprint of the function that it changes and of
what has to detect it (`Mutant.fingerprint`). A mutant is tried again only when one of these has changed.
"""

import ast
import hashlib
import inspect
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from .. import frame
from ..catalogue import STUDIES
from ..check import AT_LEAST, AT_MOST, Check, Item, Table
from ..kept import Run
from ..run import load, mapped
from ..types import Keywords
from . import table_file

ROOT = Path(__file__).parents[2]
TABLE = Path(__file__).with_suffix(".txt")
TRIED = Path(__file__).with_name("mutants_tried.csv")
COLUMNS = ("place", "text", "replacement", "detected by", "fingerprint", "code", "seconds")
DIGITS = 4  # of the seconds
# Places below `lubfric` whose mutants are tried first: the newest code has the fewest.
FIRST = ("models/deterministic", "models/quick", "estimate")
LONGEST = 1800  # s: a trial that takes longer is no catch
PASSED = 0  # as pytest returns it where all tests pass
FAILED = 1  # as pytest returns it where a test fails
BROKEN = -1  # neither, such as a test that cannot be loaded
ON_PURPOSE = "lubfric.errors."


@dataclass(frozen=True)
class Mutant:
    """A line of the table."""

    place: str
    text: str
    wrong: str
    noticed_by: tuple[str, ...]

    @property
    def name(self) -> str:
        """The mistake in a line."""
        return f"{self.place}: {self.text} -> {self.wrong}"

    def broken(self, library: Path) -> tuple[Path, str]:
        """Return the file that holds the text, and its content with the mistake.

        Raises ValueError unless the text occurs there once."""
        place = library / self.place
        files = [place] if place.is_file() else sorted(place.rglob("*.py"))
        contents = {file: file.read_text(encoding="utf-8") for file in files}
        pattern = pattern_of(self.text)
        matches = [(file, match) for file, content in contents.items() for match in pattern.finditer(content)]
        if len(matches) != 1:
            raise ValueError(f"{self.place} holds {self.text!r} {len(matches)} times; a mutant needs it once")
        ((file, match),) = matches
        content = contents[file]
        return file, content[: match.start()] + self.wrong + content[match.end() :]

    def fingerprint(self, root: Path = ROOT) -> str:
        """Return a hash of the mistake, of the function or top-level statement of `lubfric` that it changes, and of the
        tests and studies that have to detect it."""
        file, content = self.broken(root / "lubfric")
        before = file.read_text(encoding="utf-8")
        line = 1 + before[: _first_difference(before, content)].count("\n")
        parts = [self.text, self.wrong, source_around(before, line) if file.suffix == ".py" else before]
        parts += [source_of(name, root) for name in self.noticed_by]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def _first_difference(text: str, other: str) -> int:
    return next((i for i, (a, b) in enumerate(zip(text, other)) if a != b), min(len(text), len(other)))


def source_around(text: str, line: int) -> str:
    """Return the source of the innermost function around a ``line``, else of the statement at the top level there."""
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.stmt)]
    around = [node for node in nodes if node.lineno <= line <= (node.end_lineno or node.lineno)]
    functions = [node for node in around if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]
    chosen = functions[-1] if functions else around[0] if around else None
    return text if chosen is None else ast.unparse(chosen)


def source_of(name: str, root: Path = ROOT) -> str:
    """Return the source of a test, of a file of tests, or of the module of a study."""
    if not is_test(name):
        study = next(each for each in STUDIES if each.name == name)
        return inspect.getsource(inspect.getmodule(load(study)) or load(study))
    path, _, test = name.partition("::")
    text = (root / "tests" / path).read_text(encoding="utf-8")
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    chosen = [ast.unparse(node) for node in functions if node.name == test]
    return chosen[0] if chosen else text


def pattern_of(text: str) -> re.Pattern[str]:
    """Return the pattern of a quoted ``text`` with any line breaks.

    Between two words there is white space, elsewhere any or none; a comma may precede a closing bracket."""
    tokens = re.findall(r"\w+|[^\w\s]", text)
    pattern = re.escape(tokens[0])
    for before, token in zip(tokens, tokens[1:]):
        blank = r"\s+" if before[-1].isalnum() and token[0].isalnum() else r"\s*"
        comma = r"(?:,\s*)?" if token in ")]}" and before not in "([{," else ""
        pattern += blank + comma + re.escape(token)
    return re.compile(pattern)


def table(text: str | None = None) -> list[Mutant]:
    """The mutants of ``text`` (None: of `mutants.txt`)."""
    lines = (TABLE.read_text(encoding="utf-8") if text is None else text).splitlines()
    parts = [line.split(" | ") for line in lines if line.strip() and not line.startswith("#")]
    return [Mutant(place, right, wrong, tuple(by.split())) for place, right, wrong, by in parts]


def mutants(level: str, places: Sequence[str] = (), budget: float = float("inf"), run: Run = Run()) -> Iterator[Item]:
    """Judge every mutant of the table whose trial is up to date, after new trials of the others within the ``budget``
    of time [s].

    Each has to make a test or a check of a study fail, or a study end with an error that `lubfric` raises on purpose. A
    test that cannot be loaded, and any other error, is no catch. The library as it is has to pass the tests and studies
    of all mutants that are tried now. ``places``: those whose place begins so.
    """
    chosen = [mutant for mutant in table() if not places or mutant.place.startswith(tuple(places))]
    chosen.sort(key=lambda mutant: not mutant.place.startswith(FIRST))
    prints = {mutant: mutant.fingerprint() for mutant in chosen}
    known = {row["fingerprint"]: int(row["code"]) for row in table_file.rows(TRIED)}
    missing = [mutant for mutant in chosen if prints[mutant] not in known]
    used: dict[str, None] = {}
    begun = time.perf_counter()
    with mapped(run.workers) as each:
        while missing and time.perf_counter() - begun < budget:
            now, missing = missing[: run.workers], missing[run.workers :]
            for mutant, (code, seconds) in zip(now, each(tried, now)):
                values = (mutant.place, mutant.text, mutant.wrong, " ".join(mutant.noticed_by), prints[mutant])
                row = dict(zip(COLUMNS, (*values, code, seconds)))
                table_file.append(TRIED, COLUMNS, row, DIGITS)
                known[prints[mutant]] = code
                used |= dict.fromkeys(mutant.noticed_by)
    for name, code in run.solved({name: name for name in used}, passes, "untouched"):
        yield verdict(f"the library as it is: {name}", code, PASSED)
    for mutant in chosen:
        if prints[mutant] in known:
            yield verdict(mutant.name, known[prints[mutant]], FAILED)
    counts = [len(chosen) - len(missing), sum(known.get(each) == FAILED for each in prints.values()), len(missing)]
    yield Table("mutants", "Mutants of the table", ("tried", "detected", "not tried"), [[str(n) for n in counts]])


def passes(name: str) -> int:
    """Return the outcome of a test or study on the unchanged library."""
    return trial(None, (name,))


def tried(mutant: Mutant) -> tuple[int, float]:
    """Return the outcome of a mutant, and how long its trial took [s]."""
    begun = time.perf_counter()
    code = trial(mutant, mutant.noticed_by)
    return code, time.perf_counter() - begun


def is_test(name: str) -> bool:
    """Whether ``name`` is a test, not a study."""
    return ".py" in name


def trial(mutant: Mutant | None, names: tuple[str, ...]) -> int:
    """What came of the tests or studies ``names`` on a copy of `lubfric` that has the mistake of ``mutant``."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "lubfric"
        out = Path(folder) / "out"
        shutil.copytree(ROOT / "lubfric", library)
        if mutant is not None:
            file, content = mutant.broken(library)
            file.write_text(content, encoding="utf-8")
        command = [
            sys.executable,
            "-m",
            "verification",
            "--quick",
            "--workers",
            "1",
            "--out",
            str(out),
            "--only",
            *names,
        ]
        if is_test(names[0]):
            options = ["-x", "-q", "-p", "no:cacheprovider", f"--basetemp={out}", f"--rootdir={ROOT}"]
            files = [str(ROOT / "tests" / name) for name in names]
            command = [sys.executable, "-m", "pytest", *options, "-c", str(ROOT / "pyproject.toml"), *files]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join((folder, str(ROOT)))}
        try:
            code = subprocess.run(command, cwd=folder, env=environment, capture_output=True, timeout=LONGEST).returncode
        except subprocess.TimeoutExpired:
            return BROKEN
        if code == FAILED and not is_test(names[0]):
            report = out / "report.json"
            studies = json.loads(report.read_text())["studies"] if report.is_file() else [{"error": "no report"}]
            meant = all(study["error"].startswith(ON_PURPOSE) for study in studies if study["error"])
            return FAILED if meant else BROKEN
        return code if code in (PASSED, FAILED) else BROKEN


def verdict(name: str, code: int, wanted: int) -> Check:
    """Return the check that the exit ``code`` of a trial is the ``wanted`` one."""
    refused = "it did not come to an end" if code == BROKEN else ""
    kind = AT_LEAST if wanted == FAILED else AT_MOST
    value = float("nan") if refused else code
    return Check(
        f"{name}: something fails",
        value,
        expected=wanted,
        tolerance=0.0,
        source="tests and studies",
        kind=kind,
        refused=refused,
    )


def _options(parser: ArgumentParser) -> None:
    parser.add_argument("--places", nargs="+", default=[], metavar="PLACE", help="mutants whose place begins so")
    parser.add_argument("--budget", type=float, default=float("inf"), metavar="S", help="time for new trials")


def _own(part: str, options: Namespace) -> Keywords:
    return {"places": options.places, "budget": options.budget}


PARTS: list[tuple[str, str, str, Keywords]] = [("mutants", "mutants:mutants", "Mistakes in the text of lubfric", {})]
COMMAND = frame.campaign("mutants", __doc__, PARTS, add_options=_options, more_keywords=_own)
