"""The scene: bodies, lubricant, motion, roughness and numerics, typed, frozen and validated."""

from ..roughness import Roughness
from .bodies import Bodies
from .contact import ContactDomain
from .motion import FASTEST, Motion
from .numerics import Numerics
from .scene import Scene, scene_as_dict

__all__ = ["Bodies", "ContactDomain", "FASTEST", "Motion", "Numerics", "Roughness", "Scene", "scene_as_dict"]
