"""Flash temperature of the surfaces: moving heat sources on half-spaces.

Two bodies of effusivity e = sqrt(k rho c) move the same way at u1 and u2, and carry away the heat q(x) [W/m²]. Two
assumptions are made: the film is so thin that both surfaces have the same temperature, and the sources move fast (u b
rho c/(2 k) above about 5). Then the surfaces share the heat in proportion to e sqrt(u): ``T(x) = 1/(√π (e1 √u1 + e2
√u2)) ∫_{-∞}^{x} q(x')/√(x - x') dx'`` (J. C. Jaeger, Proc. R. Soc. N.S.W. 76 (1942) 203; H. Blok 1937). A slow source
is cooler than that.
"""

from __future__ import annotations

import numpy as np

FAST = 5.0  # Péclet number u b rho c/(2 k) from which a source moves fast


def flash_matrix(x: np.ndarray, carried: float) -> np.ndarray:
    """Matrix (n, n), lower triangular: from the heat [W/m²] at the nodes ``x`` (n,) [m], rising downstream, to the rise
    [K] there. The heat is linear between the nodes, and zero upstream. carried: e1 √u1 + e2 √u2 [J/(m² K s^½) (m/s)^½].
    """
    n, step = x.size, np.diff(x)
    behind = np.maximum(x[:, None] - x[None, :], 0.0)  # from a node to those upstream
    far, near = behind[:, :-1], behind[:, 1:]
    root = 2 * (np.sqrt(far) - np.sqrt(near))
    share = (far * root - 2 / 3 * (far**1.5 - near**1.5)) / step  # of the downstream end of each cell
    matrix = np.zeros((n, n))
    upstream = np.tri(n, n - 1, -1, dtype=bool)
    matrix[:, 1:] += np.where(upstream, share, 0.0)
    matrix[:, :-1] += np.where(upstream, root - share, 0.0)
    return matrix / (np.sqrt(np.pi) * carried)
