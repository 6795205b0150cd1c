"""Public attributes of version 0.2.0 that have another name today raise with it."""

import pytest

import lubfric

# (class, old name, today's name), by `dir` of the classes that version 0.2.0 exported.
OLD = [
    ("EHLResult", "contact", "line"),
    ("Lubricant", "newtonian", "has_unlimited_stress"),
    ("Prepared", "known", "violations"),
    ("Prepared", "strips", "sample"),
    ("Prepared", "joint", "has_one_map_for_all_bodies"),
    ("Prepared", "remembered", "memo"),
    ("FrictionResult", "lacks", "unmodelled_effects"),
    ("TransientResult", "entries", "violations"),
]


@pytest.mark.parametrize(("kind", "old", "new"), OLD)
def test_an_old_name_raises_with_the_name_of_today(kind, old, new):
    blank = object.__new__(getattr(lubfric, kind))
    assert hasattr(type(blank), new) or new in type(blank).__dataclass_fields__
    with pytest.raises(AttributeError, match=f"{kind}.{old} is called {new} now"):
        getattr(blank, old)
