"""Membrane plants: ultrafiltration and microfiltration in feed-and-bleed stages, reverse osmosis."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.errors import CaseError, InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Law,
    Length,
    MassTransferCoefficient,
    MediumResistance,
    Permeance,
    PositiveNumber,
    Power,
    Pressure,
    PressureDrop,
    Series,
    Speed,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.filtration.formulas.membrane_transport import molecule_diameter, rejection_ferry
from granum.filtration.formulas.membranes import rejection_solution_diffusion
from granum.filtration.kinds import EnergyPerVolume
from granum.filtration.membranes import Membrane, matter, staged
from granum.numerics.loops import told_scan
from granum.numerics.smooth import safe_divide
from granum.streams.formulas.drives import shaft_power_incompressible
from granum.streams.inside_charts import Axis, Curve, Mark, drawn_along
from granum.streams.stream import Stream, settled
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, PUMP, PUMPED, driven

SOURCE = "cheryan1998"
PRESSED = (0.2, 2.0, 37)  # of the pressure as it runs, between which the flux is drawn, and points
HELD = (
    "Nothing permeates: the feed holds as much osmotic pressure or as much matter at the membrane as the "
    "pressure overcomes. Give a higher pressure, a thinner feed or more fresh solvent."
)
EMPTIED = (
    "The membrane would take more liquid than there is: give more feed, a smaller area, a lower pressure or "
    "a membrane of a higher resistance."
)
Resistance = Annotated[MediumResistance, Within(1e8)]
Efficiency = Annotated[PositiveNumber, Within(0.01, 1.0)]


class Parted(NamedTuple):
    """What the membrane holds back and what passes it, and the shaft power of the pumps, which warms both."""

    retentate: Stream
    permeate: Stream
    shaft_power: Any


class Chain(NamedTuple):
    """Stages in series: what the last one leaves and what all pass together, at the temperature inside;
    of each stage its flux, polarization modulus, and of its retentate the osmotic pressure and what the
    membrane holds back, kg/m³.
    """

    retentate: Stream
    permeate: Stream
    flux: Any
    modulus: Any
    osmotic: Any
    held: Any


class MembraneFigures(NamedTuple):
    """Figures of a membrane plant."""

    filtrate_flux: Speed
    filtrate_flux_last: Speed
    filtrate_flow: VolumeFlow
    volume_concentration_factor: PositiveNumber
    polarization_modulus: PositiveNumber
    osmotic_pressure: Pressure
    concentration_retentate: Concentration
    solids_recovery: Fraction
    shaft_power: Power
    energy_per_filtrate: EnergyPerVolume


class OsmosisFigures(NamedTuple):
    """Figures of a reverse osmosis plant."""

    filtrate_flux: Speed
    filtrate_flux_last: Speed
    filtrate_flow: VolumeFlow
    water_recovery: Fraction
    polarization_modulus: PositiveNumber
    osmotic_pressure: Pressure
    rejection: Fraction
    shaft_power: Power
    energy_per_filtrate: EnergyPerVolume


class _Plant(Unit):
    """Mixed stages in series, of equal area unless shares are given; each is fed with the retentate of the
    one before.
    """

    area: Area
    pressure_drop: PressureDrop

    utilities: ClassVar[Utilities] = PUMPED | AREA

    def shares(self, count: int) -> Any:
        """Share of the area in each stage."""
        return jnp.full(count, 1.0 / count)

    def areas(self, count: int) -> Any:
        """Area of each stage, m²."""
        return self.area * self.shares(count)

    def chain(self, feed: Stream, membrane: Membrane, count: int, fresh: Stream | None = None) -> Chain:
        """The stages one after the other, fresh solvent in equal parts into each."""

        def stage(entering: Stream, area: Any) -> tuple[Stream, tuple[Any, ...]]:
            if fresh is not None:
                entering = entering + fresh.part(solid=1.0 / count, liquid=1.0 / count, gas=1.0 / count)
            retentate, permeate, *found = staged(entering, membrane._replace(area=area))
            return retentate, (permeate.solid, permeate.liquid, matter(retentate, membrane), *found)

        start = jax.tree.map(lambda x: jnp.asarray(x, dtype=float), feed)
        left, found = told_scan(stage, start, self.areas(count), length=count)
        solid, liquid, held, flux, modulus, osmotic, driven_, closed = found
        card = type(self).card
        unsolved(jnp.all(driven_), card, reason=HELD)
        unsolved(jnp.all(closed), card, reason=EMPTIED)
        permeate = left.part().replace(solid=jnp.sum(solid, axis=0), liquid=jnp.sum(liquid, axis=0))
        return Chain(left, permeate, flux, modulus, osmotic, held)

    def joined(self, chain: Chain, entering: Any, power: Any) -> Parted:
        """Retentate and permeate at the temperature that the enthalpy of what entered and the pumps give."""
        retentate, permeate = chain.retentate, chain.permeate
        whole = retentate.replace(
            solid=retentate.solid + permeate.solid, liquid=retentate.liquid + permeate.liquid
        )
        there = whole.at_enthalpy(entering + power)
        retentate, permeate = settled(
            entering + power,
            retentate.replace(temperature=there.temperature),
            permeate.replace(temperature=there.temperature),
        )
        return Parted(retentate, permeate, power)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        chain, count = made.inside, len(made.inside.flux)
        if not float(inlets["feed"].liquid_flow) > 0.0:
            return {}
        if count < 2:
            return {_("Flux over the pressure"): self.pressed(chain, inlets)}
        drawn = drawn_along(
            Axis("stage_count", "Number", "", _("stage")),
            np.arange(1, count + 1),
            (Axis("filtrate_flux", "Speed"), [Curve(_("flux"), chain.flux, "LIQUID")]),
            self.against(chain, count),
            mode="lines+markers",
        )
        drawn.update_xaxes(dtick=1)
        return {_("From stage to stage"): drawn}

    def pressed(self, chain: Chain, inlets: Mapping[str, Stream]) -> Any:
        """Flux of the one stage over the pressure, with the osmotic pressure of what it holds."""
        streams = [inlets["feed"], *(inlets[port] for port in inlets if port != "feed")]
        pressures = self.pressure_drop * np.linspace(*PRESSED)

        flux, osmotic = _pressed(self, streams, jnp.asarray(pressures))
        return drawn_along(
            Axis("pressure_drop", "PressureDrop", label=_("pressure across the membrane")),
            pressures,
            (Axis("filtrate_flux", "Speed"), [Curve(_("flux"), flux, "LIQUID")]),
            (
                Axis("osmotic_pressure", "Pressure"),
                [Curve(_("osmotic pressure of the retentate"), osmotic, "SOLID", "dash")],
            ),
            marks=[Mark(_("as it runs"), self.pressure_drop, chain.flux[0])],
        )

    def against(self, chain: Chain, count: int) -> tuple[Axis, list[Curve]]:
        """What holds the flux down, from stage to stage."""
        return (
            Axis("pressure", "Pressure", label=_("pressure")),
            [
                Curve(_("osmotic pressure of the retentate"), chain.osmotic, "SOLID"),
                Curve(_("pressure across the membrane"), np.full(count, self.pressure_drop), "GAS", "dot"),
            ],
        )

    def flux(self, chain: Chain) -> tuple[Any, Any, Any]:
        """Mean and last flux, and the permeate of all stages, m³/s."""
        mean = jnp.sum(chain.flux * self.shares(len(chain.flux)))
        return mean, chain.flux[-1], mean * self.area


@eqx.filter_jit
def _pressed(plant: _Plant, streams: list[Stream], pressures: Any) -> tuple[Any, Any]:
    """Flux and osmotic pressure of the first stage at several pressures."""

    def at(pressure: Any) -> tuple[Any, Any]:
        there = eqx.tree_at(lambda p: p.pressure_drop, plant, pressure).inside(*streams)
        return there.flux[0], there.osmotic[0]

    return jax.vmap(at)(pressures)


def _dissolved(stream: Stream) -> Any:
    """Of the liquid, by mass, beside the solvent."""
    return safe_divide(jnp.sum(stream.liquid[1:]), stream.liquid_flow, 0.0)


@equipment(
    "ultrafiltration",
    source=SOURCE,
    title="Ultrafiltration or microfiltration plant",
    equation=(
        r"u = \min\left[\frac{\Delta p - \Delta\pi}{\eta\,(R_s + R_f)},\ k\,\ln\frac{c_g}{c}\right],"
        r"\qquad R = \left[\frac{d}{d_p}\left(2 - \frac{d}{d_p}\right)\right]^2"
    ),
)
class Ultrafiltration(_Plant):
    """Feed-and-bleed stages: each circulates what it holds past its membrane and bleeds it to the next; fresh
    solvent, if any, enters all stages in equal parts (diafiltration).

    Stages have equal areas unless ``area_shares`` are given, one for each stage; shares or areas, only their
    proportions count.

    Solids are held back by size, dissolved matter by that of a compact molecule of its molar mass, which
    polarization lessens. Flux is that of the pressure less the osmotic pressure at the wall, or that at
    which what is held back gels there (``concentration_gel``), whichever is less; a ``flux_law`` as measured
    takes the place of both. The transfer coefficient is one for all solutes, and fouling a resistance that
    is given. The osmotic pressure among the figures is that of the last retentate. Limits recalled, not
    opened.
    """

    pore_diameter: Length
    mass_transfer_coefficient: MassTransferCoefficient
    medium_resistance: Resistance
    fouling_resistance: MediumResistance = eqx.field(kw_only=True, default=0.0)
    concentration_gel: Annotated[Concentration, Within(1e-3)] | None = eqx.field(kw_only=True, default=None)
    stage_count: Literal["1", "2", "3", "4", "5", "6"] = eqx.field(kw_only=True, static=True, default="1")
    circulation_flow: VolumeFlow = eqx.field(kw_only=True, default=0.0)
    pressure_drop_channel: PressureDrop = eqx.field(kw_only=True, default=1e5)
    flux_law: Annotated[Any, Law("membrane_flux")] = eqx.field(kw_only=True, default=None)
    area_shares: Annotated[PositiveNumber, Series("stages")] | None = eqx.field(kw_only=True, default=None)

    limits: ClassVar[Limits] = {
        "flux": Limit("flux of the membrane", 1.4e-6, 1.4e-4, "m/s", SOURCE),
        "pressure": Limit("pressure across the membrane", 1e4, 1e6, "Pa", SOURCE),
        "gel": Limit("matter in the retentate over that of a gel", 0.0, 0.9, "dimensionless", SOURCE),
        "once": Limit("permeate over the circulating flow", 0.0, 0.2, "dimensionless", SOURCE, quiet=True),
    }

    def __check_init__(self) -> None:
        if self.area_shares is not None and len(self.area_shares) != int(self.stage_count):
            raise InputError(
                _("'area_shares' has {given} values for {count} stages: give one for each.").format(
                    given=len(self.area_shares), count=self.stage_count
                ),
                name="area_shares",
            )

    def shares(self, count: int) -> Any:
        if self.area_shares is None:
            return super().shares(count)
        given = jnp.asarray(self.area_shares, dtype=float)
        return given / jnp.sum(given)

    def membrane(self, feed: Stream) -> Membrane:
        """One stage."""
        m, count = feed.mixture, int(self.stage_count)
        at = getattr(self.flux_law, "at", None)  # of a law that hangs on the pressure
        masses = [s.molar_mass for s in m.liquids]
        if not all(mass > 0.0 for mass in masses):
            raise CaseError(_("The membrane asks for the molar mass of every liquid of the mixture."))
        held = jnp.stack(
            [jnp.zeros(()), *(rejection_ferry(_size(mass), self.pore_diameter) for mass in masses[1:])]
        )
        through = 1.0 - rejection_ferry(jnp.asarray(m.sizes), self.pore_diameter)
        resistance = self.medium_resistance + self.fouling_resistance
        return Membrane(
            self.area / count,
            self.pressure_drop,
            self.mass_transfer_coefficient,
            lambda permeate: 1.0 / (permeate.liquid_viscosity * resistance),
            lambda _flux, modulus: (1.0 - held) * modulus / (held + (1.0 - held) * modulus),
            jnp.broadcast_to(through, (len(m.solids), through.size)),
            self.concentration_gel,
            self.flux_law if at is None else at(self.pressure_drop),
        )

    def against(self, chain: Chain, count: int) -> tuple[Axis, list[Curve]]:
        gel = self.concentration_gel
        gels = [] if gel is None else [Curve(_("where it gels"), np.full(count, gel), "SOLID", "dot")]
        return (
            Axis("concentration_retentate", "Concentration"),
            [Curve(_("what the membrane holds back"), chain.held, "SOLID"), *gels],
        )

    def inside(self, feed: Stream, solvent: Stream | None = None) -> Chain:
        return self.chain(feed, self.membrane(feed), int(self.stage_count), solvent)

    def outlets(self, inside: Chain, feed: Stream, solvent: Stream | None = None) -> Parted:
        entering, volume = feed.enthalpy_flow, feed.slurry_volume_flow
        if solvent is not None:
            entering = entering + solvent.enthalpy_flow
            volume = volume + solvent.slurry_volume_flow
        fed = shaft_power_incompressible(volume, self.pressure_drop, PUMP)
        loop = shaft_power_incompressible(self.circulation_flow, self.pressure_drop_channel, PUMP)
        power = jnp.where(volume > 0.0, fed + int(self.stage_count) * loop, 0.0)
        return self.joined(inside, entering, power)

    def figures(
        self, inside: Chain, outlets: Parted, feed: Stream, solvent: Stream | None = None
    ) -> MembraneFigures:
        mean, last, flow = self.flux(inside)
        return MembraneFigures(
            mean,
            last,
            flow,
            safe_divide(feed.liquid_volume_flow, outlets.retentate.liquid_volume_flow, 1.0),
            jnp.max(inside.modulus),
            inside.osmotic[-1],
            matter(outlets.retentate, self.membrane(feed)),
            jnp.clip(safe_divide(outlets.retentate.solid_flow, feed.solid_flow, 1.0), 0.0, 1.0),
            outlets.shaft_power,
            safe_divide(outlets.shaft_power, flow, 0.0),
        )

    def measured(
        self,
        inside: Chain,
        outlets: Parted,
        figures: MembraneFigures,
        feed: Stream,
        solvent: Stream | None = None,
    ) -> dict[str, Any]:
        gel = self.concentration_gel
        most = jnp.max(inside.flux * self.areas(int(self.stage_count)))
        return {
            "flux": figures.filtrate_flux,
            "pressure": jnp.asarray(self.pressure_drop),
            "once": safe_divide(most, jnp.asarray(self.circulation_flow), 0.0),
            **({} if gel is None else {"gel": figures.concentration_retentate / gel}),
        }

    def drawn(
        self,
        inside: Chain,
        outlets: Parted,
        figures: MembraneFigures,
        feed: Stream,
        solvent: Stream | None = None,
    ) -> dict[str, Any]:
        return {"electric_power_pump": driven(outlets.shaft_power), "area_installed": self.area}


def _size(molar_mass: float) -> Any:
    """Of a molecule, m, whether or not it is a protein."""
    return molecule_diameter.function(molar_mass, 0.73e-3)


@equipment(
    "reverse_osmosis",
    source="wijmans1995; filmtec2023",
    title="Reverse osmosis or nanofiltration plant",
    equation=(
        r"u = A_w\left(\Delta p - \Delta\pi\right),\qquad \frac{c_p}{c_b} = "
        r"\frac{B\,e^{u/k}}{u + B\,e^{u/k}}"
    ),
)
class ReverseOsmosis(_Plant):
    """Elements in series under pressure: solvent passes by pressure less osmotic pressure at the wall, solute
    at its own rate, by solution and diffusion.

    The osmotic pressure follows from the water activity of the library's solutes, each as in its own solution
    with all the water; other solutes count as ideal. One permeability holds for all solutes. Each element is
    mixed on its feed side; the pressure lost along it is left out. Solids stay with the retentate. The
    osmotic pressure among the figures is that of the last retentate. Limits recalled, not opened.
    """

    membrane_permeance: Permeance
    solute_permeability: Speed
    mass_transfer_coefficient: MassTransferCoefficient
    element_count: Literal["1", "2", "3", "4", "5", "6", "7", "8"] = eqx.field(
        kw_only=True, static=True, default="6"
    )
    machine_efficiency: Efficiency = eqx.field(kw_only=True, default=PUMP)
    energy_recovery_efficiency: Fraction = eqx.field(kw_only=True, default=0.0)

    limits: ClassVar[Limits] = {
        "flux": Limit("flux of the membrane", 1.4e-6, 1.4e-5, "m/s", "filmtec2023"),
        "pressure": Limit("pressure across the membrane", 5e5, 8.3e6, "Pa", "filmtec2023"),
        "polarization": Limit("polarization modulus", 1.0, 1.2, "dimensionless", "filmtec2023"),
    }

    def membrane(self, feed: Stream) -> Membrane:
        """One element."""
        m, B = feed.mixture, self.solute_permeability

        def passage(flux: Any, modulus: Any) -> Any:
            held = rejection_solution_diffusion.function(flux, B * modulus)
            return jnp.full(len(m.liquids), 1.0) * (1.0 - held)

        return Membrane(
            self.area / int(self.element_count),
            self.pressure_drop,
            self.mass_transfer_coefficient,
            lambda _permeate: jnp.asarray(self.membrane_permeance, dtype=float),
            passage,
            jnp.zeros((len(m.solids), m.sizes.size)),
        )

    def inside(self, feed: Stream) -> Chain:
        return self.chain(feed, self.membrane(feed), int(self.element_count))

    def outlets(self, inside: Chain, feed: Stream) -> Parted:
        fed = shaft_power_incompressible(feed.slurry_volume_flow, self.pressure_drop, self.machine_efficiency)
        back = self.energy_recovery_efficiency * inside.retentate.slurry_volume_flow * self.pressure_drop
        return self.joined(inside, feed.enthalpy_flow, fed - back)

    def figures(self, inside: Chain, outlets: Parted, feed: Stream) -> OsmosisFigures:
        mean, last, flow = self.flux(inside)
        leaves = safe_divide(_dissolved(outlets.permeate), _dissolved(feed), 0.0)
        return OsmosisFigures(
            mean,
            last,
            flow,
            jnp.clip(safe_divide(outlets.permeate.liquid_volume_flow, feed.liquid_volume_flow), 0.0, 1.0),
            jnp.max(inside.modulus),
            inside.osmotic[-1],
            jnp.clip(1.0 - leaves, 0.0, 1.0),
            outlets.shaft_power,
            safe_divide(outlets.shaft_power, flow, 0.0),
        )

    def measured(
        self, inside: Chain, outlets: Parted, figures: OsmosisFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "flux": figures.filtrate_flux,
            "pressure": jnp.asarray(self.pressure_drop),
            "polarization": figures.polarization_modulus,
        }

    def drawn(self, inside: Chain, outlets: Parted, figures: OsmosisFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_pump": driven(outlets.shaft_power), "area_installed": self.area}
