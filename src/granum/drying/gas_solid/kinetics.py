"""Drying kinetics as the contact core asks for them: water lost per second and kilogram of dry solid, where
solid meets gas.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import law
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Diffusivity,
    Law,
    Length,
    MoistureDryBasis,
    MolarEnergy,
    Number,
    PositiveNumber,
    Temperature,
)
from granum.drying.formulas.characteristic import CHARACTERISTIC_LINEAR
from granum.drying.formulas.storage import LIMITS
from granum.drying.gas_solid.matter import Matter
from granum.drying.isotherms.base import ROOM, AbstractIsotherm
from granum.drying.thin_layers.base import AbstractThinLayer
from granum.numerics import find_root

Isotherm = Annotated[Any, Law("isotherm")]
Curve = Annotated[Any, Law("characteristic_rate")]
COLDEST = 200.0  # K, of a wet bulb
LEAST = 1e-9
# of roots within a law: the core solves to 1e-12 and would never settle on rates known less well
EXACT = 1e-13
# kg/kg above equilibrium over which the last vapor pressure of the reaction engineering approach vanishes
REA_FOOT = 1e-3
DAMP = 0.95  # relative humidity from which on a surface may be wetted however moist the solid is
DRINKING = 0.05  # driving force per characteristic moisture below equilibrium
FOOT = 1e-4  # characteristic moisture below which every curve is a straight line to equilibrium
# of the critical moisture, over which the rate falls where equilibrium comes near to it or lies above
NARROWEST = 0.01


class Meeting(NamedTuple):
    """Solid and gas where they meet; the last axis runs over the classes of the solid."""

    moisture: Any
    temperature: Any
    gas_temperature: Any
    humidity: Any
    exchange: Any  # heat transfer coefficient times area per dry solid, W/(K kg)
    matter: Matter
    known_wet_bulb: Any = None

    @property
    def conductance(self) -> Any:
        """Mass transfer on the logarithmic driving force, kg/(s kg), by the Lewis factor of the pair: one for
        air and water.
        """
        return self.exchange / (
            self.matter.humid.lewis_factor
            * self.matter.gas_heat_capacity(self.gas_temperature, self.humidity)
        )

    def film_rate(self, activity: Any = 1.0) -> Any:
        """Rate of a surface of given water activity at the temperature of the solid."""
        pressure = activity * self.matter.saturation_pressure(self.temperature)
        return self.conductance * self.matter.driving_force(pressure, self.matter.fraction(self.humidity))

    @property
    def relative_humidity(self) -> Any:
        """Of the gas, kept below saturation."""
        return jnp.clip(self.matter.relative_humidity(self.gas_temperature, self.humidity), LEAST, 0.99)

    def equilibrium(self, isotherm: AbstractIsotherm | None) -> Any:
        """Moisture at which the gas dries no further; zero for a solid without isotherm."""
        if isotherm is None:
            return 0.0 * self.moisture
        humidity = self.matter.relative_humidity(self.gas_temperature, self.humidity)
        some = jnp.clip(humidity / LEAST, 0.0, 1.0)  # from gas without vapor nothing can be drunk
        return some * isotherm.moisture(self.relative_humidity, self.gas_temperature) + 0.0 * self.moisture

    @property
    def wet_bulb(self) -> Any:
        """Surface temperature at which heat through the film just feeds evaporation."""
        if self.known_wet_bulb is not None:
            return self.known_wet_bulb
        m = self.matter
        T, Y = jnp.broadcast_arrays(self.gas_temperature, self.humidity)
        # gas beyond saturation is its own wet bulb
        y = jnp.minimum(m.fraction(Y), m.saturation_pressure(T) / m.pressure * (1.0 - LEAST))
        conductance = 1.0 / (m.humid.lewis_factor * m.gas_heat_capacity(T, Y))

        def balance(Ts: Any, T: Any, y: Any, conductance: Any) -> Any:
            pressure = m.saturation_pressure(Ts)
            heat = _stefan(m.vapor_heat_capacity(Ts), m.heat_of_vaporization(Ts), T - Ts)
            return heat - conductance * m.driving_force(pressure, y)

        return find_root(
            balance, COLDEST, jnp.maximum(T, COLDEST + 1.0), T, y, conductance, start=310.0, tolerance=EXACT
        ).value


class AbstractKinetics(eqx.Module):
    """A rate of drying. Negative where the gas wets the solid. ``asks_wet_bulb``: whether it needs that of
    the gas.
    """

    asks_wet_bulb: ClassVar[bool] = False

    @abstractmethod
    def rate(self, at: Meeting) -> Any:
        """kg of water per second and kg of dry solid."""

    @abstractmethod
    def equilibrium(self, at: Meeting) -> Any:
        """Moisture that the solid tends to in this gas."""

    def tell(self, relative_humidity: Any, gas_temperature: Any) -> None:
        """Where gas that dried lies beyond the data of its isotherm: told once for a dryer, because what runs
        in loops tells nothing.
        """
        isotherm = getattr(self, "isotherm", None)
        if isotherm is not None:
            isotherm.tell(relative_humidity, gas_temperature)


def _stefan(heat_capacity: Any, latent: Any, difference: Any) -> Any:
    """Evaporation per heat transfer coefficient from a temperature difference: Spalding's logarithm of the
    heat that the vapor takes along.
    """
    return jnp.log1p(jnp.maximum(heat_capacity * difference / latent, -0.9)) / heat_capacity


def _hindered(rate: Any, phi: Any, curve: Any, conductance: Any) -> Any:
    """Evaporation slowed by the characteristic curve; condensation meets no such resistance. Solid below
    equilibrium drinks, whatever the film would do: that ends every search for a steady state on the right
    side.
    """
    slowed = curve.rate(jnp.clip(phi, FOOT, 1.0)) * jnp.clip(phi / FOOT, 0.0, 1.0)
    return jnp.where(rate > 0, slowed, 1.0) * rate + DRINKING * conductance * jnp.minimum(phi, 0.0)


class _Curved(AbstractKinetics):
    """Critical moisture, curve and isotherm, shared by the two laws of the characteristic curve."""

    critical_moisture: MoistureDryBasis
    characteristic_rate: Curve = CHARACTERISTIC_LINEAR
    isotherm: Isotherm | None = None

    def __call__(self) -> Number:
        return self.critical_moisture

    def equilibrium(self, at: Meeting) -> Any:
        return at.equilibrium(self.isotherm)

    def _phi(self, at: Meeting) -> Any:
        low = self.equilibrium(at)
        narrowest = jnp.maximum(NARROWEST * self.critical_moisture, 1e-6)
        return (at.moisture - low) / jnp.maximum(self.critical_moisture - low, narrowest)


@law(
    "drying_kinetics",
    name="kinetics_surface",
    source="keey1978; langrish2009",
    title="Kinetics, surface with a characteristic curve",
    equation=r"-\frac{dX}{dt} = f(\Phi)\,k\ln\frac{1+Y_s(T_s)}{1+Y},\quad \Phi = \frac{X-X_e}{X_c-X_e}",
)
class SurfaceKinetics(_Curved):
    """Film at the solid's own temperature, slowed by the characteristic curve below the critical moisture,
    with Stefan flow.

    >>> float(SurfaceKinetics(critical_moisture=0.2)())
    0.2
    """

    def rate(self, at: Meeting) -> Any:
        return _hindered(at.film_rate(), self._phi(at), self.characteristic_rate, at.conductance)


@law(
    "drying_kinetics",
    name="kinetics_van_meel",
    source="vanmeel1958; keey1978",
    title="Kinetics of van Meel, rate of the wet bulb",
    equation=(
        r"-\frac{dX}{dt} = f(\Phi)\,\frac{h a}{c_v}\ln\left[1+\frac{c_v (T_g-T_w)}{L_v}\right],\quad "
        r"\Phi = \frac{X-X_e}{X_c-X_e}"
    ),
)
class VanMeelKinetics(_Curved):
    """Rate of a wet surface at the wet bulb of the local gas times the characteristic curve: van Meel's own
    statement.

    In steam it does not exceed that of the film, which wets a feed colder than boiling.

    >>> float(VanMeelKinetics(critical_moisture=0.2)())
    0.2
    """

    asks_wet_bulb: ClassVar[bool] = True

    def rate(self, at: Meeting) -> Any:
        m, Tw = at.matter, at.wet_bulb
        wet = at.exchange * _stefan(
            m.vapor_heat_capacity(Tw), m.heat_of_vaporization(Tw), at.gas_temperature - Tw
        )
        wet = jnp.where(m.is_steam, jnp.minimum(wet, at.film_rate()), wet)
        return _hindered(wet, self._phi(at), self.characteristic_rate, at.conductance)


@law(
    "drying_kinetics",
    name="kinetics_rea",
    source="chen2008rea; lin2006",
    title="Kinetics, reaction engineering approach",
    equation=(
        r"p_s = e^{-\Delta E_v/RT_s}\,p_{sat}(T_s),\quad \Delta E_v = -R T_g\ln\varphi\; a\,e^{-b "
        r"(X-X_b)^c}"
    ),
)
class ReactionKinetics(AbstractKinetics):
    """Chen's approach: vapor pressure at the surface falls by an activation energy along the product's master
    curve; defaults of skim milk.

    Differs from the print: solid moister than in equilibrium with the vapor at its own temperature takes up
    none, unless that vapor would condense.

    >>> float(ReactionKinetics()())
    0.998
    """

    rea_factor: PositiveNumber = 0.998
    rea_coefficient: PositiveNumber = 1.405
    rea_exponent: PositiveNumber = 0.930
    isotherm: Isotherm | None = None

    def __call__(self) -> Number:
        return self.rea_factor

    def equilibrium(self, at: Meeting) -> Any:
        return at.equilibrium(self.isotherm)

    def rate(self, at: Meeting) -> Any:
        over = at.moisture - self.equilibrium(at)
        relative = self.rea_factor * jnp.exp(
            -self.rea_coefficient * jnp.maximum(over, 1e-6) ** self.rea_exponent
        )
        activity = jnp.exp(relative * at.gas_temperature / at.temperature * jnp.log(at.relative_humidity))
        film = at.film_rate(activity)
        # a factor below one leaves a rest of vapor pressure at equilibrium: it is taken away over the last
        # stretch of moisture
        drying = jnp.clip(over / REA_FOOT, 0.0, 1.0)
        # counted from the gas, the activity of cold solid in hot gas is far too low: what is as moist as
        # its own temperature asks for is not wetted, unless the gas is beyond saturation there
        own = at._replace(gas_temperature=at.temperature)
        dew = (at.matter.relative_humidity(at.temperature, at.humidity) - DAMP) / (1.0 - DAMP)
        wetting = jnp.clip(jnp.maximum((self.equilibrium(own) - at.moisture) / REA_FOOT, dew), 0.0, 1.0)
        rate = film * jnp.where(film > 0, drying, wetting)
        return rate + DRINKING * at.conductance * jnp.minimum(over / REA_FOOT, 0.0)


@law(
    "drying_kinetics",
    name="kinetics_thin_layer",
    source="brooker1992",
    title="Kinetics, thin layer",
    equation=(
        r"-\frac{dX}{dt} = "
        r"(X_0-X_e)\left|\frac{dMR}{dt}\right|_{MR(X)}\exp\left[\frac{E}{R}\left(\frac{1}{T_0}-\frac{1}{T_g}\right)\right]"
    ),
)
class ThinLayerKinetics(AbstractKinetics):
    """Slope of a thin-layer curve at the moisture ratio reached, towards the equilibrium of the local gas;
    Arrhenius factor on gas temperature.

    It never exceeds the film's evaporation from a wet surface, which turns to condensation where the gas is
    beyond saturation for the solid.

    >>> from granum.drying.thin_layers.exponential import Page
    >>> float(ThinLayerKinetics(Page(1e-4, 1.0), 0.3)())
    0.3
    """

    thin_layer: Annotated[Any, Law("thin_layer")]
    initial_moisture: MoistureDryBasis
    isotherm: Isotherm | None = None
    diffusion_activation_energy: MolarEnergy = 0.0
    reference_temperature: Temperature = 333.15

    def __call__(self) -> Number:
        return self.initial_moisture

    def equilibrium(self, at: Meeting) -> Any:
        return at.equilibrium(self.isotherm)

    def rate(self, at: Meeting) -> Any:
        layer: AbstractThinLayer = self.thin_layer
        low = self.equilibrium(at)
        ratio = jnp.clip(
            (at.moisture - low) / jnp.maximum(self.initial_moisture - low, 1e-6), 1e-5, 1.0 - 1e-5
        )
        # logarithm of time, because curves of Page's kind start with a slope of zero or infinity
        s = find_root(
            lambda s, r: jnp.log(jnp.maximum(layer.ratio(jnp.exp(s)), 1e-30)) - jnp.log(r),
            -15.0,
            25.0,
            ratio,
            start=8.0,
            tolerance=EXACT,
        ).value
        t = jnp.exp(jnp.where(jnp.isfinite(s), s, 0.0))
        fall = jax.jvp(layer.ratio, (t,), (jnp.ones_like(t),))[1]
        faster = jnp.exp(
            self.diffusion_activation_energy
            / GAS_CONSTANT
            * (1.0 / self.reference_temperature - 1.0 / at.gas_temperature)
        )
        thin = (at.moisture - low) * jnp.where(jnp.isfinite(s), -fall / ratio, 0.0) * faster
        # no more than a wet surface gives: cold grain in moist air does not dry on, it is wetted
        return jnp.minimum(thin, at.film_rate())


@law(
    "drying_kinetics",
    name="kinetics_equilibrium",
    source="sutherland1971; keey1978",
    title="Kinetics, surface in equilibrium with its moisture",
    equation=r"-\frac{dX}{dt} = k\ln\frac{1+Y_s}{1+Y},\quad Y_s = Y(a(X, T_s)\,p_{sat}(T_s))",
)
class EquilibriumKinetics(AbstractKinetics):
    """The gas film alone: the surface has the vapor pressure of the moisture and temperature of the solid, by
    its isotherm, and what is too dry for the gas is wetted as fast as it would dry.

    For what has time to even out inside: grain that air passes slowly for days.

    >>> from granum.drying.isotherms.products import PRODUCTS
    >>> round(float(EquilibriumKinetics(PRODUCTS["maize"]())()), 3)
    0.163
    """

    isotherm: Isotherm

    def __call__(self) -> MoistureDryBasis:
        return self.isotherm.moisture(LIMITS["molds"], ROOM)

    def equilibrium(self, at: Meeting) -> Any:
        return at.equilibrium(self.isotherm)

    def rate(self, at: Meeting) -> Any:
        return at.film_rate(self.isotherm.activity(at.moisture, at.temperature))


@law(
    "drying_kinetics",
    name="kinetics_diffusion",
    source="crank1975; keey1978",
    title="Kinetics, diffusion in a sphere and film in series",
    equation=r"\frac{1}{r} = \frac{1}{\pi^2 D/R^2\,(X-X_e)} + \frac{1}{r_{film}},\quad D = D_0 e^{-E/RT_s}",
)
class DiffusionKinetics(AbstractKinetics):
    """First term of Crank's series for a sphere as a driving force, in series with the film; a plate of half
    thickness L has R = 2 L.

    Without an activation energy the pre-exponential factor is the diffusivity itself.

    >>> float(DiffusionKinetics(1e-10, 1e-3)())
    0.001
    """

    diffusivity_preexponential: Diffusivity
    radius: Length
    diffusion_activation_energy: MolarEnergy = 0.0
    isotherm: Isotherm | None = None

    def __call__(self) -> Number:
        return self.radius

    def equilibrium(self, at: Meeting) -> Any:
        return at.equilibrium(self.isotherm)

    def rate(self, at: Meeting) -> Any:
        D = self.diffusivity_preexponential * jnp.exp(
            -self.diffusion_activation_energy / (GAS_CONSTANT * at.temperature)
        )
        inner = jnp.pi**2 * D / self.radius**2 * (at.moisture - self.equilibrium(at))
        film = at.film_rate()
        share = jnp.maximum(inner, 0.0) / jnp.maximum(jnp.maximum(inner, 0.0) + jnp.abs(film), 1e-30)
        # what diffuses bounds condensation too, which keeps the law smooth
        return jnp.where(inner > 0, share * film, inner)
