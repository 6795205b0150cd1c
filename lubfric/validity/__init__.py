"""Is a result an answer? The assumptions of the model are checked on the scene before, and on the solution after."""

from .entry import Validity, gathered, refused

__all__ = ["Validity", "gathered", "refused"]
