"""``python -m verification model``: coverage of the intervals of f, model-form error included, and the assumptions of
the deterministic model.

The default answer, and that of load sharing alone, are compared with the deterministic model on finer strips. The exit
code is 1 when too few of their intervals contain f.
"""

from ... import frame
from ...types import Keywords

PARTS: tuple[tuple[str, str, str, Keywords], ...] = (
    ("answers", "model.answers:answers", "The default answer on surfaces and contacts of many kinds", {}),
    ("answers-rollers", "model.answers:answers", "The default answer of rollers of 1 GPa", {"rollers": True}),
    ("answers-moving", "moving_coverage.items:coverage", "The deterministic answer where the roughness moves", {}),
    ("seeds", "model.seeds:seeds", "The default answer on fresh surfaces: coverage, bias, cost", {}),
    ("boundary-film", "model.boundary_film:boundary_film", "How thick the boundary film should be", {}),
    ("rolling", "model.rolling:rolling", "load sharing compared with roughness that moves", {}),
    ("running-in", "model.running_in:running_in", "Running-in over the distance, compared with published ranges", {}),
    ("moving-points", "model.random_moving:random_moving", "Random contacts under moving roughness", {}),
    ("grids", "model.film:grids", "Deterministic model on smaller and smaller cells", {}),
)
COMMAND = frame.campaign("model", __doc__, PARTS)
