"""``python -m verification mutants``: errors in the text of `lubfric`, one at a time, which tests or studies must
detect.

The table `mutants.txt` has one mutant on a line: ``place | text | replacement | detected by``. The place is a file or
folder below `lubfric` that contains the text once. The last field names tests, as files below `tests` or
``file::test``, or studies, at their quick level, separated by blanks.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .. import frame
from ..check import AT_LEAST, AT_MOST, Check, Item
from ..kept import Run

ROOT = Path(__file__).parents[2]
TABLE = Path(__file__).with_suffix(".txt")
LONGEST = 1800  # s: a trial that takes longer is no catch
# as pytest returns them; BROKEN: neither, such as a test that cannot be loaded
PASSED = 0
FAILED = 1
BROKEN = -1
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


def mutants(level: str, run: Run = Run()) -> Iterator[Item]:
    """Try every mutant of the table. Each has to make a test or a check of a study fail, or a study end with an error
    that `lubfric` raises on purpose. A test that cannot be loaded, and any other error, is no catch. The library as it
    is has to pass all of them. A mutant that was tried is not tried again while `lubfric` and its line stay the same."""
    known = table()
    everyone = dict.fromkeys(each for mutant in known for each in mutant.noticed_by)
    untouched = {
        f"the library as it is: {what}": (None, tuple(each for each in everyone if is_test(each) == chosen))
        for what, chosen in (("tests", True), ("studies", False))
    }
    for (_, names), code in run.solved(untouched, tried, "untouched"):
        yield verdict(f"the library as it is: {'tests' if is_test(names[0]) else 'studies'}", code, PASSED)
    cases = {f"{mutant.name} | {' '.join(mutant.noticed_by)}": (mutant, mutant.noticed_by) for mutant in known}
    for (mutant, _), code in run.solved(cases, tried):
        yield verdict(mutant.name, code, FAILED)


def tried(case: tuple[Mutant | None, tuple[str, ...]]) -> int:
    """Return the outcome of a case: a mutant (None: the unchanged library), and the tests or studies."""
    return trial(*case)


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


COMMAND = frame.campaign("mutants", __doc__, [("mutants", "mutants:mutants", "Mistakes in the text of lubfric", {})])
