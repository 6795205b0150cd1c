"""``python -m lubfric`` is the ``lubfric`` command."""

from .output import main

raise SystemExit(main())
