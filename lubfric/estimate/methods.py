"""The methods behind a result that have a paper behind them (papers.toml)."""

from dataclasses import replace

from ..models.shared import Prepared
from .result import FrictionResult

LAWS = {"roelands": "Roelands", "barus": "Barus"}
OWN = {  # names of lubfric's own rough contacts; another may have been given
    "half-space": ("semi-periodic", "flat periodic curve"),
    "summits": ("independent summits", "flat periodic curve"),
    "patches": ("independent patches", "flat periodic curve"),
}


def with_methods(prepared: Prepared, result: FrictionResult) -> FrictionResult:
    """``result`` with the names of the methods that it uses (`lubfric.FrictionResult.methods`)."""
    used = _model(prepared, result) | _surface(prepared)
    if result.film_load > 0:
        used |= _film(prepared, result) | _lubricant(prepared, result) | _heat(prepared, result)
    return replace(result, methods=tuple(name for name, is_used in used.items() if is_used))


def _model(prepared: Prepared, result: FrictionResult) -> dict[str, bool]:
    whole = result.deterministic is not None
    model = prepared.scene.contact.model
    own = result.contact_load > 0 and not whole and prepared.contact.name in OWN[model]
    return {
        "load sharing": not whole,
        "deterministic model": whole,
        "half-space contact": own and model == "half-space",
        "summits": own and model == "summits",
        "patches": own and model == "patches",
        "interval": result.uncertainty.sampling > 0,
    }


def _surface(prepared: Prepared) -> dict[str, bool]:
    """How the map was made; nothing is known of a map that was handed over."""
    scene = prepared.scene
    maps = [] if prepared.given else [rough for rough in (scene.surface, scene.counterface) if rough is not None]
    return {
        "generated map": any(rough.file is None for rough in maps),
        "Gaussian filter": any(rough.s_filter is not None or rough.l_filter is not None for rough in maps),
    }


def _film(prepared: Prepared, result: FrictionResult) -> dict[str, bool]:
    scene = prepared.scene
    whole = result.deterministic is not None
    return {
        "scaled modulus": scene.numerics.film_deflection == "scaled" and result.contact_load > 0 and not whole,
        "kept mass": whole,
        "sheared flow": scene.lubricant.flow_law is not None,
    }


def _lubricant(prepared: Prepared, result: FrictionResult) -> dict[str, bool]:
    lubricant = prepared.scene.lubricant
    slides = prepared.scene.motion.slide_roll_ratio != 0
    oil = lubricant.oil
    estimate = ""
    if oil is not None and lubricant.temperature is not None:
        estimate = oil.pressure_viscosity_coefficient(lubricant.temperature).method
    return {name: lubricant.viscosity_law == law for law, name in LAWS.items()} | {
        "Dowson-Higginson": lubricant.density_law == "dowson-higginson",
        "Eyring stress": lubricant.eyring_stress is not None and slides,
        "Carreau": lubricant.carreau is not None,
        "limiting stress": lubricant.limit is not None and slides,
        "viscosity over temperature": oil is not None,
        "viscosity index": oil is not None and "viscosity_index" in oil.said,
        "So and Klaus": estimate == "so-klaus",
        "Gold": estimate == "gold",
    }


def _heat(prepared: Prepared, result: FrictionResult) -> dict[str, bool]:
    lubricant = prepared.scene.lubricant
    warm = result.film_temperature_rise > 0
    return {
        "inlet heat": result.inlet_film_factor < 1.0,
        "film heat": warm,
        "flash": result.flash_temperature_rise > 0,
        "hot Eyring stress": warm and lubricant.flow_law is not None,
        "hot limiting stress": warm and lubricant.limit is not None,
    }
