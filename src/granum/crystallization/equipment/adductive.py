"""A substance of a liquid that an agent takes into crystals of both and gives back when they are heated."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _, quoted
from granum.core.kinds import (
    MassFlow,
    MassFraction,
    MolarMass,
    MoleFraction,
    PositiveNumber,
    Power,
    Ratio,
    Temperature,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.layer_melt import LayerOutlets, impurity_in
from granum.crystallization.formulas.selective import adductive_crystallization
from granum.crystallization.kinds import PositiveMolarEnergy
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, cooled, heated

UREA = 0.0600553  # kg/mol
LEAST = 1e-9  # mole fraction of a substance of which there is hardly any
DRY = (
    "More liquor would adhere to the adduct than there is: give less 'liquor_per_crystals', a higher "
    "temperature, or a feed with less of the substance."
)
REDLICH = "redlich1950; mullin2001, ch. 8"


class AdductFigures(NamedTuple):
    """Figures of a separation by an adduct."""

    product_mass_flow: MassFlow
    product_recovery: Ratio
    impurity_fraction_product: MassFraction
    mole_fraction_left: MoleFraction
    mass_flow_adduct: MassFlow
    mass_flow_agent: MassFlow
    heat_duty_adduct: Power
    heat_duty: Power


class Bound(NamedTuple):
    """What the agent takes (mol/s), the mole fractions fed and left, adduct and agent (kg/s), the share of
    the liquor that adheres, and the place of the substance.
    """

    moles: Any
    fed: Any
    left: Any
    adduct: Any
    agent: Any
    adhering: Any
    place: int


@equipment(
    "adductive_crystallizer",
    source=REDLICH,
    title="Adductive crystallization: an agent takes one substance and gives it back",
    equation=r"\dot n_A = R\,\dot n_s,\quad R = \frac{x - x_r}{x\,(1-x_r)},\quad "
    r"\dot m_A = \dot n_A\left(M_s + n M_X\right)",
)
class AdductiveCrystallizer(Unit):
    """Takes one substance out of a liquid into crystals that it makes with an agent, parts these from the
    liquor and heats them until they fall apart: urea and straight paraffins, hydroquinone and methanol.

    The equilibrium is that of ``adductive_crystallization`` with an ideal liquid, reached in time and with as
    much agent as it wants; the agent goes round without loss, and none is dissolved in either outlet. What
    adheres to the adduct after the filter, by mass of adduct, ends in the product. Crystals and gas that come
    with the feed stay in the residue. The heat of the adduct is taken off where it forms and given where it
    falls apart; what warms and cools the agent on its round is left out.
    """

    temperature: Temperature
    decomposition_temperature: Temperature
    heat_of_adduct: PositiveMolarEnergy
    agent_ratio: Annotated[PositiveNumber, Within(0.1, 100.0)]
    agent_activity: Annotated[PositiveNumber, Within(1e-6, 1.0)] = eqx.field(kw_only=True, default=1.0)
    molar_mass_agent: MolarMass = eqx.field(kw_only=True, default=UREA)
    liquor_per_crystals: Ratio = eqx.field(kw_only=True, default=0.1)
    substance: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "forms": Limit(
            "substance in the liquid over what its adduct leaves", 1.0, math.inf, "dimensionless", REDLICH
        ),
    }

    utilities: ClassVar[Utilities] = HEATED | COOLED

    def inside(self, feed: Stream) -> Bound:
        liquids = feed.mixture.liquids
        if not liquids:
            raise CaseError(_("The mixture has no liquid that an agent could take something out of."))
        unknown = [s.name for s in liquids if not s.molar_mass > 0.0]
        if unknown:
            raise CaseError(
                _("The adduct needs the molar mass of {names}: give it in the materials.").format(
                    names=", ".join(quoted(name) for name in unknown)
                )
            )
        place = feed.mixture.index("liquids", self.substance) if self.substance else 0
        masses = jnp.asarray([s.molar_mass for s in liquids])
        moles = feed.liquid / masses
        x = safe_divide(moles[place], jnp.sum(moles), 0.0)
        made = adductive_crystallization(
            jnp.maximum(x, LEAST),
            self.temperature,
            self.decomposition_temperature,
            self.heat_of_adduct,
            self.agent_ratio,
            self.agent_activity,
        )
        taken = moles[place] * jnp.where(x > LEAST, made.yield_fraction, 0.0)
        agent = self.agent_ratio * self.molar_mass_agent * taken
        adduct = taken * masses[place] + agent
        liquor = feed.liquid_flow - taken * masses[place]
        adhering = safe_divide(self.liquor_per_crystals * adduct, liquor, 0.0)
        unsolved(adhering <= 1.0, type(self).card, reason=DRY)
        return Bound(taken, x, made.mole_fraction_left, adduct, agent, jnp.minimum(adhering, 1.0), place)

    def outlets(self, inside: Bound, feed: Stream) -> LayerOutlets:
        mass = feed.mixture.liquids[inside.place].molar_mass
        taken = jnp.zeros_like(feed.liquid).at[inside.place].set(inside.moles * mass)
        liquor = feed.liquid - taken
        product = feed.replace(
            solid=0.0 * feed.solid,
            gas=0.0 * feed.gas,
            liquid=taken + inside.adhering * liquor,
            temperature=jnp.asarray(self.decomposition_temperature, dtype=float),
        )
        residue = feed.replace(
            liquid=(1.0 - inside.adhering) * liquor, temperature=jnp.asarray(self.temperature, dtype=float)
        )
        duty = product.enthalpy_flow + residue.enthalpy_flow - feed.enthalpy_flow
        return LayerOutlets(product, residue, duty)

    def figures(self, inside: Bound, outlets: LayerOutlets, feed: Stream) -> AdductFigures:
        place, product = inside.place, outlets.product
        return AdductFigures(
            product.liquid_flow,
            safe_divide(product.liquid[place], feed.liquid[place], 0.0),
            impurity_in(product, place),
            inside.left,
            inside.adduct,
            inside.agent,
            self.heat_of_adduct * inside.moles,
            outlets.heat_duty,
        )

    def measured(
        self, inside: Bound, outlets: LayerOutlets, figures: AdductFigures, feed: Stream
    ) -> dict[str, Any]:
        # the formula leaves what there was where nothing forms
        forms = jnp.where(inside.moles > 0.0, safe_divide(inside.fed, inside.left, 1.0), 0.0)
        return {"forms": jnp.where(inside.fed > LEAST, forms, 1.0)}

    def drawn(
        self, inside: Bound, outlets: LayerOutlets, figures: AdductFigures, feed: Stream
    ) -> dict[str, Any]:
        latent, duty = figures.heat_duty_adduct, outlets.heat_duty
        return heated(latent + jnp.maximum(duty, 0.0), self.decomposition_temperature) | cooled(
            -latent + jnp.minimum(duty, 0.0), self.temperature
        )
