"""One effect: a solution that boils at a pressure, heated through a wall by what condenses behind it.

Temperature is the one unknown. At each temperature the heat balance says how much boils off and how much
crystallizes, and the solution left has one boiling point at the pressure; it must be that temperature.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.crystallization.equipment.roles import Roles, roles, with_crystals
from granum.materials.fluids import Fluid
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.from_materials import activity_laws, solute_system
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty

DRIEST = 0.999  # of the solvent, which never boils off wholly
SPAN = 80.0  # K above the boiling point of the solvent within which a solution is sought that boils


class Effect(NamedTuple):
    """What happens in one effect; ``found`` is whether a boiling solution was found, ``left`` the share of
    the solvent that stays.
    """

    temperature: Any
    pure: Any
    pressure: Any
    evaporation: Any
    crystals: Any
    product: Stream
    vapor: Stream
    duty: Any
    found: Any
    left: Any


class _Split(NamedTuple):
    """Evaporation and crystals at a temperature, and solute per solvent in what is left."""

    evaporation: Any
    crystals: Any
    liquid: Any


@dataclass(frozen=True)
class Liquor:
    """The solution of a mixture: its solvent, what its solutes do to the boiling point, its crystal."""

    mixture: Mixture
    elevation: tuple[Any, Any] | None
    """Linear and quadratic coefficient of the elevation over the mass fraction of dissolved matter, K."""

    def __post_init__(self) -> None:
        m = self.mixture
        if not m.liquids or m.liquids[0].name not in [g.name for g in m.gases]:
            raise CaseError(_("Evaporation needs a vapor of the solvent among the gases of the mixture."))
        if self.elevation is None and len(m.liquids) > 1 and not any(activity_laws(m)):
            raise CaseError(
                _(
                    "The library has no water activity of {solutes}: give 'elevation_linear' and "
                    "'elevation_quadratic', the boiling-point elevation over the mass fraction of what is "
                    "dissolved."
                ).format(solutes=", ".join(s.name for s in m.liquids[1:]))
            )

    @property
    def solvent(self) -> Fluid:
        """The first liquid, pure."""
        return self.mixture.materials.fluid(self.mixture.liquids[0].name)

    def vapor_pressure(self, T: Any) -> Any:
        """Of the pure solvent, Pa."""
        return self.solvent.vapor_pressure.value(T)

    def pure_boiling(self, pressure: Any) -> Any:
        """Of the pure solvent, K."""
        return self.solvent.boiling_temperature(pressure)

    def latent(self, T: Any) -> Any:
        """Heat of vaporization of the pure solvent, J/kg."""
        return self.solvent.heat_of_vaporization.value(T)

    @property
    def vapor(self) -> int:
        """Position of the solvent's vapor among the gases."""
        return self.mixture.index("gases", self.mixture.liquids[0].name)

    @property
    def crystal(self) -> tuple[Roles, Any] | None:
        """The crystal that forms and its solubility curve; None where no solid comes of a solute."""
        m = self.mixture
        dissolved = {s.name for s in m.liquids[1:]}
        for solid in m.solids:
            if dissolved & {name for name, _share in solid.composition}:
                found = roles(m, solid.name, "")
                system = solute_system(m.materials, m.liquids[found.solute].name, (self.solvent.name,))
                if system is not None:
                    return found, system.branch(solid.name).value
        return None

    def excess(self, T: Any, pure: Any, liquid: Any) -> Any:
        """How far a solution lies above its boiling point: in kelvin with given coefficients, else as the
        logarithm of its vapor pressure over the pressure.
        """
        solvent = jnp.maximum(liquid[0], 1e-300)
        if self.elevation is not None:
            w = 1.0 - safe_divide(liquid[0], jnp.sum(liquid), 1.0)
            return T - pure - self.elevation[0] * w - self.elevation[1] * w**2
        raised = jnp.log(self.vapor_pressure(T)) - jnp.log(self.vapor_pressure(pure))
        for i, law in enumerate(activity_laws(self.mixture), start=1):
            if law is not None:
                raised = raised + jnp.log(law(T, liquid[i] / solvent))
        return raised

    def split(self, feed: Stream, heat: Any, T: Any) -> _Split:
        """What boils off and crystallizes where feed and heat are brought to a temperature."""
        liquid, solid, gas = (self.mixture.enthalpies(phase, T) for phase in ("liquids", "solids", "gases"))
        latent = gas[self.vapor] - liquid[0]
        crystal, dissolved = self.crystal, feed.liquid
        before = jnp.zeros(())
        if crystal is not None:
            r = crystal[0]
            before = jnp.sum(feed.solid[r.solid])
            x = r.solute_fraction
            dissolved = dissolved.at[r.solute].add(x * before).at[0].add((1.0 - x) * before)
        apart = feed.enthalpy_at(T)
        most = DRIEST * dissolved[0]
        if crystal is None:
            gone = jnp.clip((feed.enthalpy_flow + heat - apart) / latent, 0.0, most)
            return _Split(gone, before, dissolved.at[0].add(-gone))
        r, curve = crystal
        x, saturated = r.solute_fraction, curve(T)
        lower = solid[r.solid] - x * liquid[r.solute] - (1.0 - x) * liquid[0]
        given = feed.enthalpy_flow + heat - apart + before * lower
        alone = given / latent
        room = jnp.maximum(x - saturated * (1.0 - x), 1e-6)
        over = (dissolved[r.solute] - saturated * dissolved[0]) / room
        with_crystals_ = (given - lower * over) / (latent + lower * saturated / room)
        full = over + saturated * jnp.clip(alone, 0.0, most) / room > 0.0
        gone = jnp.clip(jnp.where(full, with_crystals_, alone), 0.0, most)
        formed = jnp.where(full, over + saturated * gone / room, 0.0)
        formed = jnp.clip(formed, 0.0, dissolved[r.solute] / x)
        left = dissolved.at[r.solute].add(-x * formed).at[0].add(-gone - (1.0 - x) * formed)
        return _Split(gone, formed, left)


