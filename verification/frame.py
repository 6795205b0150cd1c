"""The frame of every command: its options, the run of its studies, page and files, the exit code.

A command is a list of studies and little else (`Command`). Its studies hand over checks, tables, figures and fields
(`check`). The run fails when a check that decides fails. The studies of a `campaign` solve many cases, which are kept
in the folder of the report (`kept.Run`).
"""

import argparse
import difflib
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import partial
from pathlib import Path

from . import kept
from . import report as reports
from .catalogue import Study
from .check import Check
from .run import Outcome, run
from .types import Keywords

LEVELS = ("default", "quick", "full")


@dataclass(frozen=True)
class Command:
    """What makes one command different from the others.

    name : "" for the plain command; summary : for ``--help``
    studies : what there is to run; out : default folder of its files
    levels : those it offers, the default one first
    workers : processes it starts unasked: for its studies, or those of a campaign for the cases of a part
    add_options : adds its own options to the parser
    more_keywords : of a study of this name, from the parsed options
    finished : writes what else belongs to the report, and returns text for the terminal
    campaign : its studies are given a `kept.Run`, and its tables are put where the pages of ``--docs`` name them
    """

    name: str
    summary: str
    _: KW_ONLY
    studies: tuple[Study, ...]
    out: str
    levels: tuple[str, ...] = LEVELS
    workers: int = 1
    add_options: Callable[[argparse.ArgumentParser], None] = lambda parser: None
    more_keywords: Callable[[str, argparse.Namespace], Keywords] = lambda name, options: {}
    finished: Callable[[reports.Report, argparse.Namespace], str] = lambda report, options: ""
    campaign: bool = False

    @property
    def program(self) -> str:
        """Return the command as the user types it."""
        return f"python -m verification {self.name}".strip()


def main(command: Command, argv: list[str]) -> int:
    """Run a command and return its exit code.

    0: no check failed. 1: a check failed, or a study raised. 2: the command makes no sense. 130: stopped from the
    keyboard; the report then holds the studies that had finished.
    """
    p = parser(command)
    options = p.parse_args(argv)
    studies = choose(command, p, options)
    if options.list:
        print("\n".join(f"{s.name:<16} {s.title} [{', '.join(s.levels)}]" for s in studies))
        return 0
    return run_all(command, tuple(_prepared(command, s, options) for s in studies), options)


def campaign(
    name: str,
    summary: str,
    parts: Sequence[tuple[str, str, str, Keywords]],
    levels: tuple[str, ...] = LEVELS,
    add_options: Callable[[argparse.ArgumentParser], None] = lambda parser: None,
    more_keywords: Callable[[str, argparse.Namespace], Keywords] = lambda part, options: {},
) -> Command:
    """Return a command whose ``parts`` are (name, "module:function" in `verification.campaigns`, title, keywords).

    Each is ``function(level, run=..., **keywords)`` with a `kept.Run`, and yields what a study does.
    ``more_keywords(name, options)`` are those that the parsed options give a part.
    """
    studies = tuple(
        Study(part, f"verification.campaigns.{target}", title=title, levels=levels, options=keys)
        for part, target, title, keys in parts
    )
    folder = f"out/{name}"
    return Command(
        name,
        summary,
        studies=studies,
        out=folder,
        levels=levels,
        add_options=add_options,
        more_keywords=more_keywords,
        campaign=True,
    )


def _prepared(command: Command, study: Study, options: argparse.Namespace) -> Study:
    """Return the study as the options want it. Those of a campaign keep their rows in one folder for each level."""
    if not command.campaign:
        return study
    run = kept.Run(options.out / f"kept-{options.level}", options.workers, study.name)
    return replace(study, options=study.options | command.more_keywords(study.name, options) | {"run": run})


def parser(command: Command) -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    p = argparse.ArgumentParser(command.program, description=command.summary)
    if len(command.levels) > 1:
        level = p.add_mutually_exclusive_group()
        for name, words in (("quick", "few cases on coarse grids"), ("full", "all cases, on the finest grids")):
            if name in command.levels:
                level.add_argument(f"--{name}", dest="level", action="store_const", const=name, help=words)
    p.add_argument("--only", nargs="+", metavar="NAME", help="run only these studies (--list has the names)")
    p.add_argument(
        "--out",
        type=Path,
        default=Path(command.out),
        metavar="DIR",
        help="folder for the report (default: %(default)s)",
    )
    p.add_argument("--list", action="store_true", help="list the studies and stop")
    p.add_argument("--workers", type=int, default=command.workers, help="number of processes (default: %(default)s)")
    if command.campaign:
        p.add_argument(
            "--docs", type=Path, metavar="DIR", help="write tables and pictures into the pages in this folder"
        )
    command.add_options(p)
    p.set_defaults(level=command.levels[0])
    return p


