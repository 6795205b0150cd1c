"""``python -m verification``: a failure must never look like a success, nor cost other results."""

import importlib.metadata
import json
import math
import sys
import types
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

import lubfric
from verification import __main__ as command
from verification import plotting
from verification.campaigns.long_tests import long_tests
from verification.catalogue import STUDIES, Study
from verification.check import ABSOLUTE, AT_LEAST, AT_MOST, KINDS, RELATIVE, Check, Field, ListedDeviation, Table
from verification.fem.convergence import fitted_order
from verification.fem.solvers.report import SolveError


def good(level):
    """One check at the given level.

    A second paragraph with <angle brackets> & an ampersand.
    """
    yield Check("right", 1.0, expected=1.0, tolerance=1e-9, source="arithmetic")
    canvas, ax = plotting.panel(6.4, 4.0)
    ax.plot([0, 1], [0, 1])
    yield plotting.finish("line", canvas, 'a "quoted" caption')
    yield Table("numbers", "caption", ("a", "b"), ((1, np.float64(2.5)), ("x", math.nan)))
    corners = np.array([[0.0, 0], [1, 0], [0, 1]])
    cells = {"triangle": np.array([[0, 1, 2]])}
    yield Field("mesh", "a triangle", points=corners, cells=cells, point_data={"p": np.arange(3.0)})


def wrong(level):
    """A check that fails."""
    return [Check("off by one", 2.0, expected=1.0, tolerance=0.1, source="arithmetic")]


def raises(level):
    """Fails after its first check."""
    yield Check("before", 1.0, expected=1.0, tolerance=0.0, source="arithmetic", kind=ABSOLUTE)
    raise SolveError("the solve <stopped>\nshort")


def leaves(level):
    sys.exit(0)


def empty(level):
    return []


def no_extra(level):
    raise ModuleNotFoundError("No module named 'skfem.helpers'", name="skfem.helpers")


def twice(level):
    yield Check("same", 1.0, expected=1.0, tolerance=1.0, source="arithmetic")
    yield Check("same", 1.0, expected=1.0, tolerance=1.0, source="arithmetic")


def bad_field(level):
    yield Check("right", 1.0, expected=1.0, tolerance=1e-9, source="arithmetic")
    yield Field("mesh", "", points=np.zeros((2, 2)), cells={"triangle": np.array([[0, 1, 2]])})


def interrupted(level):
    yield Check("right", 1.0, expected=1.0, tolerance=1e-9, source="arithmetic")
    raise KeyboardInterrupt


@pytest.fixture
def run(monkeypatch, tmp_path, capsys):
    """Run the command on some of the studies above: (exit code, report.json, report.html, stdout, stderr)."""

    def go(*functions, options=(), levels=("quick", "default", "full")):
        module = types.ModuleType("studies_under_test")
        listed = []
        for function in functions:
            name = function if isinstance(function, str) else function.__name__
            if callable(function):
                setattr(module, name, function)
            listed.append(Study(name, f"studies_under_test:{name}", title=f"study {name}", levels=levels))
        monkeypatch.setitem(sys.modules, "studies_under_test", module)
        monkeypatch.setattr(command, "STUDIES", tuple(listed))
        code = command.main([*options, "--workers", "1", "--out", str(tmp_path)])
        said = capsys.readouterr()
        data = json.loads((tmp_path / "report.json").read_text(), parse_constant=pytest.fail)
        return code, data, (tmp_path / "report.html").read_text(encoding="utf-8"), said.out, said.err

    return go


class Page(HTMLParser):
    """Collects tags, attributes and words, and whether all tags were closed."""

    def __init__(self, text):
        super().__init__()
        self.open = []
        self.seen = []
        self.words = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))
        self.open += [] if tag in ("meta", "link", "img", "br") else [tag]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


