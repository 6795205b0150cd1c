"""``python -m verification``: run the studies, show the verdict, write the report."""

from __future__ import annotations

import argparse
import difflib
import importlib
import sys
import time
from pathlib import Path

from . import threads  # noqa: F401  before anything that loads numpy

# isort: split
from . import report as reports
from .check import Check
from .run import run
from .studies import STUDIES, Study

# subcommand -> module with main(argv) -> exit code; imported only when asked for
SUBCOMMANDS: dict[str, str] = {
    "figures": "verification.figures",
    "levels": "verification.levels",
    "mutations": "verification.mutations",
    "charts": "verification.charts.command",
    "stability": "verification.stability.command",
    "tables": "verification.tables",
}


def main(argv: list[str] | None = None) -> int:
    """Exit code: 0 all checks passed, 1 a check failed or a study raised, 2 the command makes no sense,
    130 stopped from the keyboard (the report then holds the studies that had finished)."""
    argv = sys.argv[1:] if argv is None else list(argv)
    if argv and argv[0] in SUBCOMMANDS:
        return importlib.import_module(SUBCOMMANDS[argv[0]]).main(argv[1:])
    options = parser().parse_args(argv)
    if options.command is not None:
        parser().error(f"unknown command {options.command!r}{did_you_mean(options.command, SUBCOMMANDS)}")
    studies = choose(options)
    if options.list:
        print("\n".join(f"{s.name:<16} {s.title} [{', '.join(s.levels)}]" for s in studies))
        return 0
    return run_all(studies, options.level, options.out)


def parser() -> argparse.ArgumentParser:
    """The command line."""
    commands = f" commands: {', '.join(SUBCOMMANDS)}" if SUBCOMMANDS else ""
    p = argparse.ArgumentParser("python -m verification", description=__doc__ + commands)
    p.add_argument("command", nargs="?", help=argparse.SUPPRESS)
    level = p.add_mutually_exclusive_group()
    level.add_argument("--quick", dest="level", action="store_const", const="quick", help="about a minute")
    level.add_argument("--full", dest="level", action="store_const", const="full", help="finest meshes")
    p.add_argument("--only", nargs="+", metavar="NAME", help="run only these studies")
    p.add_argument(
        "--out",
        type=Path,
        default=Path("out/verification"),
        metavar="DIR",
        help="where the report goes (default: %(default)s)",
    )
    p.add_argument("--list", action="store_true", help="name the studies and stop")
    p.set_defaults(level="default")
    return p


def choose(options) -> tuple[Study, ...]:
    """The studies asked for, in the order of the list; an unknown name ends the program with code 2."""
    names = [s.name for s in STUDIES]
    for name in options.only or ():
        if name not in names:
            parser().error(f"unknown study {name!r}{did_you_mean(name, names)}; known: {', '.join(names)}")
    chosen = [s for s in STUDIES if not options.only or s.name in options.only]
    if options.list:
        return tuple(chosen)
    offered = tuple(s for s in chosen if options.level in s.levels)
    missing = [f"{s.name} ({', '.join(s.levels)})" for s in chosen if s not in offered]
    if missing and options.only:
        parser().error(f"not offered at level {options.level!r}: {'; '.join(missing)}")
    for name in missing:
        print(f"not part of level {options.level!r}: {name}", file=sys.stderr)
    return offered


def did_you_mean(word: str, options) -> str:
    """' (did you mean ...?)' or an empty string."""
    found = difflib.get_close_matches(word, list(options), n=1, cutoff=0.4)
    return f" (did you mean {found[0]!r}?)" if found else ""


def run_all(studies: tuple[Study, ...], level: str, out: Path) -> int:
    """Run, write the report after every study so that a killed process loses only the one at work."""
    out.mkdir(parents=True, exist_ok=True)
    start, started = time.perf_counter(), time.strftime("%Y-%m-%d %H:%M:%S %z")
    machine, names = reports.environment(), tuple(s.name for s in studies)
    outcomes, interrupted = [], False

    def save(complete: bool) -> reports.Report:
        so_far = reports.Report(level, names, tuple(outcomes), complete, started, time.perf_counter() - start, machine)
        reports.save(so_far, out)
        return so_far

    save(complete=False)
    try:
        for outcome in run(studies, level, tell_check, lambda s: tell_study(s, names)):
            outcomes.append(reports.save_files(outcome, out))
            save(complete=False)
    except KeyboardInterrupt:
        interrupted = True
    result = save(complete=not interrupted)
    print(reports.terminal_table(result))
    print(f"report: {out / 'report.html'}")
    return 130 if interrupted else 0 if result.passed else 1


def tell_study(study: Study, names: tuple[str, ...]) -> None:
    """Progress on stderr: which study starts."""
    print(
        f"[{names.index(study.name) + 1}/{len(names)}] {study.name}: {study.title}",
        file=sys.stderr,
        flush=True,
    )


def tell_check(check: Check) -> None:
    """Progress on stderr: a check as it comes in."""
    print(f"    {'ok  ' if check.passed else 'FAIL'} {check.name}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
