"""Isotherms of products by name, read from ``drying/data/isotherms.toml``: each is a law without free
parameters.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Any, ClassVar

import tomli

from granum.core import law
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import MoistureDryBasis, Temperature, WaterActivity
from granum.drying.isotherms import adsorption, grains
from granum.drying.isotherms.base import ROOM, AbstractIsotherm

_MODELS: dict[str, Any] = {
    "chung_pfost": grains.ChungPfost,
    "halsey_modified": grains.HalseyModified,
    "gab": adsorption.Gab,
}


def _declare(name: str, row: dict[str, Any]) -> type:
    model = _MODELS[row["model"]](**row["constants"])
    ranges = {"water_activity": tuple(row["aw"])}
    if "celsius" in row:
        ranges["temperature"] = tuple(t + ZERO_CELSIUS for t in row["celsius"])

    @law(
        "isotherm",
        name=f"isotherm_{name}",
        source=row["source"],
        title=f"Isotherm of {row['en']}",
        fitted=ranges,
    )
    class Product(AbstractIsotherm):
        """Sorption isotherm of a product with the constants of its source, over temperature."""

        curve: ClassVar[str] = model.curve

        def __call__(
            self, water_activity: WaterActivity, temperature: Temperature = ROOM
        ) -> MoistureDryBasis:
            return self.moisture(water_activity, temperature)

        def moisture(self, a: Any, T: Any) -> Any:
            return model.moisture(a, T)

        def activity(self, X: Any, T: Any) -> Any:
            return model.activity(X, T)

    return Product


PRODUCTS: dict[str, type] = {
    name: _declare(name, row)
    for name, row in tomli.loads(
        (files("granum") / "drying" / "data" / "isotherms.toml").read_text(encoding="utf-8")
    ).items()
}
"""Products by name: what may be given as ``isotherm``."""
