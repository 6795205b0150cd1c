"""Mistakes in the text of `lubfric`, one at a time, each of which its tests have to notice.

The table `mutants.txt` has a mutant a line: ``file | text | what is put there | tests``. The file is named below
`lubfric`, and holds the text once. The tests are files below `tests`, or ``file::test``, with spaces between them.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from ..check import AT_LEAST, AT_MOST, Check

ROOT = Path(__file__).parents[2]
TABLE = Path(__file__).with_suffix(".txt")
LONGEST = 300  # s
PASSED, FAILED = 0, 1  # of pytest


@dataclass(frozen=True)
class Mutant:
    """A line of the table."""

    file: str
    text: str
    wrong: str
    tests: tuple[str, ...]

    @property
    def name(self) -> str:
        """The mistake in a line."""
        return f"{self.file}: {self.text} -> {self.wrong}"

    def broken(self, library: Path) -> str:
        """The text of its file with the mistake. Raises ValueError unless the right text stands there once."""
        whole = (library / self.file).read_text(encoding="utf-8")
        if whole.count(self.text) != 1:
            raise ValueError(f"{self.file} holds {self.text!r} {whole.count(self.text)} times; a mutant needs it once")
        return whole.replace(self.text, self.wrong)


def table(text: str | None = None) -> list[Mutant]:
    """The mutants of ``text`` (None: of `mutants.txt`)."""
    lines = (TABLE.read_text(encoding="utf-8") if text is None else text).splitlines()
    parts = [line.split(" | ") for line in lines if line.strip() and not line.startswith("#")]
    return [Mutant(file, right, wrong, tuple(tests.split())) for file, right, wrong, tests in parts]


def mutants(level: str) -> Iterator[Check]:
    """Mistakes in the text of `lubfric`, one at a time. Each has to make one of its tests fail; a test that cannot even
    be loaded, or does not end, is no catch. The library as it is has to pass all of them."""
    known = table()
    tests = tuple(dict.fromkeys(test for mutant in known for test in mutant.tests))
    yield judged("the library as it is", trial(None, tests), PASSED)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for mutant, code in zip(known, pool.map(lambda m: trial(m, m.tests), known)):
            yield judged(mutant.name, code, FAILED)


def trial(mutant: Mutant | None, tests: tuple[str, ...]) -> int:
    """What pytest returns for ``tests`` on a copy of `lubfric` that has the mistake of ``mutant``."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "lubfric"
        shutil.copytree(ROOT / "lubfric", library)
        if mutant is not None:
            (library / mutant.file).write_text(mutant.broken(library), encoding="utf-8")
        options = ["-x", "-q", "-p", "no:cacheprovider", "--rootdir", str(ROOT), "-c", str(ROOT / "pyproject.toml")]
        command = [sys.executable, "-m", "pytest", *options, *(str(ROOT / "tests" / test) for test in tests)]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join((folder, str(ROOT)))}
        try:
            done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            return -1
        return done.returncode


def judged(name: str, code: int, wanted: int) -> Check:
    """Whether tests ended with the ``code`` that was ``wanted``."""
    refused = "" if code in (PASSED, FAILED) else f"pytest ended with {code}"
    kind = AT_LEAST if wanted else AT_MOST
    return Check(f"{name}: tests fail", float("nan") if refused else code, wanted, 0.0, "tests", kind, refused=refused)
