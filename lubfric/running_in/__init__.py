"""The surface after the contact has passed over it: `lubfric.run_in`."""

from .run_in import RunIn, estimated_run_in, run_in
from .wear import RECORDED, Wear
