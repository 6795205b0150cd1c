"""Ways to break `lubfric` while it runs. Functions are replaced in one process, and no source is edited.

A mutant names the places that it changes as "module:attribute", and ``wrong(original)`` gives what is put there. A
place that no longer exists is an AttributeError. `applied` counts the calls, so that a mutant that never ran is not
taken for one that was caught.
"""

import contextlib
import functools
import importlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """A mistake.

    name, what : its name, and what it is in a sentence
    places : for each place "module:attribute" what replaces it
    suite : the studies that are asked to catch it
    """

    name: str
    what: str
    places: dict[str, Callable]
    suite: tuple[str, ...] = ()


@contextlib.contextmanager
def applied(mutant: Mutant) -> Iterator[list[str]]:
    """`lubfric` is broken while this is open. The list grows by a place whenever its replacement is called."""
    calls: list[str] = []
    undo = []
    try:
        for place, wrong in mutant.places.items():
            owner, name = located(place)
            original = owner.__dict__[name] if isinstance(owner, type) else getattr(owner, name)
            undo.append((owner, name, original))
            setattr(owner, name, replacement(original, wrong, place, calls))
        yield calls
    finally:
        for owner, name, original in reversed(undo):
            setattr(owner, name, original)


def located(place: str) -> tuple[object, str]:
    """The module or class that holds an attribute, and its name."""
    module, _, path = place.partition(":")
    owner = importlib.import_module(module)
    *outer, name = path.split(".")
    for part in outer:
        owner = getattr(owner, part)
    if not hasattr(owner, name):
        raise AttributeError(f"{place} does not exist any more: the mutant has to follow the code")
    return owner, name


def replacement(original, wrong: Callable, place: str, calls: list[str]):
    """``wrong(original)``, which counts its calls. A property stays a property."""
    function: Callable = original.fget if isinstance(original, property) and original.fget else original
    broken = wrong(function)

    @functools.wraps(function)
    def counted(*args, **kwargs):
        calls.append(place)
        return broken(*args, **kwargs)

    return property(counted) if isinstance(original, property) else counted


def with_keywords(**wrong) -> Callable:
    """Replace a function by one that gets these keywords, whatever was asked."""
    return lambda original: lambda *args, **options: original(*args, **options | wrong)
