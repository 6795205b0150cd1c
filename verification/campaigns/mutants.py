"""``python -m verification mutants [--places PLACE ...] [--seconds S] [--file FILE]``: errors in the text of `lubfric`,
one at a time, which tests or studies must detect.

The table `mutants.txt` has one mutant on a line: ``place | text | replacement | detected by``. The place is a file or
folder below `lubfric` that contains the text once. The last field names tests, as files below `tests` or
``file::test``, or studies, at their quick level, separated by blanks.

The table `mutants_tried.csv` keeps what came of each trial: of each mutant, with a fingerprint of the function that it
changes and of what has to detect it (`Mutant.fingerprint`), and of each test or study on the library as it is. A trial
is repeated only when one of these has changed.
"""

import ast
import hashlib
import inspect
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from .. import frame
from ..catalogue import STUDIES
from ..check import AT_LEAST, AT_MOST, Check, Item, Table
from ..kept import Run
from ..run import load
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
# Each worker has one core.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


@dataclass(frozen=True)
class Mutant:
    """A line of the table."""

    place: str
    text: str
    wrong: str
    noticed_by: tuple[str, ...]

    wanted = FAILED

    @property
    def name(self) -> str:
        """The mistake in a line."""
        return f"{self.place}: {self.text} -> {self.wrong}"

    @property
    def cells(self) -> tuple[str, ...]:
        """The first cells of its row in the table of trials."""
        return self.place, self.text, self.wrong, " ".join(self.noticed_by)

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

    def misquoted(self, root: Path = ROOT) -> str:
        """Return what is wrong with the quote, or ""."""
        try:
            self.broken(root / "lubfric")
        except ValueError as error:
            return str(error)
        return ""

    def fingerprint(self, root: Path = ROOT) -> str:
        """Return a hash of the mistake, of the function or top-level statement of `lubfric` that it changes, and of the
        tests and studies that have to detect it."""
        file, content = self.broken(root / "lubfric")
        before = file.read_text(encoding="utf-8")
        line = 1 + before[: _first_difference(before, content)].count("\n")
        parts = [self.text, self.wrong, source_around(before, line) if file.suffix == ".py" else before]
        parts += [source_of(name, root) for name in self.noticed_by]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Control:
    """A test or study on the library as it is, which has to pass."""

    detector: str

    wanted = PASSED

    @property
    def name(self) -> str:
        """What has to pass, in a line."""
        return f"the library as it is: {self.detector}"

    @property
    def noticed_by(self) -> tuple[str, ...]:
        """The test or study."""
        return (self.detector,)

    @property
    def cells(self) -> tuple[str, ...]:
        """The first cells of its row in the table of trials."""
        return "", "", "", self.detector

    def fingerprint(self, root: Path = ROOT) -> str:
        """Return a hash of the test or study: as long as it stays, one trial is enough beside the daily run of the
        tests."""
        return hashlib.sha256(source_of(self.detector, root).encode()).hexdigest()[:16]


def _first_difference(text: str, other: str) -> int:
    return next((i for i, (a, b) in enumerate(zip(text, other)) if a != b), min(len(text), len(other)))


def source_around(text: str, line: int) -> str:
    """Return the source of the innermost function around a ``line``, else of the statement at the top level there."""
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.stmt)]
    around = [node for node in nodes if node.lineno <= line <= (node.end_lineno or node.lineno)]
    functions = [node for node in around if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]
    if functions:
        return structure(functions[-1])
    return structure(around[0]) if around else text


def structure(part: ast.AST) -> str:
    """Return the nodes of a ``part`` of a program as text that is the same in all versions of Python, wherever its
    lines break and whatever its comments say."""

    def nested(value: object) -> object:
        if isinstance(value, ast.AST):
            fields = [nested(each) for name, each in ast.iter_fields(value) if name != "type_params"]
            return (type(value).__name__, *fields)
        return [nested(each) for each in value] if isinstance(value, list) else value

    return repr(nested(part))


def source_of(name: str, root: Path = ROOT) -> str:
    """Return the source of a test, of a file of tests, or of the module of a study."""
    if not is_test(name):
        study = next(each for each in STUDIES if each.name == name)
        return inspect.getsource(inspect.getmodule(load(study)) or load(study))
    path, _, test = name.partition("::")
    text = (root / "tests" / path).read_text(encoding="utf-8")
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    chosen = [structure(node) for node in functions if node.name == test]
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
    """Return the mutants of ``text`` (None: of `mutants.txt`)."""
    lines = (TABLE.read_text(encoding="utf-8") if text is None else text).splitlines()
    parts = [line.split(" | ") for line in lines if line.strip() and not line.startswith("#")]
    return [Mutant(place, right, wrong, tuple(by.split())) for place, right, wrong, by in parts]


