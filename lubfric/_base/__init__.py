"""What every room uses: checks of input (`validate`), records, text tables, files, pictures (`figures`), roots."""

from .arrays import BoolArray, FloatArray, IntArray
from .files import LOCK, FolderLock, OwnFiles, clear_checked, clear_parts, read_checked, write_checked, write_whole
from .host import with_default_errors
from .memory import check_address_space, keep_freed_memory, releasing_memory, resident_memory
from .records import FieldsOnly, FrozenArrays, Renamed, Shown, changed, share_read_only
from .roots import Root, increasing_root, secant_root
from .tables import (
    name_and_unit,
    packaged,
    plain,
    read_columns,
    read_json,
    read_table,
    table_bytes,
    table_headings,
    text_of,
)
from .work import (
    count_work,
    forecast_limit,
    limited_forecast,
    limited_work,
    may_stay_unsolved,
    unlimited_work,
    with_its_work,
    work_apart_from_limit,
    work_left,
)

__version__ = "1.0.0"
