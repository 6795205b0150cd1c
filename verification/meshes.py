"""Meshes and fields in files. The only module that knows meshio."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .check import Field

CELL_NAMES = dict(MeshLine="line", MeshTri="triangle", MeshQuad="quad", MeshTet="tetra", MeshHex="hexahedron")


def read_gmsh(path) -> tuple[np.ndarray, dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Read a Gmsh mesh (.msh, format 2.2 or 4.1).

    Returns
    -------
    points : (n, 3) coordinates
    cells : connectivity by meshio cell name, each (m, nodes); blocks of one kind are joined
    groups : physical group number of every cell by cell name, 0 where the file gives none

    Raises
    ------
    FileNotFoundError, ValueError : no such file; not a Gmsh mesh, or one without cells
    """
    import meshio

    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"no mesh file {path}")
    try:
        mesh = meshio.read(path, file_format="gmsh")
    except (meshio.ReadError, SystemExit, AssertionError, KeyError, ValueError, IndexError) as exc:
        raise ValueError(f"{path} cannot be read as a Gmsh mesh: {exc or type(exc).__name__}") from exc
    if not mesh.cells:
        raise ValueError(f"{path} has no cells")
    physical = mesh.cell_data.get("gmsh:physical", [np.zeros(len(b.data), dtype=int) for b in mesh.cells])
    names = dict.fromkeys(block.type for block in mesh.cells)
    cells = {n: np.concatenate([b.data for b in mesh.cells if b.type == n]) for n in names}
    groups = {n: np.concatenate([g for b, g in zip(mesh.cells, physical, strict=True) if b.type == n]) for n in names}
    return np.asarray(mesh.points, dtype=float), cells, groups


def write_gmsh(path, points: np.ndarray, cells: dict[str, np.ndarray]) -> Path:
    """Write a Gmsh 2.2 mesh; ``points`` (n, 1..3) in m, ``cells`` as in `read_gmsh`."""
    import meshio

    meshio.Mesh(in_space(points), list(cells.items())).write(path, file_format="gmsh22", binary=False)
    return Path(path)


def write_vtu(path, field: Field) -> Path:
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


def read_vtu(path) -> Field:
    """Read a VTU file back as a `Field` named like the file."""
    import meshio

    mesh = meshio.read(path, file_format="vtu")
    return Field(Path(path).stem, "", mesh.points, mesh.cells_dict, mesh.point_data, mesh.cell_data)


def in_space(points: np.ndarray) -> np.ndarray:
    """Coordinates padded with zeros to three columns."""
    points = np.atleast_2d(np.asarray(points, dtype=float))
    if points.shape[1] > 3:
        raise ValueError(f"points have {points.shape[1]} columns; allowed: 1 to 3")
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def mesh_field(name: str, caption: str, mesh, point_data=None, cell_data=None) -> Field:
    """A `Field` on the vertices of a scikit-fem mesh.

    ``point_data`` has values at the vertices, shape (n,) or (n, components); ``cell_data`` (m,) each.
    """
    kind = next((v for k, v in CELL_NAMES.items() if type(mesh).__name__.startswith(k)), None)
    if kind is None:
        raise ValueError(f"field {name!r}: no cell name is known for {type(mesh).__name__}")
    cells = {kind: mesh.t[: len(mesh.elem.refdom.p.T)].T}
    by_cell = {k: [np.asarray(v)] for k, v in (cell_data or {}).items()}
    return Field(name, caption, mesh.p.T, cells, dict(point_data or {}), by_cell)
