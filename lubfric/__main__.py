"""``python -m lubfric`` is the ``lubfric`` command."""

from .output import main

if __name__ == "__main__":
    raise SystemExit(main())
