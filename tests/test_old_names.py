"""Attributes of version 0.2.0 that have another name today raise with it; names that no version had are in no table."""

from collections.abc import Iterator

import pytest

import lubfric
from lubfric import output  # noqa: F401  (imports every class of a result)

# Attributes of version 0.2.0 that have another name today, by the class, which had another name itself if one is here.
OLD = {
    "Balance": {"contact", "split"},
    "CurveResult": {"entries", "told"},
    "Decision": {"cells", "contact", "film", "heat"},
    "DeterministicResult": {"drawn", "given", "spot_fraction", "spot_length", "spots"},
    "EHLResult": {"contact"},
    "FitResult": {"entries"},
    "FrictionResult": {"lacks"},
    "Lubricant": {"newtonian"},
    "Prepared": {"contact", "given", "joint", "known", "remembered", "strips"},
    "StudyResult": {"cautioned"},
    "TransientResult": {"entries"},
    "Uncertainty": {"few_spots", "spots"},
    "UncertaintyCurve": {"spots"},
    "Violation": {"remedy"},  # of version 0.2.0: Validity
}


def kinds(base: type) -> Iterator[type]:
    """Yield the classes below ``base``."""
    for kind in base.__subclasses__():
        yield kind
        yield from kinds(kind)


(RENAMED,) = (base for base in lubfric.FrictionResult.__mro__ if base.__name__ == "Renamed")
TABLES = {kind.__name__: kind for kind in kinds(RENAMED) if vars(kind).get("_RENAMED")}


def test_the_tables_have_the_names_of_version_0_2_0_alone():
    assert {name: set(kind._RENAMED) for name, kind in TABLES.items()} == OLD


@pytest.mark.parametrize("name", OLD)
def test_an_old_name_raises_with_the_name_of_today(name):
    kind = TABLES[name]
    blank = object.__new__(kind)
    for old, new in kind._RENAMED.items():
        assert hasattr(kind, new) or new in kind.__dataclass_fields__
        with pytest.raises(AttributeError, match=f"{name}.{old} is called {new} now"):
            getattr(blank, old)
    with pytest.raises(AttributeError, match="has no attribute 'no_name'"):
        _ = blank.no_name


def test_an_old_class_raises_with_the_name_of_today():
    with pytest.raises(AttributeError, match=r"lubfric.Validity is called lubfric.Violation now"):
        _ = lubfric.Validity
