"""The methods behind a result that have a paper behind them (papers.toml)."""

from collections.abc import Iterable
from dataclasses import dataclass

from ..models import Model
from ..models.shared import Prepared
from ..scene import Scene
from .inputs_to_quote import sources_of_range

# The names of the laws of the viscosity over pressure in papers.toml, by their values of the key.
VISCOSITY_LAWS = {"roelands": "Roelands", "barus": "Barus"}

# The names of the sources of typical values in papers.toml, by an author whom the source in typical.toml names. Data
# sheets and suppliers' guides are in none.
TYPICAL_VALUES = {"Arana": "typical values, Arana", "Zhang": "typical values, Zhang"}


@dataclass(frozen=True, kw_only=True)
class MethodUse:
    """What a result shows of the methods that it uses.

    Attributes
    ----------
    model : that gives it
    has_contact, has_film : whether asperities, or a film, carry load
    slides : whether the surfaces slide
    is_sampled : whether its sampling error is known and not 0
    has_inlet_heat, has_film_heat, has_flash : whether the heat of inlet, film or surfaces changes it
    """

    model: Model
    has_contact: bool
    has_film: bool
    slides: bool
    is_sampled: bool
    has_inlet_heat: bool
    has_film_heat: bool
    has_flash: bool


def methods_of(prepared: Prepared, use: MethodUse) -> tuple[str, ...]:
    """Return the names of the methods that a result with this ``use`` rests on."""
    of_model = use.model.methods(prepared, has_contact=use.has_contact, has_film=use.has_film)
    used = (
        dict.fromkeys(of_model, True)
        | {
            "multilevel estimate": use.is_sampled and use.model.takes_control(prepared.scene, prepared.sample),
            "interval": use.is_sampled,
        }
        | _surface(prepared)
    )
    if use.has_film:
        used |= _lubricant(prepared, use) | _heat(prepared, use)
    used |= _typical_values(prepared.scene, use)
    return tuple(_names(used.items()))


def _names(used: Iterable[tuple[str, bool]]) -> list[str]:
    return [name for name, is_used in used if name and is_used]


def _surface(prepared: Prepared) -> dict[str, bool]:
    """Return how the map was made; nothing is known of a map that was given."""
    scene = prepared.scene
    maps = (
        [] if prepared.has_given_map else [rough for rough in (scene.surface, scene.counterface) if rough is not None]
    )
    return {
        "generated map": any(rough.file is None for rough in maps),
        "Gaussian filter": any(rough.s_filter is not None or rough.l_filter is not None for rough in maps),
    }


def _typical_values(scene: Scene, use: MethodUse) -> dict[str, bool]:
    """Return which sources of typical values the ranges of the inputs are from, of bodies where asperities carry load,
    and of the lubricant where a film does."""
    is_used = {"bodies": use.has_contact, "lubricant": use.has_film}
    texts = [
        text
        for key, *ends in scene.ranges
        if is_used.get(key.partition(".")[0], False)
        for text in sources_of_range(scene, key, ends)
    ]
    return {name: any(author in text for text in texts) for author, name in TYPICAL_VALUES.items()}


def _lubricant(prepared: Prepared, use: MethodUse) -> dict[str, bool]:
    """Return which methods of the oil a point uses, by their names in papers.toml."""
    lubricant = prepared.scene.lubricant
    oil = lubricant.oil
    estimate = ""
    if oil is not None and lubricant.temperature is not None:
        estimate = oil.pressure_viscosity_coefficient(lubricant.temperature).method
    of_shear = {law.cited_as: law.is_cited_without_sliding or use.slides for law in lubricant.shear_laws}
    return (
        {name: lubricant.viscosity_law == law for law, name in VISCOSITY_LAWS.items()}
        | of_shear
        | {
            "sheared flow": lubricant.flow_law is not None,
            "Dowson-Higginson": lubricant.density_law == "dowson-higginson",
            "viscosity over temperature": oil is not None,
            "viscosity index": oil is not None and "viscosity_index" in oil.given_keys,
            "So and Klaus": estimate == "so-klaus",
            "Gold": estimate == "gold",
        }
    )


def _heat(prepared: Prepared, use: MethodUse) -> dict[str, bool]:
    of_heat = {"inlet heat": use.has_inlet_heat, "film heat": use.has_film_heat, "flash": use.has_flash}
    return of_heat | {law.heat_cited_as: use.has_film_heat for law in prepared.scene.lubricant.shear_laws}