def mutants(
    level: str, places: Sequence[str] = (), seconds: float = math.inf, file: Path = TRIED, run: Run = Run()
) -> Iterator[Item]:
    """Judge every mutant of the table whose trial is up to date, after new trials of the others for so many
    ``seconds``.

    Each has to make a test or a check of a study fail, or a study end with an error that `lubfric` raises on purpose. A
    test that cannot be loaded, and any other error, is no catch. The library as it is has to pass the tests and studies
    of each mutant (`Control`). ``places``: those whose place begins so. ``file``: the table of trials, which new ones
    extend.
    """
    chosen = [mutant for mutant in table() if not places or mutant.place.startswith(tuple(places))]
    chosen.sort(key=lambda mutant: not mutant.place.startswith(FIRST))
    wrong = {mutant: mutant.misquoted() for mutant in chosen}
    for mutant, message in wrong.items():
        if message:
            yield verdict(mutant.name, BROKEN, FAILED, message)
    chosen = [mutant for mutant in chosen if not wrong[mutant]]
    prints = {trial: trial.fingerprint() for trial in with_controls(chosen)}
    extend([trial for trial, print_ in prints.items() if print_ not in known(file)], prints, seconds, run.workers, file)
    codes = {trial: known(file)[print_] for trial, print_ in prints.items() if print_ in known(file)}
    for trial, code in codes.items():
        yield verdict(trial.name, code, trial.wanted)
    tried = [codes[mutant] for mutant in chosen if mutant in codes]
    counts = [len(tried), tried.count(FAILED), len(chosen) - len(tried)]
    yield Table("mutants", "Mutants of the table", ("tried", "detected", "not tried"), [[str(n) for n in counts]])


def with_controls(chosen: Sequence[Mutant]) -> dict[Mutant | Control, None]:
    """Return the mutants in order, each after the controls of what has to detect it."""
    trials: dict[Mutant | Control, None] = {}
    for mutant in chosen:
        trials |= dict.fromkeys(Control(name) for name in mutant.noticed_by)
        trials[mutant] = None
    return trials


def known(file: Path) -> dict[str, int]:
    """Return the exit code of each trial in ``file``, by its fingerprint."""
    return {row["fingerprint"]: int(row["code"]) for row in table_file.rows(file)}


def extend(
    trials: Sequence[Mutant | Control], prints: dict[Mutant | Control, str], seconds: float, workers: int, file: Path
) -> None:
    """Append the outcome of each trial to ``file`` as soon as it is known. After so many ``seconds`` the trials that
    still run are stopped, and have no outcome."""
    deadline = time.monotonic() + seconds
    with ThreadPoolExecutor(workers) as pool:
        futures = {pool.submit(tried, trial, deadline): trial for trial in trials}
        for future in as_completed(futures):
            outcome = future.result()
            if outcome is not None:
                trial = futures[future]
                values = (*trial.cells, prints[trial], *outcome)
                table_file.append(file, COLUMNS, dict(zip(COLUMNS, values, strict=True)), DIGITS)


def tried(trial: Mutant | Control, deadline: float) -> tuple[int, float] | None:
    """Return the exit code of a trial, and how long it took [s]; None where the ``deadline`` of the clock came
    first."""
    begun = time.monotonic()
    left = deadline - begun
    if left <= 0:
        return None
    longest = min(left, LONGEST)
    mutant = trial if isinstance(trial, Mutant) else None
    code = outcome_of(mutant, trial.noticed_by, longest)
    taken = time.monotonic() - begun
    if code == BROKEN and taken >= longest and longest < LONGEST:
        return None
    return code, taken


def is_test(name: str) -> bool:
    """Return whether ``name`` is a test, not a study."""
    return ".py" in name


def outcome_of(mutant: Mutant | None, names: tuple[str, ...], longest: float = LONGEST) -> int:
    """Return the outcome of the tests or studies ``names`` on a copy of `lubfric` that has the mistake of ``mutant``;
    `BROKEN` where they take longer than ``longest`` [s]."""
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
            if all("::" in name for name in names):  # one that takes minutes too
                options += ["-m", "study or not study"]
            files = [str(ROOT / "tests" / name) for name in names]
            command = [sys.executable, "-m", "pytest", *options, "-c", str(ROOT / "pyproject.toml"), *files]
        paths = (folder, str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")]))
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)} | ONE_THREAD
        try:
            code = subprocess.run(command, cwd=folder, env=environment, capture_output=True, timeout=longest).returncode
        except subprocess.TimeoutExpired:
            return BROKEN
        if code == FAILED and not is_test(names[0]):
            report = out / "report.json"
            studies = json.loads(report.read_text())["studies"] if report.is_file() else [{"error": "no report"}]
            meant = all(study["error"].startswith(ON_PURPOSE) for study in studies if study["error"])
            return FAILED if meant else BROKEN
        return code if code in (PASSED, FAILED) else BROKEN


def verdict(name: str, code: int, wanted: int, message: str = "it did not come to an end") -> Check:
    """Return the check that the exit ``code`` of a trial is the ``wanted`` one; ``message`` says what has no code."""
    refused = message if code == BROKEN else ""
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
    parser.add_argument("--seconds", type=float, default=math.inf, metavar="S", help="time for new trials")
    parser.add_argument("--file", type=Path, default=TRIED, help="table of trials (default: %(default)s)")


def _own(part: str, options: Namespace) -> Keywords:
    return {"places": options.places, "seconds": options.seconds, "file": options.file}


PARTS: list[tuple[str, str, str, Keywords]] = [
    ("mutants", "mutants:mutants", "Errors put into the text of lubfric", {})
]
COMMAND = frame.campaign("mutants", __doc__, PARTS, add_options=_options, more_keywords=_own)
