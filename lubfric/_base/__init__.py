"""What every room uses: checks of input, records, text tables, files, figures, a bracketed root."""

from .figures import (
    BLUE,
    FRICTION,
    GREEN,
    GREY,
    RED,
    axes_or_new,
    field_image,
    friction_lines,
    key_above,
    load_shares,
    log_if_wide,
    make_ready,
    new_figure,
    plain_ticks,
    plain_words,
    speed_label,
)
from .files import (
    FolderLock,
    OwnFiles,
    clear_checked,
    clear_parts,
    read_checked,
    saying,
    sync_folder,
    whole_file,
    write_checked,
    write_whole,
)
from .records import Brief, FieldsOnly, FrozenArrays, Shown, changed, table
from .roots import Root, increasing_root
from .tables import packaged, plain, read_columns, read_json, read_table, table_bytes
from .validate import (
    array,
    choice,
    instance,
    integer,
    nonnegative,
    number,
    positive,
    python_fields,
    python_value,
    shown,
    spacing,
)

__version__ = "0.2.0"
