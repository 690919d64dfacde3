"""A bin of grain through which a fan blows ambient air: cooling, and drying, of what lies still for days."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import scipy

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Density,
    Law,
    Length,
    Mass,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    PressureDrop,
    Ratio,
    SignedMassFlow,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    WaterActivity,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.aeration import MAIZE, Grain, aeration_fronts, resistance_of
from granum.drying.formulas.beds import pressure_gradient_shedd
from granum.drying.formulas.storage import LIMITS
from granum.drying.gas_solid.column import Zone
from granum.drying.gas_solid.dryer import Dried, Through
from granum.drying.gas_solid.kinetics import EquilibriumKinetics
from granum.drying.gas_solid.layer import LayerDryer
from granum.drying.gas_solid.liquor import counted
from granum.drying.gas_solid.steam import is_steam
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, FANNED, fanned

UNITS = 10.0  # transfer units of a layer: air leaves it as good as in equilibrium with the grain
NO_STEAM = "Grain in a bin is not blown with steam: give ambient air at the port 'gas'."


class BinFigures(NamedTuple):
    """Figures of a bin of grain after the time the fan has run; means over the depth unless they say
    otherwise.
    """

    time_aeration: Time
    time_cooling: Time
    time_drying: Time
    solid_holdup: Mass
    superficial_velocity: Speed
    pressure_drop: PressureDrop
    electric_power_fan: Power
    specific_energy: SpecificEnergy
    evaporation_rate: SignedMassFlow
    moisture_dry_basis: MoistureDryBasis
    moisture_dry_basis_lowest: MoistureDryBasis
    moisture_dry_basis_highest: MoistureDryBasis
    water_activity_highest: WaterActivity
    temperature_product: Temperature
    temperature_product_highest: Temperature
    temperature_exhaust: Temperature
    relative_humidity: Ratio


@equipment(
    "grain_bin",
    source="asaed272; sutherland1971; hellevang2010",
    title="Aerated grain bin",
)
class GrainBin(LayerDryer):
    """Grain lies still in a bin and a fan blows ambient air up through it: a front cools it in days, a second
    one, far behind, brings it to the moisture of the air in weeks.

    Layers of grain in time, each of which the air leaves in equilibrium with it. The feed's flow is the load
    over the time that the fan runs, which it so fixes; the product is the load, mixed. The air is that behind
    the fan, which warms it by a kelvin or so, and stays as it is: a mean of the hours in which the fan runs.
    ``packing_resistance`` multiplies the resistance of loose, clean, dry grain (1.5 where it was not spread).
    ``time_cooling`` and ``time_drying`` are those of fronts without width, the least. Heat through walls,
    respiration of the grain and heat of sorption beyond vaporization are left out.
    """

    area: Area
    height: Length
    bulk_density_dry: Density = 620.0
    grain: Grain = "maize"
    isotherm: Annotated[Any, Law("isotherm")] = MAIZE
    packing_resistance: Annotated[PositiveNumber, Within(0.5, 3.0)] = 1.5
    layers: Annotated[int, Within(1, 1000)] = 20
    steps: Annotated[int, Within(1, 100_000)] = 50

    limits: ClassVar[Limits] = {
        "air": Limit("air per volume of grain", 2.5e-4, 0.03, "m^3/(s*m^3)", "hellevang2010"),
        "pressure": Limit("air pressure lost in the grain", 0.0, 2500.0, "Pa", "hellevang2010"),
        "fitted": Limit(
            "air velocity against the data of the grain's resistance", 0.0, 1.0, "dimensionless", "asaed272"
        ),
        "cooled": Limit(
            "time of the cooling front over that of the fan", 0.0, 1.0, "dimensionless", "sutherland1971"
        ),
        "keeps": Limit(
            "water activity of the wettest grain", 0.0, LIMITS["molds"], "dimensionless", "beuchat1981"
        ),
        "wetted": Limit(
            "dew point of the air above the grain's temperature",
            -math.inf,
            0.0,
            "delta_degC",
            "hellevang2010",
        ),
        "roof": Limit(
            "dew point of the moistest exhaust above the outside air",
            -math.inf,
            0.0,
            "delta_degC",
            "hellevang2010",
        ),
    }

    utilities: ClassVar[Utilities] = FANNED | AREA

    @property
    def temperature_limit(self) -> None:
        """None: ambient air harms no grain."""

    @property
    def kinetics(self) -> EquilibriumKinetics:
        return EquilibriumKinetics(self.isotherm)

    @classmethod
    def size(
        cls,
        time_aeration: Any,
        feed: Stream,
        gas: Stream,
        pressure_drop: Any,
        bulk_density_dry: Any = 620.0,
        **more: Any,
    ) -> GrainBin:
        """The bin that the given air passes in a time and at a pressure, which falls as the floor grows."""
        volume = float(time_aeration * feed.solid_flow / bulk_density_dry)

        def bin_of(area: float) -> GrainBin:
            return cls(area, volume / area, bulk_density_dry, **more)

        def over(x: float) -> float:
            return float(jnp.log(bin_of(math.exp(x)).pressure_lost(feed, gas) / pressure_drop))

        middle = math.log(volume ** (2.0 / 3.0))
        return bin_of(
            math.exp(scipy.optimize.root_scalar(over, bracket=(middle - 9.0, middle + 9.0), xtol=1e-12).root)
        )

    def extent(self) -> Any:
        return self.area * self.height

    def resolution(self) -> tuple[int, int]:
        return self.layers, self.steps

    def holdup(self, feed: Stream) -> Any:
        return self.extent() * self.bulk_density_dry

    def blown(self, feed: Stream, gas: Stream) -> Any:
        """Dry air per dry grain and second."""
        return HumidMixture(feed.mixture).carrier_flow(gas) / self.holdup(feed)

    def exchange(self, feed: Stream, gas: Stream) -> Any:
        return UNITS * self.layers * self.blown(feed, gas) * gas.gas_heat_capacity

    def zones(self, feed: Stream, *gases: Stream) -> list[Zone]:
        (gas,) = gases
        time = self.holdup(feed) / jnp.maximum(feed.solid_flow, 1e-12)
        humidity = HumidMixture(feed.mixture).vapor_per_carrier(gas)
        return [Zone(time, self.blown(feed, gas), False, humidity, gas.temperature)]

    def through(self, feed: Stream, gas: Stream) -> Through:
        unsolved(~is_steam(gas), type(self).card, reason=NO_STEAM)
        return super().through(feed, gas)

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, **_others: Any
    ) -> BinFigures:
        whole = super().figures(inside, outlets, feed, gas)
        found, time = inside.profile, whole.residence_time
        X, T = found.moisture[-1], found.temperature[-1]
        dry = counted(feed)
        bare = dry.replace(liquid=0.0 * dry.liquid, gas=0.0 * dry.gas)
        capacity = safe_divide(bare.enthalpy_at(300.0) - bare.enthalpy_at(290.0), 10.0 * dry.solid_flow)
        fronts = aeration_fronts.function(
            feed.temperature,
            dry.moisture_dry_basis,
            gas.temperature,
            jnp.clip(HumidMixture(gas.mixture).relative_humidity(gas), 1e-3, 0.99),
            self.isotherm,
            capacity,
            gas.pressure,
        )
        blown = self.blown(feed, gas)
        lost = self.pressure_lost(feed, gas)
        power = fanned(gas.gas_volume_flow, lost)
        return BinFigures(
            time_aeration=time,
            time_cooling=safe_divide(fronts.air_per_grain_cooling, blown),
            time_drying=safe_divide(fronts.air_per_grain_drying, blown),
            solid_holdup=whole.solid_holdup,
            superficial_velocity=gas.gas_volume_flow / self.area,
            pressure_drop=lost,
            electric_power_fan=power,
            specific_energy=safe_divide(power, feed.solid_flow + feed.liquid_flow),
            evaporation_rate=whole.evaporation_rate,
            moisture_dry_basis=whole.moisture_dry_basis,
            moisture_dry_basis_lowest=jnp.min(X),
            moisture_dry_basis_highest=jnp.max(X),
            water_activity_highest=jnp.max(self.isotherm.activity(X, T)),
            temperature_product=whole.temperature_product,
            temperature_product_highest=jnp.max(T),
            temperature_exhaust=whole.temperature_exhaust,
            relative_humidity=whole.relative_humidity,
        )

    def measured(
        self,
        inside: Through,
        outlets: Dried,
        figures: BinFigures,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        humid = HumidMixture(gas.mixture)
        moistest = humid.carrier_flow(gas) * jnp.max(inside.profile.humidity)
        exhaust = gas.replace(gas=gas.gas.at[humid.vapor].set(moistest))
        return {
            "air": gas.gas_volume_flow / self.extent(),
            "pressure": figures.pressure_drop,
            "fitted": figures.superficial_velocity / resistance_of(self.grain)["velocity_high"],
            "cooled": figures.time_cooling / figures.time_aeration,
            "keeps": figures.water_activity_highest,
            "wetted": gas.temperature - humid.superheat(gas) - feed.temperature,
            "roof": -humid.superheat(exhaust),
        }

    def drawn(
        self,
        inside: Through,
        outlets: Dried,
        figures: BinFigures,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        return {"electric_power_fan": figures.electric_power_fan, "area_installed": self.area}

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        row = resistance_of(self.grain)
        gradient = pressure_gradient_shedd.function(
            gas.gas_volume_flow / self.area, row["coefficient"], row["constant"]
        )
        return self.packing_resistance * self.height * gradient