def test_all_right_is_exit_code_0_and_a_whole_page(run, tmp_path):
    code, data, html, out, err = run(good)
    assert code == 0 and data["passed"] and data["complete"]
    assert "PASSED: 1 of 1 checks passed" in out and "[1/1] good" in err and "[1/1]" not in out
    page = Page(html)
    assert page.open == []
    tags = dict(page.seen)
    assert "width=device-width" in next(a for _, a in page.seen if a.get("name") == "viewport")["content"]
    assert tags["img"]["src"].startswith("data:image/svg+xml;base64,")
    assert "script" not in tags
    for _, attrs in page.seen:  # nothing is fetched
        for key in ("src", "href"):
            assert attrs.get(key, "data:").startswith(("data:", "#"))
    assert "A second paragraph with <angle brackets> & an ampersand." in page.words
    assert data["studies"][0]["tables"][0]["rows"] == [[1, 2.5], ["x", None]]
    assert (tmp_path / "good_line.svg").read_bytes().startswith(b"<?xml")
    assert (tmp_path / "good_mesh.vtu").is_file()
    assert data["studies"][0]["checks"][0]["seconds"] >= 0


def test_the_page_names_the_version_of_the_code_that_runs(run, monkeypatch):
    def missing(package):
        raise importlib.metadata.PackageNotFoundError(package)

    monkeypatch.setattr(importlib.metadata, "version", missing)
    _, data, html, _, _ = run(good)
    assert data["environment"]["lubfric"] == lubfric.__version__ and f"lubfric {lubfric.__version__}" in html
    assert data["environment"]["numpy"] == "not installed"


def test_a_failing_check_is_exit_code_1(run):
    code, data, html, out, _ = run(good, wrong)
    assert code == 1 and not data["passed"]
    assert "FAILED: 1 of 2 checks passed" in out and "What failed" in html
    assert [s["passed"] for s in data["studies"]] == [True, False]


BAND = ListedDeviation(cause="theirs", reason="their inlet is dry", low=1.9, high=2.1)


@pytest.mark.parametrize(
    ("measured", "code", "verdict", "words"),
    [
        (
            2.0,
            0,
            "PASSED: 1 of 2 checks passed, 0 failed, 1 listed deviation;",
            "their inlet is dry (cause: theirs; listed",
        ),
        (2.2, 1, "FAILED: 1 of 2 checks passed", "outside the band of its listed deviation: their inlet is dry"),
        (math.nan, 1, "FAILED: 1 of 2 checks passed", "outside the band of its listed deviation"),
        (1.0, 0, "PASSED: 2 of 2 checks passed", "remove it from the list"),
    ],
)
def test_a_listed_deviation_is_shown_and_counted_and_fails_outside_its_band(run, measured, code, verdict, words):
    def deviating(level):
        yield Check("film", measured, expected=1.0, tolerance=0.1, source="a book", listed=BAND)

    ended, data, html, out, _ = run(good, deviating)
    assert ended == code and data["passed"] == (code == 0)
    assert verdict in out and words in out and words in " ".join(Page(html).words)
    assert "Listed deviations" in html and ("What failed" in html) == (code == 1)
    (stored,) = data["studies"][1]["checks"]
    again = Check.from_dict(stored)
    assert again.listed == BAND and again.deviates_as_listed == (measured == 2.0) == stored["deviates_as_listed"]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"cause": "nobody"}, "cause = 'nobody'"),
        ({"reason": " "}, "a reason"),
        ({"low": math.nan}, "finite"),
        ({"low": 3}, "low <= high"),
    ],
)
def test_a_deviation_without_cause_reason_or_band_is_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        replace(BAND, **wrong)


@pytest.mark.parametrize(
    ("study", "reason"),
    [
        (raises, "SolveError: the solve <stopped> short"),
        (leaves, "SystemExit: 0"),
        (empty, "without a single check"),
        ("absent", "AttributeError"),
        (no_extra, 'scikit-fem is not installed: pip install "lubfric[verification]"'),
        (twice, "two checks are named 'same'"),
        (bad_field, "name points outside 0..1"),
    ],
)
def test_a_study_that_breaks_costs_no_other_result(run, study, reason):
    code, data, html, out, _ = run(study, good)
    assert code == 1 and not data["passed"] and data["complete"]
    broken, other = data["studies"]
    assert not broken["passed"] and reason in broken["checks"][-1]["note"]
    assert reason in out and Page(html).open == []
    assert other["passed"]


