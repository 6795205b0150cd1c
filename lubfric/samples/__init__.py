"""The sample of rough surface that represents the infinite line contact: strips of it, one patch, or a contact without
cells."""

from .cells import length_or_half
from .choose import sample_of, takes_strips
from .contacts import cylinder_of, flat_contact_of, half_space_contact_of
from .contract import PIECE, Sample
from .maps import check_grid, contact_maps, measured, together, whole_maps
from .patch import SinglePatch, UnresolvedSample
from .strips import GeneratedStrips, MeasuredStrips
