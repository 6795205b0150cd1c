"""Fields through files: what goes out comes back, what is broken is refused."""

import meshio
import numpy as np
import pytest
import skfem

from verification import meshes
from verification.check import Field


@pytest.mark.parametrize(
    "mesh",
    [
        skfem.MeshLine(np.linspace(0, 1, 4)),
        skfem.MeshTri().refined(1),
        skfem.MeshQuad().refined(1),
        skfem.MeshTet().refined(1),
        skfem.MeshHex().refined(1),
    ],
    ids=lambda m: type(m).__name__,
)
def test_vtu_round_trip(mesh, tmp_path):
    values, vector = (np.sin(np.arange(mesh.nvertices)), np.random.default_rng(1).normal(size=(mesh.nvertices, 3)))
    field = meshes.mesh_field("f", "", mesh, {"p": values, "u": vector}, {"index": np.arange(mesh.nelements)})
    back = meshio.read(meshes.write_vtu(tmp_path / "f.vtu", field))
    assert np.array_equal(back.points[:, : mesh.dim()], mesh.p.T)
    (cells,) = back.cells_dict.values()
    assert np.array_equal(cells, mesh.t.T)
    assert np.array_equal(back.point_data["p"], values) and np.array_equal(back.point_data["u"], vector)
    assert np.array_equal(back.cell_data["index"][0], np.arange(mesh.nelements))


def test_fields_that_do_not_fit(tmp_path):
    points, cells = np.zeros((3, 2)), {"triangle": np.array([[0, 1, 2]])}
    with pytest.raises(ValueError, match="p has 2 values for 3 points"):
        meshes.write_vtu(tmp_path / "f.vtu", Field("f", "", points, cells, {"p": np.zeros(2)}))
    with pytest.raises(ValueError, match=r"outside 0\.\.1"):
        meshes.write_vtu(tmp_path / "f.vtu", Field("f", "", points[:2], cells))
    with pytest.raises(ValueError, match="1 to 3"):
        meshes.in_space(np.zeros((2, 4)))
