"""Does the contact reach the ends of its patch, and will it?

Where it does, the ends cut it off, and its friction is no answer (`lubfric.sharing.of_ends`). It is foretold
where it can be. Where a closed form rules it out, nothing is solved. Elsewhere one dry contact of the whole load,
loosely solved, shows how much lies on the edge columns. Under a film that is less, so a patch is refused only if more
is seen, the thicker the film. On 983 random patches with their ends near the contact, elastic and with a hardness, 190
are found to reach them. Of these 165 are foretold, and none of the other 793.
"""

from __future__ import annotations

import numpy as np

from ..film import hertz

ALLOWED = 0.01  # of the load on the two edge columns
FILM = 1.2  # film over Sq up to which the surfaces are taken to touch as if dry
TAIL = 0.5  # Sq: over which a rough contact's pressure falls to 1/e with the gap
POSSIBLE = 0.5 * ALLOWED  # of the load by that closed form: with less nothing is solved
TOLERANCE = 1e-2  # of the dry contact
LONGER = "make the patch longer in x: contact.shape, or for a measured map surface.extension = 'mirror'"


def within_reach(x, sq: float, line_load: float, radius: float, e_prime: float) -> bool:
    """Whether a surface of ``sq`` [m] that carries ``line_load`` w [N/m] may touch the ends of a patch of columns ``x``
    [m] (nx,): a pressure that falls with Hertz's gap leaves more than `POSSIBLE` there."""
    if x.size < 3:
        return False
    falls = np.exp(-hertz.line_gap(x, line_load, radius, e_prime) / max(TAIL * sq, 1e-300))
    return bool(falls[0] + falls[-1] > POSSIBLE * falls.sum())


def clear(share: float, film_to_roughness: float) -> bool:
    """Whether a dry contact with ``share`` of its load on the edge columns leaves too much there even under a film."""
    return share > ALLOWED * (1 + film_to_roughness)
