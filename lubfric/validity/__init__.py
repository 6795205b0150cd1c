"""Whether a result is an answer: the assumptions of the model, checked on the scene before and the solution after."""

from .entry import Validity, gathered, refused

__all__ = ["Validity", "gathered", "refused"]