def test_interrupt_leaves_a_report_that_says_it_is_incomplete(run):
    code, data, html, out, _ = run(good, interrupted, wrong)
    assert code == 130 and not data["complete"] and not data["passed"]
    assert [s["name"] for s in data["studies"]] == ["good"]
    assert "UNFINISHED: 1 of 1 checks passed; only 1 of 3 studies finished" in out and "not run" in html


def test_list_and_only(run, capsys, tmp_path):
    _, data, _, _, _ = run(good, wrong, options=["--only", "good"])
    assert data["selected"] == ["good"]
    with pytest.raises(SystemExit) as stop:
        run(good, wrong, options=["--only", "goood"])
    assert stop.value.code == 2
    assert "unknown study 'goood' (did you mean 'good'?)" in capsys.readouterr().err
    with pytest.raises(SystemExit) as stop:
        run(good, options=["--quick", "--only", "good"], levels=("full",))
    assert stop.value.code == 2 and "good (full)" in capsys.readouterr().err


def test_list_names_every_real_study_and_each_can_be_found(capsys):
    from verification.run import load

    assert command.main(["--list"]) == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert listed == [s.name for s in STUDIES] and len(set(listed)) == len(listed)
    assert all(load(study).__doc__ for study in STUDIES)
    with pytest.raises(SystemExit):
        command.main(["chart"])
    assert "did you mean 'charts'" in capsys.readouterr().err


PASSES = {RELATIVE: ((2.19,), (2.21, 1.79, -2.0)), ABSOLUTE: ((2.05,), (2.2,))}
PASSES |= {AT_MOST: ((-50.0,), (2.2,)), AT_LEAST: ((50.0,), (1.8,))}


@pytest.mark.parametrize("kind", KINDS)
def test_what_passes(kind):
    right, wrong = PASSES.get(kind, ((), ()))
    assert all(Check("c", measured, expected=2.0, tolerance=0.1, source="s", kind=kind).passed for measured in right)
    wrong = (*wrong, math.nan, math.inf, -math.inf)
    assert not any(
        Check("c", measured, expected=2.0, tolerance=0.1, source="s", kind=kind).passed for measured in wrong
    )


BAD = [{"kind": "x"}, {"expected": math.nan}, {"expected": 0}, {"tolerance": -1}, {"tolerance": math.inf}]
BAD += [{"source": ""}]


@pytest.mark.parametrize("bad", BAD)
def test_a_check_that_could_not_fail_is_refused(bad):
    with pytest.raises(ValueError, match="check 'c'"):
        Check(**({"name": "c", "measured": 1.0, "expected": 1.0, "tolerance": 0.1, "source": "s"} | bad))


def test_a_fitted_order():
    h = np.array([1, 0.5, 0.25])
    assert math.isclose(fitted_order(h, 3 * h**2.5), 2.5)
    for errors in ([1, 0, 1], [1, math.nan, 1], [1.0]):
        with pytest.raises(ValueError, match="finite values > 0"):
            fitted_order(h[: len(errors)], errors)


def test_each_long_test_is_a_check(tmp_path):
    (tmp_path / "tests").mkdir()
    marked = "import pytest\n" + "".join(
        f"@pytest.mark.long\ndef test_{name}():\n    assert 1 == {value}\n"
        for name, value in (("right", 1), ("wrong", 2))
    )
    (tmp_path / "tests" / "test_a.py").write_text(marked + "def test_short():\n    assert False\n")
    checks = {check.name: check for check in long_tests("full", "long", tmp_path / "tests")}
    assert {name: check.passed for name, check in checks.items()} == {
        "test_a: test_right": True,
        "test_a: test_wrong": False,
    }
    assert "assert 1 == 2" in checks["test_a: test_wrong"].note
