"""Command lines that cannot be carried out: each must end with one clear line on stderr and an exit code above 0."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.output import main

from .case import Case
from .scenes import GOOD, changed, mutations, text_of

SPEEDS: tuple[str, ...] = ("x", "1e-3:1:0", "1:1e-3:4", "1e-3:1", "1:2:3:4", "0:1:3", "nan", "inf", "1e-3:1:1e12")
SPEEDS += ("1e-3:1:999999999999",)
SPEEDS += ("1,,2", ",", ":", "1e-3:1:-4", "1e-3:1:2.5", "true", "1e999", "0.1;0.2", "-1:1:3", "1e-3:inf:3", "9" * 5000)
HEAD = "speed [m/s],coefficient [-]\n"
TABLES = ("", "speed [m/s]\n", f"{HEAD}0.1\n", f"{HEAD}0.1,x\n", "\x00\x01", "a,b\n1,2\n", f"{HEAD}0.1,0.1\n")
RECORDS = ("", "{", "[]", "3", "{}", '{"scene": 3}', '{"scene": {"name": 3}}', '{"scene": {}}')


def cases(rng: np.random.Generator, count: int) -> Iterator[Case]:
    """At least ``count`` command lines: those made by hand, then bad scenes given to each command."""
    by_hand = list(_by_hand())
    yield from by_hand
    bad = mutations()
    for _ in range(max(0, count - len(by_hand))):
        section, key, value = bad[int(rng.integers(len(bad)))]
        command = ("run", "info")[int(rng.integers(2))]
        yield _scene_case(command, section, key, value)


def _by_hand() -> Iterator[Case]:
    lines: list[tuple[str, ...]] = [(), ("fly",), ("run",), ("info",), ("plot",), ("run", "nowhere.toml")]
    lines += [("info", "papr"), ("run", "--out"), ("run", "flat", "--nonsense"), ("plot", "nowhere"), ("oils", "x")]
    lines += [
        ("info", "flat", "--surface", "nowhere.npy"),
        ("run", "flat", "--surface", "."),
        ("run", "."),
        ("info", ""),
    ]
    lines += [("run", "a\0b"), ("plot", "a\0b")]
    for line in lines:
        yield _case(" ".join(map(repr, line)), line)
    for option in ("--speeds", "--fields"):
        for speeds in SPEEDS:
            yield _case(f"run good.toml {option} {speeds[:30]}", ("run", "good.toml", f"{option}={speeds}"))
    for out in ("good.toml", "good.toml/out", "/proc/nothing", "/dev/null"):
        yield _case(f"run good.toml --out {out!r}", ("run", "good.toml", "--out", out))
    for table in TABLES:
        yield _plot_case("stribeck.csv", table, '{"scene": {"name": "a"}}')
        yield _plot_case("history.csv", table, '{"scene": {"name": "a"}}')
    for record in RECORDS:
        yield _plot_case("stribeck.csv", f"{HEAD}0.1,0.1\n", record)


def _scene_case(command: str, section: str, key: str, value: str | None) -> Case:
    text = text_of(changed(GOOD, section, key, value))
    return _case(f"{command}: [{section}] {key} = {str(value)[:40]}", (command, "bad.toml"), {"bad.toml": text})


def _plot_case(name: str, table: str, record: str) -> Case:
    files = {name: table, "result.json": record}
    return _case(f"plot of {name} {table[:30]!r} with {record[:30]!r}", ("plot", "."), files)


def _case(name: str, line: tuple[str, ...], files: dict[str, str] | None = None) -> Case:
    def run(folder: Path) -> object:
        for file, text in {"good.toml": text_of(GOOD), **(files or {})}.items():
            (folder / file).write_text(text, encoding="utf-8")
        return carried_out(line, folder)

    return Case("command", f"lubfric {name}", run)


def carried_out(line: tuple[str, ...], folder: Path) -> str:
    """What the command wrote where its exit code is 0; `lubfric.LubfricError` with its last line where it is above.

    An exit code above 0 without a line that begins with "lubfric" or "usage" is no refusal.
    """
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = main(list(line))
        except SystemExit as stopped:
            code = stopped.code if isinstance(stopped.code, int) else 1
    said = [text for text in err.getvalue().splitlines() if text.startswith(("lubfric", "usage"))]
    if code and said and "Traceback" not in err.getvalue():
        raise lubfric.LubfricError(said[-1])
    return f"exit code {code}: {err.getvalue()[-150:]}"
