"""Results on disk that survive a kill: whole files, append-only records, checksums, one writer a folder."""

from .codec import decode, encode
from .fingerprint import digest, fingerprint
from .lock import FolderLock
from .records import Records, growth
from .whole import clear_parts, read_checked, whole_file, write_checked, write_whole

__all__ = [
    "FolderLock",
    "Records",
    "clear_parts",
    "decode",
    "digest",
    "encode",
    "fingerprint",
    "growth",
    "read_checked",
    "whole_file",
    "write_checked",
    "write_whole",
]
