"""The commands of lubfric with odd values of their options, in odd combinations: each ends with an exit code and a
line."""

import contextlib
import io
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

import lubfric
from lubfric.output import main

from .case import HostileCase

# Values that an option may be given by mistake, by a script, or by another program.
VALUES = (
    "", " ", "0", "-1", "1e400", "nan", "inf", "0x10", "1_000", "\u0661\u0662", "1,5", "1;2", ":", "1:2", "1:2:0", "2:1:3",
    "0:1:3", "1:2:100000000", "auto", "None", "true", "[1,2]", "1 m/s", "1 furlong", "1 mm/s,2", "\u200b1", "1\n2",
    "a" * 300, "--help", "-", "..", "/dev/null", "%s", "{}", "0.03", "0.03,0.03", "3 mm/s:3 m/s:3", "50%", "meas.csv",
    "points.csv", "scene.toml", "U [mm/s]", "mu", "bodies.load=3:6",
)  # fmt: skip

# Options with a value, and switches, of each command.
OPTIONS = {
    "run": ("--out", "--fields", "--ratios", "--speeds", "--sampling-tolerance", "--surface", "--counterface"),
    "info": ("--speeds", "--surface", "--counterface"),
    "study": ("--points", "--out", "--workers"),
    "fit": ("--measured", "--speed", "--coefficient", "--ratio", "--deviation", "--parameter", "--starts", "--out"),
    "run-in": ("--passes", "--distance", "--wear-coefficient", "--out", "--surface"),
    "plot": ("--panels", "--x-scale", "--y-scale", "--format", "--width", "--measured", "--speed", "--coefficient"),
    "init": (),
}
SWITCHES = {
    "run": ("--animation", "--accept", "--vtk"),
    "study": ("--explain", "--netcdf"),
    "fit": ("--without-rolling",),
}
FIRST = ("scene.toml", "study.toml", "missing.toml", "", ".", "/dev/null", "binary.toml", "meas.csv", "empty.toml")

# Exit codes that docs/start.md lists.
CODES = (0, 1, 2, 130, 143)


class UncleanEndError(Exception):
    """A command ended with another exit code, or failed without a word."""


def write_inputs(folder: Path) -> None:
    """Write a scene that is solved in no time, a study of it, a table of points, a measured curve, and two broken
    files."""
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": (48, 48), "spacing": 1.1e-6},
        surface={"correlation_length": 4e-6},
        numerics={"model": "paper", "sampling": "patch"},
        motion={"speeds": [0.03]},
    )
    curve = "".join(f"{speed};{0.03 + 0.01 / speed}\n" for speed in (1, 3, 10, 30, 100, 300))
    texts = {
        "scene.toml": scene.to_toml(),
        "study.toml": 'scene = "scene.toml"\nspeeds = [0.03]\n[vary]\nbodies.load = [4.0, 5.0]\n',
        "points.csv": "load [N],speed [m/s]\n4,0.03\n5,0.03\n",
        "meas.csv": f"U [mm/s];mu\n{curve}",
        "empty.toml": "",
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "binary.toml").write_bytes(bytes(range(256)))


def words_of(draw: np.random.Generator) -> list[str]:
    """Return the words of a command."""
    command = str(draw.choice(list(OPTIONS)))
    words = [command, "scene.toml" if draw.random() < 0.6 else str(draw.choice(FIRST))]
    for _ in range(int(draw.integers(4))):
        if OPTIONS[command]:
            option = str(draw.choice(OPTIONS[command]))
            value = VALUES[int(draw.integers(len(VALUES)))]
            words += [f"{option}={value}"] if draw.random() < 0.5 else [option, value]
    if command in SWITCHES and draw.random() < 0.4:
        words.append(str(draw.choice(SWITCHES[command])))
    if command == "fit" and draw.random() < 0.7:
        words += ["--parameter", "bodies.boundary_friction_coefficient=0.05:0.2", "--starts", "0"]
    return words


def cases(draw: np.random.Generator, count: int) -> Iterator[HostileCase]:
    """Yield ``count`` commands."""
    for _ in range(count):
        words = words_of(draw)
        yield HostileCase("command", " ".join(words)[:200], partial(ended, words), may_pass=True)


def ended(words: list[str], folder: Path) -> str:
    """Run the command in ``folder``. Raise `UncleanEndError` where it ends as none should."""
    write_inputs(folder)
    errors = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
        try:
            code = main(words)
        except SystemExit as end:  # of the parser of arguments
            code = end.code if isinstance(end.code, int) else 2
    if code not in CODES or code and not errors.getvalue().strip():
        raise UncleanEndError(f"exit code {code}: {errors.getvalue()[-200:]}")
    return f"exit code {code}"