def boil(liquor: Liquor, feed: Stream, chest: Any, pure: Any, conductance: Any, sizes: LogNormal) -> Effect:
    """An effect whose solvent would boil at ``pure`` (K), heated from a chest temperature through a wall of
    a conductance (W/K).
    """
    mixture = liquor.mixture
    hottest = jnp.maximum(jnp.maximum(chest, feed.temperature), pure) + SPAN

    def excess(T: Any) -> Any:
        return liquor.excess(T, pure, liquor.split(feed, conductance * (chest - T), T).liquid)

    root = find_root(excess, pure - 1.0, hottest, start=pure + 2.0)  # pure solvent boils at its end
    T = root.value
    duty = conductance * (chest - T)
    made = liquor.split(feed, duty, T)
    liquor.excess(T, pure, made.liquid)  # once more where its flags are heard
    solid = feed.solid
    if (crystal := liquor.crystal) is not None:
        inner = tuple(range(1, feed.solid[0].ndim))
        fed = jnp.sum(feed.solid[crystal[0].solid], axis=inner)
        before = jnp.sum(fed)
        kept = fed * jnp.minimum(safe_divide(made.crystals, before, 0.0), 1.0)
        passing = sizes(jnp.asarray(mixture.edges)).at[0].set(0.0).at[-1].set(1.0)
        fresh = jnp.diff(passing) * jnp.maximum(made.crystals - before, 0.0)
        solid = with_crystals(feed, crystal[0], kept + fresh)
    pressure = liquor.vapor_pressure(pure)
    product = feed.replace(solid=solid, liquid=made.liquid, temperature=T, pressure=pressure)
    steam = empty(mixture, T).replace(pressure=pressure)
    vapor = steam.replace(gas=steam.gas.at[liquor.vapor].set(made.evaporation))
    left = safe_divide(made.liquid[0], made.liquid[0] + made.evaporation, 1.0)
    return Effect(
        T, pure, pressure, made.evaporation, made.crystals, product, vapor, duty, root.converged, left
    )


def entrained(made: Effect, carried: Any) -> tuple[Stream, Stream]:
    """Product and vapor with drops of the solution in the vapor, kg of drops per kg of vapor."""
    share = jnp.clip(safe_divide(carried * made.evaporation, made.product.liquid_flow, 0.0), 0.0, 1.0)
    drops = made.product.liquid * share
    return made.product.replace(liquid=made.product.liquid - drops), made.vapor.replace(liquid=drops)


def condensed(liquor: Liquor, vapor: Stream, temperature: Any) -> Stream:
    """A vapor and its drops as liquid at a temperature."""
    flow = vapor.gas[liquor.vapor]
    return vapor.replace(
        gas=vapor.gas.at[liquor.vapor].set(0.0),
        liquid=vapor.liquid.at[0].add(flow),
        temperature=temperature,
    )
