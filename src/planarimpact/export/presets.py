"""Presets in C and JavaScript: bodies with their pairs of materials."""

from collections.abc import Mapping

import numpy as np

from planarimpact.collision import RESTITUTION_FROM
from planarimpact.collision.presets import Preset, presets
from planarimpact.export import languages
from planarimpact.export.languages import LANGUAGES, Code

BODY = "mass", "gyration", "radius"


def code(name: str, language: str) -> Code:
    """The block of presets, in a file with this name."""
    return Code("".join(_written(*item, name, language) for item in presets().items()))


def _written(key: str, preset: Preset, name: str, language: str) -> str:
    chosen, pair = LANGUAGES[language], preset.pair
    prefix = f"{name}_" if chosen.named else ""
    numbers = {field: float(getattr(pair, field)) for field in ("friction", "stiffness_ratio")}
    laws = {
        field: float(getattr(pair, field)) for field in (*RESTITUTION_FROM, "effective_modulus")
    }
    if np.isnan(laws["restitution"]):
        loss = None
    else:
        loss, laws["effective_modulus"] = "PLASTIC" if pair.plastic else "VISCOUS", np.nan
    known = {field: None if np.isnan(value) else value for field, value in laws.items()}
    words = f"{preset.about}. Numbers: {preset.source}.", f"Beware: {preset.beware}"
    return chosen.preset.format(
        comment="".join(map(languages.comment, words)),
        prefix=prefix,
        name=key,
        body=_fields({field: float(getattr(preset.body, field)) for field in BODY}, language),
        pair=_fields(numbers | known | {"loss": loss and prefix.upper() + loss}, language),
    )


def _fields(values: Mapping[str, float | str | None], language: str) -> str:
    """Fields in their order. What is missing is 0 in C, and left out where fields have names."""
    chosen = LANGUAGES[language]
    if chosen.named:
        values = {name: value or 0 for name, value in values.items()}
    shown = {name: value for name, value in values.items() if value is not None}
    return ", ".join(chosen.field.format(name=k, value=v) for k, v in shown.items())
