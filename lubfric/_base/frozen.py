"""Frozen dataclasses that are copied or unpickled: their arrays stay read-only, and derived values are left out."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np


class FrozenArrays:
    """Base of frozen dataclasses: every array field is read-only, after copying and unpickling too."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.freeze()

    def freeze(self) -> None:
        """Make the array fields read-only (call it in ``__post_init__``, on arrays of one's own)."""
        for value in self.__dict__.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False


class FieldsOnly:
    """Base of frozen dataclasses with cached properties: derived values are not pickled."""

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}  # type: ignore[arg-type]
