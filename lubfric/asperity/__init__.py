"""The deterministic asperity model: every asperity is an independent Hertz contact with a rigid flat.

Akchurin et al. 2015, Sec. 3.1 (doi:10.1007/s11249-015-0536-z), use it for comparison. They leave open what an asperity
is. Two definitions are in use, and both are here:

- "summits": points higher than their 8 neighbours; 1/R is the mean of the two second differences at the point (J. A.
  Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300-319, doi:10.1098/rspa.1966.0242; summit count as P. R.
  Nayak, J. Lubr. Technol. 93 (1971) 398-407, doi:10.1115/1.3451608).
- "patches": 8-connected regions above the separation, each replaced by the paraboloid of the same base area A and
  height delta, R = A/(2 pi delta) (M. A. Masen, M. B. de Rooij, D. J. Schipper, Wear 258 (2005) 339).

Asperities do not interact: the load of one does not depend on where the others are. The model is valid for sparse,
small contacts (delta << R). Summits depend on the grid if the surface has no second derivative.
"""

from .contact import DEFINITIONS, AsperityResult, asperity_contact, find_asperities
from .find import ridges
from .separation import separation_for_load

__all__ = ["AsperityResult", "DEFINITIONS", "asperity_contact", "find_asperities", "ridges", "separation_for_load"]
