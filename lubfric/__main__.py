"""``python -m lubfric`` is the ``lubfric`` command."""

from .cli import main

raise SystemExit(main())
