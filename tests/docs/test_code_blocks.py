"""Every code block of the pages runs, as it stands, in the order of its page.

Python blocks of a page share one namespace, and a folder of their own. Command lines are run as a shell would run them,
but in this process; installing and testing is what the CI does, and is only looked at here.
"""

import re
import shlex
import shutil
import tomllib

import matplotlib.pyplot
import pytest
from pages import PAGES, ROOT, blocks, files

import lubfric
from lubfric.output import main, parser
from verification.__main__ import main as verification

PYTHON = [page for page in PAGES if any(b.language == "python" for b in blocks(page))]
SHELL = [page for page in PAGES if any(b.language == "sh" for b in blocks(page))]
LONG = {"start.md", "studies.md", "transient.md", "deterministic.md"}  # more than a second or two
RIG = "U [mm/s];mu\n1;0.118\n3;0.114\n10;0.094\n30;0.055\n100;0.032\n300;0.052\n"  # what a rig may have measured
LANGUAGES = ("python", "sh", "toml", "text")
LEFT_TO_THE_CI = ("python3 -m venv", "pip install", "git clone", "-m pytest", "bash .ci/run", "sphinx-build", "apt-get")


def written(page, folder):
    """The files that the page wants there, and what a rig may have measured."""
    for name, text in {"rig.csv": RIG, **files(page)}.items():
        (folder / name).write_text(text, encoding="utf-8")


def cases(pages):
    return [pytest.param(p, id=p.name, marks=[pytest.mark.slow] * (p.name in LONG)) for p in pages]


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_every_block_says_what_it_is(page):
    """A block without a language would be run by nobody."""
    for block in blocks(page):
        assert block.language.startswith("{") or block.language in LANGUAGES, f"{page.name}:{block.line}"


@pytest.mark.parametrize("page", PYTHON, ids=lambda p: p.name)
def test_python_blocks_are_python(page):
    """Also where running them takes long."""
    for block in blocks(page):
        if block.language == "python":
            compile("\n" * block.line + block.body, str(page), "exec")


@pytest.mark.parametrize("page", cases(PYTHON))
def test_python_blocks_run(page, tmp_path, monkeypatch, load_sharing):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("Agg")
    written(page, tmp_path)
    namespace = {"__name__": "__main__"}
    for block in blocks(page):
        if block.language == "python":
            exec(compile("\n" * block.line + block.body, str(page), "exec"), namespace)
    matplotlib.pyplot.close("all")


def command_lines(page):
    """The command lines of a page as lists of words, comments taken off."""
    for block in blocks(page):
        for line in block.body.replace("\\\n", " ").splitlines() if block.language == "sh" else ():
            words = shlex.split(line, comments=True)
            if words and not any(known in line for known in LEFT_TO_THE_CI):
                yield words


def is_for(words, program) -> bool:
    return words[0].removeprefix(".venv/bin/") == program


@pytest.mark.parametrize("page", SHELL, ids=lambda p: p.name)
def test_command_lines_are_understood(page):
    for words in command_lines(page):
        if is_for(words, "lubfric"):
            parser().parse_args(words[1:])
        elif is_for(words, "python"):
            assert words[1:3] == ["-m", "verification"], words
            assert verification([*words[3:], "--list"]) == 0
        else:
            assert is_for(words, "cp") or is_for(words, "mpiexec"), words


def quoted_outputs(page):
    """The console output that the page quotes: text blocks that begin with a result, on one line each."""
    return [" ".join(b.body.split()) for b in blocks(page) if b.language == "text" and b.body.startswith("f = ")]


def printed(capture) -> str:
    """What the commands printed so far, on one line, without wall-clock times."""
    return re.sub(r" \(wall-clock time [^)]*\)", "", " ".join("".join(capture.readouterr()).split()))


@pytest.mark.slow
@pytest.mark.parametrize("page", SHELL, ids=lambda p: p.name)
def test_lubfric_command_lines_run(page, tmp_path, monkeypatch, capfd):
    """In one folder with the checkout's scenes and examples, one after the other, as the page tells them."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ROOT / "docs" / "examples", tmp_path / "docs" / "examples")
    written(page, tmp_path)
    for words in command_lines(page):
        if is_for(words, "lubfric"):
            assert main(words[1:]) == 0, words
    output = printed(capfd)
    for quoted in quoted_outputs(page):
        assert quoted in output, f"{page.name} quotes what no command prints: {quoted}"


QUOTED = re.compile(r"f = ([\d.]+) \(([\d.]+) to ([\d.]+) at 95 %\)")


def test_the_numbers_of_the_first_page_are_those_of_today(tmp_path):
    """The quick model of job 1, which the page quotes, is solved; the deterministic one, of a minute, is compared with
    it, and solved by `test_lubfric_command_lines_run`."""
    page = ROOT / "docs" / "start.md"
    text = page.read_text(encoding="utf-8")
    (block,) = quoted_outputs(page)
    by_default, quick = (tuple(map(float, m.groups())) for m in QUOTED.finditer(text.replace("\n", " ")))
    assert block.startswith(f"f = {by_default[0]:g} ({by_default[1]:g} to {by_default[2]:g} at 95 %)")
    assert f"between {by_default[1]:g} and {by_default[2]:g} with 95 % confidence" in text.replace("\n", " ")
    (tmp_path / "bearing.toml").write_text(files(page)["bearing.toml"], encoding="utf-8")
    scene = lubfric.load_scene(tmp_path / "bearing.toml").with_(numerics={"model": "quick"})
    point = lubfric.friction(scene)
    assert f"at {scene.motion.entrainment_speed:g} m/s" in text.partition("model-form error:")[2][:60]
    assert quick[0] == pytest.approx(point.coefficient, rel=0.03)
    assert quick[1:] == pytest.approx(point.uncertainty.interval, rel=0.1)
    below, above = point.uncertainty.model_sides
    assert point.coefficient * (1 - below) < by_default[0] < point.coefficient * (1 + above)


def test_the_first_page_leads_to_a_curve_of_ones_own(tmp_path, monkeypatch):
    """`lubfric init`, the oil and the map of the page put in by hand: f with an interval."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs" / "start.md"
    oil, surface = (tomllib.loads(b.body) for b in blocks(page) if b.language == "text" and b.body.startswith("["))
    exec(next(b.body for b in blocks(page) if "savetxt" in b.body), {"lubfric": lubfric})
    assert main(["init", "my_contact.toml"]) == 0
    written = tomllib.loads((tmp_path / "my_contact.toml").read_text(encoding="utf-8"))
    scene = lubfric.load_scene({**written, **oil, **surface, "contact": {}, "numerics": {"model": "paper"}})
    point = lubfric.friction(scene, 0.1)
    low, high = point.uncertainty.interval
    assert 0 < low < point.coefficient < high < 0.2
    assert scene.lubricant.oil is not None and point.uncertainty.area_needed >= 1


@pytest.mark.parametrize("page", [p for p in PAGES if "```toml" in p.read_text()], ids=lambda p: p.name)
def test_files_of_the_pages_are_read(page, tmp_path):
    """A TOML block is a whole scene or a whole study."""
    from lubfric.studies import load_study

    for block in blocks(page):
        if block.language == "toml":
            path = tmp_path / "file.toml"
            path.write_text(block.body, encoding="utf-8")
            read = tomllib.loads(block.body)
            assert load_study(path).points if "scene" in read else lubfric.load_scene(path).bodies.load > 0
