"""Tests that take minutes, which the default run of pytest leaves out: those marked ``study`` (tests/conftest.py)."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from ..check import AT_MOST, Check
from .mutants import ONE_THREAD, ROOT

MARKED = "study"  # the mark of these tests


def long_tests(level: str, mark: str = MARKED, folder: Path = ROOT / "tests") -> Iterator[Check]:
    """Run the tests in ``folder`` that have the ``mark``; each is a check. They need the checkout with its tests."""
    with tempfile.TemporaryDirectory() as out:
        report = Path(out) / "report.xml"
        options = ["-q", "-p", "no:cacheprovider", "-m", mark, f"--junitxml={report}", f"--basetemp={out}/tests"]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])} | ONE_THREAD
        command = [sys.executable, "-m", "pytest", *options, str(folder)]
        ended = subprocess.run(command, cwd=folder.parent, env=environment, capture_output=True, text=True)
        if not report.is_file():
            raise RuntimeError(f"pytest ended without a report: {ended.stdout[-400:]} {ended.stderr[-400:]}")
        for case in ElementTree.parse(report).iter("testcase"):
            wrong = [part for part in case if part.tag in ("failure", "error")]
            yield Check(
                f"{case.get('classname', '').removeprefix('tests.')}: {case.get('name')}",
                float(bool(wrong)),
                expected=0.0,
                tolerance=0.0,
                source="the test itself",
                kind=AT_MOST,
                note=" ".join(part.get("message", "")[:200] for part in wrong),
                seconds=float(case.get("time", "nan")),
            )
