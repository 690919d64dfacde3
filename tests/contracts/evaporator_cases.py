"""Evaporators with ordinary brines and settings, to be tried by the contracts."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case

from granum.evaporation.equipment.evaporator import Evaporator, RecompressionEvaporator
from granum.evaporation.equipment.multiple_effect import MultipleEffectEvaporator, SteamJetEvaporator
from granum.streams.from_materials import mixture_of
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty


def _brine(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """1 to 10 kg/s of brine of 3 to 25 % between 40 and 100 °C."""
    flow, share = 10.0 ** x[0], 0.03 + 0.22 * x[1]
    liquid = flow * jnp.stack([1.0 - share, share])
    return {"feed": empty(mixture, 313.0 + 60.0 * x[2]).replace(liquid=liquid)}


def evaporators(classes: int) -> dict[str, Case]:
    """One case of each, its area in proportion to its feed."""
    brine = mixture_of(
        ["water", "sodium chloride"],
        ["sodium chloride"],
        ["water"],
        np.geomspace(1e-5, 4e-3, classes + 1),
    )

    def more(u: Any) -> dict[str, Any]:
        return {"fouling_thermal_resistance": 2e-4 * u[3], "drop_entrainment": 1e-2 * u[4]}

    def made(unit: Any) -> Case:
        return Case(brine, _brine, unit)

    return {
        "evaporator": made(
            lambda f, u: Evaporator(
                f["feed"].liquid_flow * (5.0 + 15.0 * u[0]), 2e4 + 8e4 * u[1], 1.5e5 + 1e5 * u[2], **more(u)
            )
        ),
        "recompression": made(
            lambda f, u: RecompressionEvaporator(
                f["feed"].liquid_flow * (20.0 + 20.0 * u[0]), 1e5, 1.7e5 + 3e4 * u[2], **more(u)
            )
        ),
        "steam jet": made(
            lambda f, u: SteamJetEvaporator(
                f["feed"].liquid_flow * (4.0 + 6.0 * u[0]),
                1e4 + 1e4 * u[1],
                1e5 + 1e5 * u[2],
                pressure_motive=8e5 + 4e5 * u[1],
                effect_count="2",
                **more(u),
            )
        ),
        "train": made(
            lambda f, u: MultipleEffectEvaporator(
                f["feed"].liquid_flow * (4.0 + 6.0 * u[0]),
                1e4 + 1e4 * u[1],
                2e5 + 1e5 * u[2],
                effect_count="2",
                **more(u),
            )
        ),
    }
