"""Meshes and fields through files: what goes out comes back, what is broken is refused."""

import numpy as np
import pytest
import skfem

from verification import meshes
from verification.check import Field

MSH22 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 .5 .5 0
$EndNodes
$Elements
6
1 1 2 7 1 1 2
2 1 2 8 2 2 3
3 2 2 9 1 1 2 5
4 2 2 9 1 2 3 5
5 2 2 9 1 3 4 5
6 2 2 9 1 4 1 5
$EndElements
"""
MSH41 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 1 1 0 1 9 0
$EndEntities
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
1 1 1 1
2 1 3 1
1 1 2 3 4
$EndElements
"""


def test_gmsh_files_of_both_formats(tmp_path):
    (tmp_path / "old.msh").write_text(MSH22)
    points, cells, groups = meshes.read_gmsh(tmp_path / "old.msh")
    assert points.shape == (5, 3) and cells["triangle"].tolist() == [
        [0, 1, 4],
        [1, 2, 4],
        [2, 3, 4],
        [3, 0, 4],
    ]
    assert groups["line"].tolist() == [7, 8] and groups["triangle"].tolist() == [9] * 4
    assert np.isclose(
        skfem.Functional(lambda w: 1 + 0 * w.x[0]).assemble(
            skfem.Basis(skfem.MeshTri(points[:, :2].T, cells["triangle"].T), skfem.ElementTriP1())
        ),
        1.0,
    )
    (tmp_path / "new.msh").write_text(MSH41)
    points, cells, groups = meshes.read_gmsh(tmp_path / "new.msh")
    assert cells["quad"].tolist() == [[0, 1, 2, 3]] and points[2].tolist() == [1, 1, 0]
    assert groups["quad"].tolist() == [9]


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
    values, vector = (
        np.sin(np.arange(mesh.nvertices)),
        np.random.default_rng(1).normal(size=(mesh.nvertices, 3)),
    )
    field = meshes.mesh_field("f", "", mesh, {"p": values, "u": vector}, {"index": np.arange(mesh.nelements)})
    back = meshes.read_vtu(meshes.write_vtu(tmp_path / "f.vtu", field))
    assert np.array_equal(back.points[:, : mesh.dim()], mesh.p.T)
    (kind,) = back.cells
    assert np.array_equal(back.cells[kind], mesh.t.T)
    assert np.array_equal(back.point_data["p"], values) and np.array_equal(back.point_data["u"], vector)
    assert np.array_equal(back.cell_data["index"][0], np.arange(mesh.nelements))


def test_gmsh_round_trip(tmp_path):
    mesh = skfem.MeshTri().refined(2)
    points, cells, _ = meshes.read_gmsh(meshes.write_gmsh(tmp_path / "m.msh", mesh.p.T, {"triangle": mesh.t.T}))
    assert np.array_equal(points[:, :2], mesh.p.T) and np.array_equal(cells["triangle"], mesh.t.T)


@pytest.mark.parametrize("text", ["", "not a mesh", MSH22[:120], MSH22.replace("2.2 0 8", "9.9 0 8")])
def test_broken_gmsh_files_are_refused(tmp_path, text):
    (tmp_path / "bad.msh").write_text(text)
    with pytest.raises(ValueError, match="bad.msh"):
        meshes.read_gmsh(tmp_path / "bad.msh")


def test_missing_file_and_fields_that_do_not_fit(tmp_path):
    with pytest.raises(FileNotFoundError, match="absent.msh"):
        meshes.read_gmsh(tmp_path / "absent.msh")
    points, cells = np.zeros((3, 2)), {"triangle": np.array([[0, 1, 2]])}
    with pytest.raises(ValueError, match="p has 2 values for 3 points"):
        meshes.write_vtu(tmp_path / "f.vtu", Field("f", "", points, cells, {"p": np.zeros(2)}))
    with pytest.raises(ValueError, match=r"outside 0\.\.1"):
        meshes.write_vtu(tmp_path / "f.vtu", Field("f", "", points[:2], cells))
    with pytest.raises(ValueError, match="1 to 3"):
        meshes.in_space(np.zeros((2, 4)))
