"""Every field of a scene is in the key of a stored point, but for the labels; and so are speed, fields and version."""

import copy
import os
import platform
import subprocess
import sys
from dataclasses import fields, is_dataclass

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.scene import Constant, Harmonic, Ramp
from lubfric.studies import Store, fingerprint, point_key, store
from lubfric.studies.arithmetic import arithmetic

OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70}
SCENE = paper_scene(
    lubricant=OIL, transient=lubfric.Transient(duration=1.0, speed=Harmonic(amplitude=0.1, frequency=1.0))
)
LABELS = {"name", "doubtful", "motion.speeds"}  # of a scene: no number depends on them


def places(part, path=""):
    """The path of every field of a dataclass and of those in it, and what holds it."""
    for each in fields(part):
        value = getattr(part, each.name)
        name = f"{path}.{each.name}" if path else each.name
        if is_dataclass(value):
            yield from places(value, name)
        else:
            yield name


def changed(part, path):
    """A copy with another value in one field, past the checks of its constructor."""
    head, _, rest = path.partition(".")
    new = copy.copy(part)
    object.__setattr__(new, head, changed(getattr(part, head), rest) if rest else "another")
    return new


PLACES = sorted({*places(SCENE)} - {"surface.file"})  # read from the disk: tests/studies/test_store.py


def test_the_scene_has_a_history_an_oil_and_a_law_of_its_viscosity():
    assert {"transient.speed.amplitude", "lubricant.oil.viscosity_law.m", "lubricant.oil.base"} <= set(PLACES)
    assert len(PLACES) > 60


@pytest.mark.parametrize("path", PLACES)
def test_every_field_of_a_scene_makes_another_key(path):
    other = changed(SCENE, path)
    assert (fingerprint(other) == fingerprint(SCENE)) == (path in LABELS)


def test_a_second_body_and_other_kinds_of_a_history_make_other_keys():
    faced = [SCENE, changed(SCENE, "counterface")]
    object.__setattr__(faced[1], "counterface", SCENE.surface)
    kinds = [Constant(value=0.1), Ramp(start=0.1, end=0.1), Harmonic(amplitude=0.1, frequency=1.0)]
    moved = [copy.copy(SCENE) for _ in kinds]
    for scene, kind in zip(moved, kinds):
        object.__setattr__(scene, "transient", lubfric.Transient(duration=1.0, speed=kind))
    assert len({fingerprint(scene) for scene in (*faced, *moved[:2])}) == 4
    assert fingerprint(moved[2]) == fingerprint(SCENE)


def test_speed_fields_and_versions_make_other_keys(monkeypatch):
    other_speeds = (0.1, -0.1, 0.10000000000000002)
    keys = {
        point_key("a", 0.1, fields=True),
        point_key("b", 0.1),
        *(point_key("a", speed) for speed in other_speeds),
    }
    assert len(keys) == 5
    keys = {fingerprint(SCENE)}
    known = arithmetic()
    for i in range(len(known)):  # versions of three packages, the machine, the bits of its sums
        other = (*known[:i], "another", *known[i + 1 :])
        monkeypatch.setattr(store, "arithmetic", lambda other=other: other)
        keys.add(fingerprint(SCENE))
    assert len(keys) == 1 + len(known) == 6


PROBE = """
import sys
from types import ModuleType
import lubfric
package = sys.modules["lubfric.studies"] = ModuleType("lubfric.studies")  # nothing else of it, which takes most of a second
package.__path__ = [f"{lubfric.__path__[0]}/studies"]
from lubfric.studies.arithmetic import trial_sums
print(trial_sums())
"""


def test_trial_sums_tell_kernels_and_threads_of_blas_apart():
    """Prescott is a kernel of OpenBLAS without vectors of four numbers. Two equal processes have equal sums."""
    blas = np.show_config(mode="dicts")["Build Dependencies"]["blas"]["name"]
    if "openblas" not in blas or (os.cpu_count() or 1) < 2 or platform.machine() != "x86_64":
        pytest.skip("needs OpenBLAS on an x86_64 machine of two processors")
    alone = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    kernel = alone | {"OPENBLAS_CORETYPE": "Prescott"}
    threads = alone | {"OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2"}
    environments = alone, alone, kernel, threads
    said = [subprocess.check_output([sys.executable, "-c", PROBE], env=one) for one in environments]
    assert said[0] == said[1] and len(set(said)) == 3


def test_a_map_comes_back_the_way_round_it_was_stored(tmp_path):
    """Column by column or row by row in memory, and turned."""
    heights = np.arange(6.0).reshape(2, 3)
    kept = Store(tmp_path)
    for name, each in {"a": heights, "b": heights.T, "c": np.asfortranarray(heights), "d": heights[:, ::-1]}.items():
        kept.add(name, (each,))
        np.testing.assert_array_equal(kept.get(name)[0], each, strict=True)
