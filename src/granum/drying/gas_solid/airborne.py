"""Dust on its way out of a dryer: what is showered or blown through the gas dries on in it."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.drying.gas_solid.kinetics import AbstractKinetics, Meeting
from granum.drying.gas_solid.liquor import composition, counted, moistened
from granum.drying.gas_solid.matter import Matter, temperature_at
from granum.numerics import safe_divide
from granum.numerics.quick_roots import falling_root
from granum.streams.stream import Stream

WETTEST = 0.999  # relative humidity up to which dust without isotherm gives off water


def dried_on(dust: Stream, gas: Stream, kinetics: AbstractKinetics) -> tuple[Stream, Stream]:
    """Dust and gas of one temperature once the dust has come down to equilibrium with the gas it travels in,
    adiabatically. Dust drier than that takes nothing up: it is out of the gas too soon.
    """
    dry, dissolved = counted(dust), composition(dust)
    matter = Matter.of(dry, gas)
    humid = matter.humid
    carrier, water = humid.carrier_flow(gas), dry.liquid[0]
    Y, enthalpy = humid.vapor_per_carrier(gas), gas.enthalpy_flow + dust.enthalpy_flow
    some = (carrier > 0.0) & (dry.solid_flow > 0.0)

    def met(share: Any) -> tuple[Stream, Stream, Any]:
        gone = share * water
        grains = moistened(dry, water - gone, dissolved)
        air = gas.replace(gas=gas.gas.at[humid.vapor].add(gone))
        both = air.replace(solid=air.solid + grains.solid, liquid=air.liquid + grains.liquid)
        flow = jnp.where(some, both.mass_flow, 1.0)
        T = temperature_at(
            lambda T: both.enthalpy_at(T) / flow, enthalpy / flow, jnp.asarray(gas.temperature, dtype=float)
        )
        return grains, air, T

    def surplus(share: Any) -> Any:
        _grains, _air, T = met(share)
        humidity = Y + safe_divide(share * water, carrier)
        X = jnp.reshape(safe_divide((1.0 - share) * water, dry.solid_flow), (1,))
        at = Meeting(X, T + 0.0 * X, T + 0.0 * X, humidity + 0.0 * X, 1.0 + 0.0 * X, matter)
        room = WETTEST - matter.relative_humidity(T, humidity)
        return jnp.where(some, jnp.minimum((X - kinetics.equilibrium(at))[0], room), -1.0)

    share = falling_root(surplus, 0.0, 1.0, size=1.0)
    grains, air, T = met(jnp.where(surplus(jnp.zeros(())) > 0.0, share, 0.0))
    T = jnp.where(some, T, dust.temperature)
    return grains.replace(temperature=T), air.replace(temperature=jnp.where(some, T, gas.temperature))
