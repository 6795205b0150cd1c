"""The folder of ``lubfric run``: one writer at a time, only complete files, result.json last. What an unfinished run
has saved is kept apart."""

from __future__ import annotations

import json
import os
import platform
import shutil
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from typing import get_type_hints

import numpy as np

from .._base import FolderLock, __version__, clear_parts, plain, read_json, saying, whole_file, write_whole
from ..errors import InputError
from ..scene import Scene, scene_as_dict
from ..sharing import Prepared, Validity, prepare
from ..studies import fits
from ..surface import rms_slope
from .console import say, say_written

RESULT, UNFINISHED, CHECKPOINT = "result.json", "unfinished", "checkpoint"
# of sweeps and of runs in time; the result, which says that a folder is complete, first to go and last to come
OUTPUTS = (
    RESULT,
    *(f"{table}.{kind}" for table in ("stribeck", "traction", "history") for kind in ("csv", "png")),
    *("contact.png", "animation.gif", "fields.npz", "report.html"),
)


def ready(scene: Scene) -> Prepared:
    """``scene`` made ready, which is said."""
    say(f"{scene.name}: preparing the height map and the contact")
    prepared = prepare(scene)
    say(prepared.surface.describe())
    return prepared


def read_record(folder: Path) -> dict:
    """What result.json of a run holds: at least the name of the scene. Raises `InputError` for anything else."""
    path, again = folder / RESULT, "give a folder that 'lubfric run' wrote, or run it again"
    if not os.path.lexists(path):
        raise InputError(f"{folder} holds no {RESULT}; {again}")
    record = read_json(path, again)
    numbers = {name: kind | None if kind is float else kind for name, kind in get_type_hints(Validity).items()}
    kind = {"scene": {"name": str}, "points": [{"validity": [numbers]}]}
    if not isinstance(record, dict) or not fits({"points": []} | record, kind):
        raise InputError(f"{path} is damaged, or no record of a run; {again}")
    return record


class RunFolder:
    """``path`` and the names of the files ``written`` to it, by a run that has ``begun`` (`time.perf_counter`). Made by
    `run_folder`."""

    def __init__(self, path: Path, name: str, begun: float):
        self.path, self.begun = path, begun
        self.unfinished = path / UNFINISHED / name[:16]
        self.written: list[str] = []

    def clear(self) -> None:
        """Remove the results of an earlier run. Call it when those of this run are ready to be written."""
        with saying(f"results of an earlier run in {self.path} were not removed"):
            for path in (*(self.path / name for name in OUTPUTS), *self.path.glob("contact_*.vtk")):
                path.unlink(missing_ok=True)

    def write(self, name: str, content: bytes) -> None:
        """Write a file of the run, completely or not at all."""
        write_whole(self.path / name, content)
        self.written.append(name)

    def draw(self, name: str, plot: Callable, *arguments) -> None:
        """Write the picture that ``plot(path, *arguments)`` saves."""
        with whole_file(self.path / name) as part:
            plot(part, *arguments)
        self.written.append(name)

    def record(self, prepared: Prepared, result, **numbers: object) -> dict:
        """The record of a run: resolved input, map, versions, timing, report, violated assumptions, ``numbers``."""
        import scipy

        surface, versions = prepared.surface, {"lubfric": __version__, "numpy": np.__version__}
        statistics = {name: getattr(surface, name) for name in ("sq", "sa", "ssk", "sku", "missing_fraction")}
        statistics["rms_slope"] = dict(zip(("x", "y", "total"), rms_slope(surface)))
        map_ = {"shape": surface.shape, "spacing": surface.spacing, "statistics": statistics, "notes": surface.notes}
        return {
            "scene": scene_as_dict(prepared.scene),
            "surface": map_,
            "versions": versions | {"scipy": scipy.__version__, "python": platform.python_version()},
            "seed": prepared.scene.surface.seed if prepared.scene.surface.file is None else None,
            "seconds": time.perf_counter() - self.begun,
            "report": result.report.as_dict(),
            "validity": result.validity,
            **numbers,
        }

    def finish(self, record: dict, *doubts: str) -> None:
        """Write ``record`` as result.json, which names the files that belong to it. Then the run is complete, what was
        saved for a resume is removed, and violated assumptions, ``doubts`` and files are said."""
        whole = plain({"files": sorted([*self.written, RESULT])} | record)
        self.write(RESULT, json.dumps(whole, indent=1, allow_nan=False).encode())
        shutil.rmtree(self.unfinished, ignore_errors=True)
        with saying(f"{self.unfinished.parent} was not removed"):
            if self.unfinished.parent.is_dir() and not any(self.unfinished.parent.iterdir()):
                self.unfinished.parent.rmdir()
        for text in (*record["validity"], *doubts):
            say(text)
        say_written(self.written, self.path, self.begun)


@contextmanager
def run_folder(path, fingerprint: str, begun: float):
    """Open ``path`` for the run with that ``fingerprint``, as a `RunFolder`. ``begun``: when the run did.

    ``.unfinished`` has what an interrupted run of the same fingerprint saved. What other runs saved is left alone.
    Raises `InputError` if ``path`` is a file, or a folder to which another process writes, and `OutputError` if it
    cannot be used.
    """
    path = Path(path)
    if path.exists() and not path.is_dir():
        raise InputError(f"--out {path} is a file; give a folder, existing or not")
    with FolderLock(path):
        clear_parts(path)
        yield RunFolder(path, fingerprint, begun)
