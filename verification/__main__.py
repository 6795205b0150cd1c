"""``python -m verification``: check lubfric against finite elements, closed forms and publications, and write a report.

NumPy uses one thread, unless OMP_NUM_THREADS is set: the studies solve many small systems, for which several threads
take 1.5 times as long.
"""

import importlib
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")

# isort: split
from . import frame
from .catalogue import STUDIES

# packages with a COMMAND of their own, imported only when the command is typed
CAMPAIGNS = ("figures", "model", "sampling", "charts", "stability", "tables", "calibration", "mutants")
SUBCOMMANDS = {"published": "verification.fem.published"} | {
    name: f"verification.campaigns.{name}" for name in CAMPAIGNS
}


SUMMARY = "Check lubfric against finite elements, closed forms and publications, and write a report."


def main(argv: list[str] | None = None) -> int:
    """Run the command that ``argv`` asks for, and return its exit code (see `verification.frame.main`)."""
    argv = sys.argv[1:] if argv is None else list(argv)
    if argv and argv[0] in SUBCOMMANDS:
        return frame.main(importlib.import_module(SUBCOMMANDS[argv[0]]).COMMAND, argv[1:])
    summary = f"{SUMMARY} Other commands, each with --help: {', '.join(SUBCOMMANDS)}."
    command = frame.Command("", summary, studies=STUDIES, out="out/verification", workers=min(2, os.cpu_count() or 1))
    if argv and not argv[0].startswith("-"):
        words = frame.did_you_mean(argv[0], SUBCOMMANDS)
        frame.parser(command).error(f"unknown command {argv[0]!r}{words}")
    return frame.main(command, argv)


if __name__ == "__main__":
    sys.exit(main())
