"""``python -m lubfric`` is the ``lubfric`` command. Little is imported here, so that an interrupt while the rest is
imported ends in one line too."""

import sys


def main() -> int:
    """Run the ``lubfric`` command and return its exit code."""
    try:
        from .output import main as command

        return command()
    except KeyboardInterrupt:  # outside of the command's own handling: while it is imported
        print("lubfric: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    raise SystemExit(main())
