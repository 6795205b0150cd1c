"""What is asked: bodies, surfaces, lubricant, motion and numerics, from a file or from Python."""

from .bodies import Bodies
from .contact import ContactDomain
from .file import load_scene, read_toml
from .history import Constant, Harmonic, History, Ramp, Table
from .history_read import checked_history, read_history
from .motion import FASTEST, LARGEST_RATIO, Motion
from .numerics import Numerics
from .plausible import doubts, told_doubts
from .resolved_gap import check_resolved_gap, resolves_gap
from .roughness import Roughness, named
from .scene import Scene, scene_as_dict
from .short_forms import short_keys
from .short_lubricant import SOURCES
from .short_motion import MOST_SPEEDS, speeds_of_range
from .template import write_template
from .transient import Transient

__all__ = [
    "Bodies",
    "Constant",
    "ContactDomain",
    "FASTEST",
    "Harmonic",
    "History",
    "LARGEST_RATIO",
    "MOST_SPEEDS",
    "Motion",
    "Numerics",
    "Ramp",
    "Roughness",
    "SOURCES",
    "Scene",
    "Table",
    "Transient",
    "check_resolved_gap",
    "checked_history",
    "doubts",
    "load_scene",
    "named",
    "read_history",
    "read_toml",
    "resolves_gap",
    "scene_as_dict",
    "short_keys",
    "speeds_of_range",
    "told_doubts",
    "write_template",
]
