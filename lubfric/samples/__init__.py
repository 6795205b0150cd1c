"""The sample of rough surface that represents the infinite line contact: strips of it, one patch, or a contact without
cells.

`contract` says what a `Sample` is: strips by number, pieces on native cells, and the rough contact on them. `choose`
says which one a scene gets: `strips` (generated, or windows of a measured map), or `patch` (one map, and contacts that
are not solved on cells). `maps` makes, reads and prepares the height maps, `windows` lays out windows of a map and
joins them, `cells` finds the length of the cells, and `contacts` turns the keys of a scene into a contact of
`lubfric.contact`.
"""

from .cells import Cells, length_of_rough_contact, longest_cell_in_motion
from .choose import requests_patch, sample_of, takes_strips
from .contract import PIECE_LENGTH, Sample
from .maps import (
    check_map,
    combined_maps,
    contact_maps,
    is_extended,
    is_measured,
    rough_bodies,
    way_to_longer_line,
    way_to_longer_patch,
    whole_maps,
)
from .patch import SinglePatch, UnresolvedSample
from .rough_contacts import cylinder_of, flat_contact_of, half_space_contact_of
from .strips import GeneratedStrips, MeasuredStrips, measured_strips
