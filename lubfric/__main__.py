"""``python -m lubfric`` is the ``lubfric`` command."""

from .output.command_line import main

raise SystemExit(main())
