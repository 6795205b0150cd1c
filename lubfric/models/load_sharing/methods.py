"""The methods behind load sharing that have a paper behind them (estimate/papers.toml)."""

from ..shared import Prepared

CONTACT_METHODS = {  # names of lubfric's own rough contacts; another may have been given
    "half-space": ("semi-periodic", "flat periodic curve"),
    "summits": ("independent summits", "flat periodic curve"),
    "patches": ("independent patches", "flat periodic curve"),
}

# The method of each value of contact.model.
CONTACTS = {"half-space": "half-space contact", "summits": "summits", "patches": "patches"}


def methods_of_load_sharing(prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
    """Return the names of the methods; ``has_contact``, ``has_film``: whether asperities, or a film, carry load."""
    scene = prepared.scene
    names = ["load sharing"]
    if has_contact and prepared.rough_contact.name in CONTACT_METHODS[scene.contact.model]:
        names.append(CONTACTS[scene.contact.model])
    if has_contact and has_film and scene.numerics.film_deflection == "scaled" and scene.transient is None:
        names.append("scaled modulus")
    return tuple(names)
