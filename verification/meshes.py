"""Fields on meshes, in files. The only module that knows meshio."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .check import Field
from .types import FloatArray

if TYPE_CHECKING:
    from skfem.mesh.mesh_quad_1 import MeshQuad1
    from skfem.mesh.mesh_tri_1 import MeshTri1


CELL_NAMES = dict(MeshLine="line", MeshTri="triangle", MeshQuad="quad", MeshTet="tetra", MeshHex="hexahedron")


def write_vtu(path: Path, field: Field) -> Path:
    """Write ``field`` as a VTU file.

    Raises
    ------
    ValueError : a connectivity that points outside the points, or data of the wrong length
    """
    import meshio

    count = len(field.points)
    for name, cells in field.cells.items():
        if cells.size and not 0 <= cells.min() <= cells.max() < count:
            raise ValueError(f"field {field.name!r}: {name} cells name points outside 0..{count - 1}")
    for name, values in field.point_data.items():
        if len(values) != count:
            raise ValueError(f"field {field.name!r}: {name} has {len(values)} values for {count} points")
    data = {"point_data": dict(field.point_data), "cell_data": dict(field.cell_data)}
    meshio.Mesh(in_space(field.points), list(field.cells.items()), **data).write(path, file_format="vtu")
    return Path(path)


def in_space(points: np.ndarray) -> np.ndarray:
    """Return coordinates padded with zeros to three columns."""
    points = np.atleast_2d(np.asarray(points, dtype=float))
    if points.shape[1] > 3:
        raise ValueError(f"points have {points.shape[1]} columns; allowed: 1 to 3")
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def mesh_field(
    name: str,
    caption: str,
    mesh: MeshQuad1 | MeshTri1,
    point_data: dict[str, FloatArray] | None = None,
    cell_data: dict[str, FloatArray] | None = None,
) -> Field:
    """Return a `Field` on the vertices of a scikit-fem mesh.

    ``point_data`` has values at the vertices, shape (n,) or (n, components); ``cell_data`` (m,) each.
    """
    kind = next((v for k, v in CELL_NAMES.items() if type(mesh).__name__.startswith(k)), None)
    if kind is None:
        raise ValueError(f"field {name!r}: no cell name is known for {type(mesh).__name__}")
    cells = {kind: mesh.t[: len(mesh.elem.refdom.p.T)].T}
    by_cell = {k: [np.asarray(v)] for k, v in (cell_data or {}).items()}
    return Field(name, caption, points=mesh.p.T, cells=cells, point_data=dict(point_data or {}), cell_data=by_cell)
