"""Arrays that stay read-only, even after the object that holds them was copied or unpickled."""

from __future__ import annotations

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
