"""``feed``: a stream that enters a line, from words and quantities with units, as a case file gives it under
``[feeds]``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.compiling import once
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.conversion import convert, law_of
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import format_number, in_unit_of, of_normal_gas, show
from granum.numerics import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.names import share_label
from granum.streams.stream import Stream, empty

Given = Any
"""A number in SI, or a text with its unit."""
PHASES = {"solids": "solid", "liquids": "liquid", "gases": "gas"}
"""By phase of a mixture the word of a feed for the shares of its species."""
KIND = {
    "solids_mass_fraction": "MassFraction",
    "moisture_dry_basis": "MoistureDryBasis",
    "moisture_wet_basis": "MoistureWetBasis",
}
HUMIDITIES = {
    "relative_humidity": "RelativeHumidity",
    "humidity_ratio": "HumidityRatio",
    "wet_bulb_temperature": "Temperature",
    "dew_point_temperature": "Temperature",
}
"""Words of a gas feed that say how much vapor its dry gas carries, one of them."""
PRESSURE = replace(KINDS["Pressure"], open_lower=True)
"""Of a feed: nothing flows out of a vacuum."""
FOG = 1e-9  # kg of drops per dry gas, of rounding at saturation
LEAST_INSIDE = 0.98  # of a feed that its size classes must hold


class _Share(Parameter):
    """The share of a species in its phase, by the words of a feed: ``liquid.water``."""

    @property
    def label(self) -> str:
        phase, _dot, species = self.name.partition(".")
        return share_label(phase, species)


def feed(
    mixture: Mixture,
    *,
    temperature: Given = "25 degC",
    pressure: Given = "1 atm",
    mass_flow: Given = None,
    solids_mass_fraction: Given = None,
    moisture_dry_basis: Given = None,
    moisture_wet_basis: Given = None,
    liquid_flow: Given = None,
    liquid: Mapping[str, Given] | None = None,
    solid_flow: Given = None,
    solid: Mapping[str, Given] | None = None,
    gas_flow: Given = None,
    gas: Mapping[str, Given] | None = None,
    relative_humidity: Given = None,
    humidity_ratio: Given = None,
    wet_bulb_temperature: Given = None,
    dew_point_temperature: Given = None,
    sizes: Any = None,
    where: str = "",
) -> Stream:
    """A stream of given flows. Shares are mass fractions within the phase; flows are of the whole phase.

    Parameters
    ----------
    mass_flow: solid and liquid together, divided by ``solids_mass_fraction``; or ``liquid_flow`` and
        ``solid_flow``. All but the last may be a volume at the feed's temperature and pressure (m³/h, gpm,
        cfm): of the slurry, of the liquid with what is dissolved in it, of the gas with its vapor, which
        may also be one at 0 °C and 1 atm (Nm³/h).
    moisture_dry_basis, moisture_wet_basis: of a moist solid, liquid per mass of dry or of wet solid, in place
        of ``liquid_flow`` or ``solids_mass_fraction``.
    liquid, solid, gas: mass fractions by name; need not be given where there is one species.
    relative_humidity, humidity_ratio, wet_bulb_temperature, dew_point_temperature: of a gas, one of them sets
        its vapor; ``gas_flow`` is then dry gas, and ``gas`` the shares of it where there are several.
    sizes: of the solid: a law of size distribution, the word for one with its parameters (``{"law":
        "rosin_rammler", …}``), or ``{"fractions": […]}``. where: what a message calls this feed.
    """
    where = where or _("in the feed")

    def quantity(value: Given, kind: str, name: str) -> float:
        return float(convert(value, Parameter(name, KINDS[kind]), " " + where))

    def shares(phase: str, given: Mapping[str, Given] | None) -> np.ndarray:
        found = np.zeros(len(getattr(mixture, phase)))
        for name, value in (given or {}).items():
            share = _Share(f"{PHASES[phase]}.{name}", KINDS["MassFraction"])
            found[mixture.index(phase, name)] = float(convert(value, share, " " + where))
        if not given and len(found) == 1:
            found[0] = 1.0
        elif not given:
            names = ", ".join(f"{PHASES[phase]}.{species.name}" for species in getattr(mixture, phase))
            raise InputError(
                _("{where}: say the shares of the {phase}: {names}.").format(
                    where=where, phase=_(phase), names=names
                )
            )
        if abs(found.sum() - 1.0) > 1e-6:
            raise InputError(
                _("{where}: the shares of the {phase} add up to {total}, not 1.").format(
                    where=where, phase=_(phase), total=format_number(float(found.sum()), 6)
                )
            )
        return found / found.sum()

    def amount(value: Given, name: str) -> tuple[float, bool]:
        """A flow, kg/s, or m³/s where it is given as a volume, and whether it is."""
        volume = name != "solid_flow" and isinstance(value, str) and in_unit_of(value, "m^3/s")
        return quantity(value, "VolumeFlow" if volume else "MassFlow", name), volume

    warm = quantity(temperature, "Temperature", "temperature")

    def per_volume(phase: str, given: Mapping[str, Given] | None) -> float:
        """Density of a phase, kg/m³."""
        return 1.0 / float(np.sum(shares(phase, given) / np.asarray(mixture.densities(phase, warm))))

    solids = None if solid_flow is None else quantity(solid_flow, "MassFlow", "solid_flow")
    said = {
        "solids_mass_fraction": solids_mass_fraction,
        "moisture_dry_basis": moisture_dry_basis,
        "moisture_wet_basis": moisture_wet_basis,
    }
    if moisture_dry_basis is not None or moisture_wet_basis is not None:
        if sum(value is not None for value in (*said.values(), liquid_flow)) > 1:
            raise InputError(
                _(
                    "{where}: give one of 'moisture_dry_basis', 'moisture_wet_basis', "
                    "'solids_mass_fraction' and 'liquid_flow'."
                ).format(where=where)
            )
        if solids is None and mass_flow is None:
            raise InputError(
                _("{where}: a moisture needs the 'solid_flow' that it is of, or 'mass_flow'.").format(
                    where=where
                )
            )
    share = next(
        (_dry(name, quantity(v, KIND[name], name)) for name, v in said.items() if v is not None), 0.0
    )
    liquids = None
    if solids is not None and share and solids_mass_fraction is None:
        liquids = solids * (1.0 / share - 1.0)
    if liquid_flow is not None:
        liquids, volume = amount(liquid_flow, "liquid_flow")
        liquids *= per_volume("liquids", liquid) if volume and liquids else 1.0
    if mass_flow is not None:
        if solids is not None or liquid_flow is not None:
            raise InputError(
                _("{where}: give 'mass_flow', or 'solid_flow' and 'liquid_flow', not both.").format(
                    where=where
                )
            )
        total, volume = amount(mass_flow, "mass_flow")
        if volume and total:
            parts = ((share, "solids", solid), (1.0 - share, "liquids", liquid))
            total /= sum(part / per_volume(phase, given) for part, phase, given in parts if part)
        solids, liquids = total * share, total * (1.0 - share)
    pressed = float(convert(pressure, Parameter("pressure", PRESSURE), " " + where))
    stream = empty(mixture, warm, pressed)
    if liquids:
        stream = stream.replace(liquid=jnp.asarray(liquids * shares("liquids", liquid)))
    if solids:
        try:
            fractions = size_shares(sizes, mixture, where)
        except GranumError as problem:
            inner = problem.details.get("name")
            problem.details |= {"name": "sizes"} | ({} if inner is None else {"option": inner})
            raise
        by_class = solids * shares("solids", solid)[:, None] * fractions[None, :]
        spread = by_class.reshape(by_class.shape + (1,) * len(mixture.axes)) * np.ones(mixture.solid_shape)
        stream = stream.replace(solid=jnp.asarray(spread / int(np.prod(mixture.solid_shape[2:]))))
    moist = {
        "relative_humidity": relative_humidity,
        "humidity_ratio": humidity_ratio,
        "wet_bulb_temperature": wet_bulb_temperature,
        "dew_point_temperature": dew_point_temperature,
    }
    humidity = {n: quantity(v, HUMIDITIES[n], n) for n, v in moist.items() if v is not None}
    if len(humidity) > 1:
        raise InputError(
            _("{where}: one value says how much vapor the gas carries; given: {names}.").format(
                where=where, names=", ".join(f"'{n}'" for n in humidity)
            )
        )
    if gas_flow is not None:
        normal = of_normal_gas(gas_flow) if isinstance(gas_flow, str) else None
        flow, volume = amount(normal or gas_flow, "gas_flow")
        if not humidity:
            stream = stream.replace(gas=jnp.asarray(flow * shares("gases", gas)))
        else:
            stream = _humid(stream, flow, shares("gases", gas) if gas else None, humidity, where)
        if volume:
            standard = {"temperature": ZERO_CELSIUS, "pressure": STANDARD_ATMOSPHERE}
            there = stream if normal is None else stream.replace(**standard)
            stream = stream.replace(gas=stream.gas * safe_divide(flow, there.gas_volume_flow))
    if not sum(np.asarray(flows).sum() for flows in (stream.solid, stream.liquid, stream.gas)) > 0:
        raise InputError(
            _("{where}: nothing flows; give 'mass_flow', 'liquid_flow', 'solid_flow' or 'gas_flow'.").format(
                where=where
            )
        )
    return stream


def _dry(name: str, value: float) -> float:
    """Solid in solid and liquid from what says it."""
    if name == "moisture_dry_basis":
        return 1.0 / (1.0 + value)
    return 1.0 - value if name == "moisture_wet_basis" else value


def _humid(
    stream: Stream, dry: float, of_dry: np.ndarray | None, told: Mapping[str, float], where: str
) -> Stream:
    """The stream with so much dry gas and the vapor that it then holds, of whatever pair its mixture has."""
    from granum.humid_gas import state
    from granum.streams.equilibrium import HumidMixture

    try:
        humid = HumidMixture(stream.mixture)
    except GranumError as problem:
        raise InputError(f"{where}: {problem.message}") from None
    ((name, value),) = told.items()
    carriers = [g.name for g in stream.mixture.gases if g.name != humid.solvent]
    if of_dry is None and len(carriers) > 1:
        raise InputError(
            _("{where}: '{name}' with several dry gases needs the shares of these in 'gas': {names}.").format(
                where=where, name=name, names=", ".join(carriers)
            )
        )
    try:
        gas = state(
            temperature=float(stream.temperature), pressure=float(stream.pressure), pair=humid.pair, **told
        )
    except GranumError as problem:
        raise InputError(f"{where}: {problem.message}") from None
    if gas.condensate_ratio > FOG:
        raise InputError(
            _(
                "{where}: at {temperature} this gas holds at most {most} of vapor per dry gas, not {value}; "
                "give less, or a warmer gas."
            ).format(
                where=where,
                temperature=show(float(stream.temperature), KINDS["Temperature"]),
                most=show(gas.humidity_ratio - gas.condensate_ratio, KINDS["HumidityRatio"]),
                value=show(gas.humidity_ratio, KINDS["HumidityRatio"]),
            ),
            name=name,
        )
    if of_dry is None:
        of_dry = np.array([float(g.name != humid.solvent) for g in stream.mixture.gases])
    if of_dry[humid.vapor]:
        raise InputError(
            _("{where}: '{said}' says how much vapor there is; leave {name} out of 'gas'.").format(
                where=where, said=name, name=humid.solvent
            )
        )
    flows, masses = dry * of_dry, np.asarray(humid.molar_masses)
    y = float(once(humid.pair.fraction, gas.humidity_ratio))
    vapor = np.sum(flows / masses) * y / (1.0 - y) * masses[humid.vapor]
    flows[humid.vapor] = dry * value if name == "humidity_ratio" else vapor  # a mass ratio as it is told
    return stream.replace(gas=jnp.asarray(flows))


def size_shares(sizes: Any, mixture: Mixture, where: str) -> np.ndarray:
    """Mass fractions of the size classes."""
    count = len(mixture.sizes)
    if sizes is None:
        raise InputError(
            _(
                "{where}: a feed with solid needs its size distribution, as sizes = {{ law = "
                '"rosin_rammler", … }}.'
            ).format(where=where)
        )
    if isinstance(sizes, Mapping) and sizes.get("fractions") is not None:
        shares = np.asarray(sizes["fractions"], dtype=float)
        if shares.shape != (count,) or np.any(shares < 0) or abs(shares.sum() - 1.0) > 1e-6:
            raise InputError(
                _("{where}: 'sizes.fractions' needs {count} values of zero or more that add up to 1.").format(
                    where=where, count=count
                )
            )
        return shares
    if isinstance(sizes, Mapping):
        options = dict(sizes)
        law = options.pop("law", None)
        if law is None:
            raise InputError(_("{where}: 'sizes' needs 'law' or 'fractions'.").format(where=where))
        sizes = law_of("size_distribution", law, where, options)
    edges = np.asarray(mixture.edges)
    cumulative = np.asarray(once(partial(_below, sizes), edges))
    below, above = float(cumulative[0]), float(1.0 - cumulative[-1])
    if not below + above <= 1.0 - LEAST_INSIDE:
        raise InputError(_outside(where, edges, below, above))
    return np.asarray(once(partial(_in_classes, sizes), edges))


def _outside(where: str, edges: Any, below: float, above: float) -> str:
    """Which share of the sizes no class takes; a side with less than 10⁻⁴ of it is not told."""
    sides = {
        _("{share} % of the feed is finer than {edge}, where the size classes begin"): (below, edges[0]),
        _("{share} % of the feed is coarser than {edge}, where the size classes end"): (above, edges[-1]),
    }
    told = [
        side.format(share=format_number(100 * share, 3), edge=show(float(edge), KINDS["Length"]))
        for side, (share, edge) in sides.items()
        if share > 1e-4 * (below + above)
    ]
    return _(
        "{where}: {sides}. Give another 'smallest' or 'largest' in [mixture.sizes], or other 'boundaries'."
    ).format(where=where, sides="; ".join(told))


def below(sizes: Any, edges: np.ndarray) -> np.ndarray | None:
    """Mass fraction finer than each edge by the law of a feed; None where it has none."""
    if not isinstance(sizes, Mapping) or sizes.get("law") is None:
        return None
    options = dict(sizes)
    law = law_of("size_distribution", options.pop("law"), "", options)
    return np.asarray(once(partial(_below, law), edges))


def _below(law: Any, edges: Any) -> Any:
    return law(edges)


def _in_classes(law: Any, edges: Any) -> Any:
    return law.classes(edges).to_basis("volume").fractions
