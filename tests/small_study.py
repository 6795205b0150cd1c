"""A scene whose points take a moment, and what two studies have to have in common."""

import numpy as np
from scene_text import paper_scene

SCENE = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.1e-6}, surface={"correlation_length": 4e-6}, numerics={"sampling": "patch"}
)


def same(one, other):
    """Equal to the last bit but for the time taken."""
    assert one.dims == other.dims and one.columns.keys() == other.columns.keys()
    np.testing.assert_array_equal(one.status, other.status)
    for name in one.columns.keys() - {"seconds"}:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)
