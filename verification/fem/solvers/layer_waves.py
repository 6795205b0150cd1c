"""The three-dimensional layer wave by wave: what repeats from cell to cell is diagonal in Fourier space.

It is the same discrete layer that `layer3d` assembles, element for element. Only the order of elimination differs. So
the two agree to the tolerance of the iteration there, and one application costs two transforms here.
"""

from dataclasses import dataclass

import numpy as np
import scipy.fft

from ...types import FloatArray
from .layer3d import Layer3D

WAVES = 1024  # Fourier modes eliminated at a time


@dataclass(frozen=True)
class FourierCompliance:
    """Downward surface displacement of surface forces, through the Fourier modes of the cells.

    ``symbol`` (cells x, cells y // 2 + 1, m, m) maps the forces of the m = degree^2 nodes of a cell to displacements.
    """

    layer: Layer3D
    symbol: np.ndarray

    def displacement(self, force: FloatArray) -> np.ndarray:
        """Return displacement [m] of nodal forces [N], (nx, ny) or flattened, in the shape of the forces."""
        force = np.asarray(force, dtype=float)
        (cx, cy) = self.layer.cells
        q = self.layer.degree
        waves = scipy.fft.rfft2(force.reshape(cx, q, cy, q).transpose(0, 2, 1, 3).reshape(cx, cy, q * q), axes=(0, 1))
        moved = scipy.fft.irfft2(np.matmul(self.symbol, waves[..., None])[..., 0], s=(cx, cy), axes=(0, 1))
        return moved.reshape(cx, cy, q, q).transpose(0, 2, 1, 3).reshape(force.shape)


def fourier_compliance(layer: Layer3D) -> FourierCompliance:
    """Return the compliance of the discrete layer, exactly, from one column of elements.

    Forces ``f exp(i k.x)`` over the cells make displacements of the same form (Bloch): the right and rear
    faces of an element carry the values of the left and front ones times ``exp(i kx hx)``, ``exp(i ky hy)``.
    What is left is one column of nodes, eliminated from the base up, plane by plane, for all waves together.
    """
    cx, cy = layer.cells
    phases = np.stack(
        np.broadcast_arrays(
            np.exp(2j * np.pi * np.arange(cx) / cx)[:, None], np.exp(2j * np.pi * np.arange(cy // 2 + 1) / cy)
        ),
        axis=-1,
    ).reshape(-1, 2)
    m = layer.degree**2
    parts = [column_compliance(layer, phases[i : i + WAVES]) for i in range(0, len(phases), WAVES)]
    return FourierCompliance(layer, np.concatenate(parts).reshape(cx, cy // 2 + 1, m, m))


def column_compliance(layer: Layer3D, phases: np.ndarray) -> np.ndarray:
    """Return (waves, m, m) for (waves, 2) phase factors across one cell."""
    face = 3 * layer.degree**2
    shifts, parts = bloch_parts(layer)
    twist = np.prod(phases[:, None] ** shifts, axis=-1)
    below = np.zeros((len(phases), 0, 0))  # stiffness of all below against the plane reached so far
    for number, part in enumerate(parts):
        size = part.shape[-1]
        reduced = (twist @ part.reshape(len(shifts), -1)).reshape(-1, size, size)
        reduced = reduced if number else reduced[:, face:, face:]  # the base does not move
        known = below.shape[1]
        inner = reduced.shape[1] - face
        reduced[:, :known, :known] += below
        below = reduced[:, inner:, inner:]
        if inner:
            below = below - reduced[:, inner:, :inner] @ np.linalg.solve(
                reduced[:, :inner, :inner], reduced[:, :inner, inner:]
            )
    return np.linalg.inv(below)[:, 2::3, 2::3]


def bloch_parts(layer: Layer3D) -> tuple[np.ndarray, np.ndarray]:
    """Return (shifts (9, 2), parts (layers, 9, n, n)): an element's stiffness between nodes of one column of cells.

    The wave with phase factors (a, b) sees ``sum over shifts (i, j) of a^i b^j part``; n runs over the planes
    of the element, each with the degree^2 nodes that belong to the cell.
    """
    q = layer.degree
    matrices, (ix, iy, iz, component) = layer.elements
    slot = 3 * (q * q * iz + ix % q * q + iy % q) + component
    shifts = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    over = np.array([ix // q, iy // q])
    shift = (over[0][None] - over[0][:, None] + 1) * 3 + over[1][None] - over[1][:, None] + 1
    n = 3 * q * q * (q + 1)
    parts = np.zeros((len(matrices), 9, n, n))
    at = (shift, np.broadcast_to(slot[:, None], shift.shape), np.broadcast_to(slot[None], shift.shape))
    for part, matrix in zip(parts, matrices, strict=True):
        np.add.at(part, at, matrix)
    return shifts, parts
