"""Labels that an array of heights brings along are read, and contradictions refused."""

import numpy as np
import pytest

import lubfric
from lubfric import Surface

xarray = pytest.importorskip("xarray", reason="needs the 'study' extra")
HEIGHTS = np.random.default_rng(1).standard_normal((12, 16)) * 1e-7
X = np.arange(12) * 2e-6
Y = np.arange(16) * 1e-6


def labelled(x=X, y=Y, dims=("x", "y"), **attrs):
    return xarray.DataArray(HEIGHTS if dims[0] == "x" else HEIGHTS.T, dict(zip("xy", (x, y))), dims, attrs=attrs)


@pytest.mark.parametrize(
    "heights",
    [labelled(), labelled(units="m"), labelled(x=X + 1), labelled(x=np.arange(12)), labelled().drop_vars("y")],
)
def test_labels_that_agree_change_nothing(heights):
    np.testing.assert_array_equal(Surface(heights, (2e-6, 1e-6)).heights, HEIGHTS)


def test_a_coordinate_in_its_own_unit_agrees():
    heights = labelled(x=X * 1e6)
    heights["x"].attrs["units"] = "µm"
    assert Surface(heights, (2e-6, 1e-6)).shape == (12, 16)


@pytest.mark.parametrize(
    ("heights", "said"),
    [
        (labelled(dims=("y", "x")), "transpose"),
        (labelled(x=X[::-1]), "sortby"),
        (labelled(units="nm"), "'nm'"),
        (labelled(x=2 * X), "4e-06"),
        (labelled(x=X * 1e6), "steps of 2 to 2 m"),
        (labelled(y=np.sort(Y**1.1)), "steps"),
    ],
)
def test_labels_that_contradict_are_refused(heights, said):
    with pytest.raises(lubfric.InputError, match=said):
        Surface(heights, (2e-6, 1e-6))