def choose(command: Command, p: argparse.ArgumentParser, options: argparse.Namespace) -> tuple[Study, ...]:
    """Return the selected studies, in the order of the list; an unknown name ends the program with code 2."""
    names = [s.name for s in command.studies]
    for name in options.only or ():
        if name not in names:
            p.error(f"unknown study {name!r}{did_you_mean(name, names)}; known: {', '.join(names)}")
    chosen = [s for s in command.studies if not options.only or s.name in options.only]
    if options.list:
        return tuple(chosen)
    offered = tuple(s for s in chosen if options.level in s.levels)
    missing = [f"{s.name} ({', '.join(s.levels)})" for s in chosen if s not in offered]
    if missing and options.only:
        p.error(f"not offered at level {options.level!r}: {'; '.join(missing)}")
    for name in missing:
        print(f"not part of level {options.level!r}: {name}", file=sys.stderr)
    return offered


def did_you_mean(word: str, options: dict[str, str] | list[str]) -> str:
    """Return ' (did you mean ...?)' or an empty string."""
    matches = difflib.get_close_matches(word, list(options), n=1, cutoff=0.4)
    return f" (did you mean {matches[0]!r}?)" if matches else ""


def run_all(command: Command, studies: tuple[Study, ...], options: argparse.Namespace) -> int:
    """Run the studies. The report is written after every one, so that a killed process loses only the one at work."""
    out = options.out
    level = options.level
    out.mkdir(parents=True, exist_ok=True)
    begun = time.perf_counter()
    now = time.strftime("%Y-%m-%d %H:%M:%S %z")
    so_far = reports.Report(
        level=level,
        selected=tuple(s.name for s in studies),
        outcomes=(),
        complete=False,
        started=now,
        seconds=0.0,
        environment=environment(),
    )

    def save(report: reports.Report) -> reports.Report:
        report = replace(report, seconds=time.perf_counter() - begun)
        reports.save(report, out)
        return report

    so_far = save(so_far)
    interrupted = False
    workers = 1 if command.campaign else options.workers
    try:
        for outcome in run(studies, level, tell_check, partial(tell_study, names=so_far.selected), workers):
            so_far = save(replace(so_far, outcomes=(*so_far.outcomes, reports.save_files(outcome, out))))
            if command.campaign and options.docs and not outcome.error:
                put_tables(command, outcome, options)
                put_pictures(command, outcome, options.docs)
    except KeyboardInterrupt:
        interrupted = True
    result = save(replace(so_far, complete=not interrupted))
    print(reports.terminal_table(result))
    words = command.finished(result, options)
    if words:
        print(words)
    print(f"report: {out / 'report.html'}")
    if interrupted:
        return 130
    return 0 if result.passed else 1


def environment() -> dict[str, str]:
    """Return the version of the lubfric that runs, then `report.environment`.

    The metadata of an editable installation may be older than the code, or missing."""
    import lubfric  # not needed to list the studies

    return {"lubfric": lubfric.__version__} | reports.environment()


def put_tables(command: Command, outcome: Outcome, options: argparse.Namespace) -> None:
    """Put the tables of a study into the pages that name them, with the command that measures them."""
    from .campaigns.tables.pages import put

    level = "" if options.level == command.levels[0] else f" --{options.level}"
    for table in outcome.tables:
        put(options.docs, table, f"{command.program}{level} --only {outcome.study.name} --docs docs")


def put_pictures(command: Command, outcome: Outcome, docs: Path) -> None:
    """Put the pictures of a study where the folder ``docs`` has one of that name, with the name of the command before
    it or without."""
    for figure in outcome.figures:
        for stem in (f"{command.name}-{figure.name}", figure.name):
            file = docs / "images" / f"{stem}.{figure.format}"
            if file.is_file():
                file.write_bytes(figure.data)
                break


def tell_study(study: Study, names: tuple[str, ...]) -> None:
    """Say on stderr which study starts."""
    print(f"[{names.index(study.name) + 1}/{len(names)}] {study.name}: {study.title}", file=sys.stderr, flush=True)


def tell_check(check: Check) -> None:
    """Say on stderr how a check ended, as it comes in."""
    word = "list" if check.deviates_as_listed else "ok  "
    if check.failed:
        word = "FAIL"
    print(f"    {word} {check.name}", file=sys.stderr, flush=True)
