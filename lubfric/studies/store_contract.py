"""What a store of records is: the contract that `lubfric.studies.store.Store` fulfils with files in a folder."""

from abc import ABC, abstractmethod
from typing import Any


class RecordStore(ABC):
    """Records by key. A record is a `FrictionResult`, an error, or a tuple of these, of numbers and of texts.

    - A key is a text that is the hash of all that the record depends on. So two records of one key are alike, and
      either may be kept.
    - Any number of processes may add at the same time. A record appears complete, or not at all.
    - What was added outlives every failure of the process that added it.
    - A record that is damaged, or was written by another version, counts as absent.
    """

    @abstractmethod
    def add(self, key: str, outcome: Any, *, sync: bool = False) -> None:
        """Keep ``outcome`` under ``key``; ``sync``: it also outlives a loss of power. Raises `OutputError`."""

    @abstractmethod
    def get(self, key: str, kind: Any = Any) -> Any:
        """Return what was added under ``key`` if it is of the type ``kind``; None for what is absent."""

    @abstractmethod
    def has(self, key: str) -> bool:
        """Return whether there is a record of ``key``, sound or not, without reading it."""
