"""A stream: solid by species × size class × further axes, liquid and gas by component, temperature,
pressure.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core.compiling import begun
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.numerics import find_root
from granum.streams.mixture import Mixture, array_of

COLDEST, HOTTEST = 150.0, 2500.0  # K, the bracket in which a mixing temperature is sought


class Stream(eqx.Module):
    """Flows of matter at one temperature and pressure. Frozen; every unit returns new ones.

    Parameters
    ----------
    mixture: what the stream is made of (shared, static).
    solid: kg/s, ``mixture.solid_shape``.
    liquid: kg/s, one per liquid species. Moisture is liquid that travels with solid.
    gas: kg/s, one per gas species.
    temperature: K. pressure: absolute, Pa.
    """

    solid: Any
    liquid: Any
    gas: Any
    temperature: Any
    pressure: Any
    mixture: Mixture = eqx.field(static=True)

    # -- totals
    # ------------------------------------------------------------------------------------------------
    @property
    def solid_flow(self) -> Any:
        """Total solid, kg/s."""
        return array_of(self.solid).sum(self.solid)

    @property
    def liquid_flow(self) -> Any:
        """Total liquid, kg/s."""
        return array_of(self.liquid).sum(self.liquid)

    @property
    def gas_flow(self) -> Any:
        """Total gas, kg/s."""
        return array_of(self.gas).sum(self.gas)

    @property
    def mass_flow(self) -> Any:
        """Everything, kg/s."""
        return self.solid_flow + self.liquid_flow + self.gas_flow

    @property
    def solid_by_species(self) -> Any:
        """Solid summed over all particle axes, kg/s per species."""
        return array_of(self.solid).sum(self.solid, axis=tuple(range(1, self.solid.ndim)))

    @property
    def solid_by_size(self) -> Any:
        """Solid summed over species and further axes, kg/s per size class."""
        return array_of(self.solid).sum(self.solid, axis=(0, *range(2, self.solid.ndim)))

    @property
    def components(self) -> Any:
        """Conserved components, kg/s, in the order of ``mixture.components``."""
        m = self.mixture
        total = self.liquid @ m.composition_matrix(m.liquids) if m.liquids else 0.0
        total = total + (self.gas @ m.composition_matrix(m.gases) if m.gases else 0.0)
        return total + (self.solid_by_species @ m.composition_matrix(m.solids) if m.solids else 0.0)

    # -- properties
    # --------------------------------------------------------------------------------------------
    def enthalpy_at(self, temperature: Any) -> Any:
        """Enthalpy flow if the stream were at another temperature, W."""
        return self._enthalpy(self._by_phase(), temperature)

    def _by_phase(self) -> dict[str, Any]:
        flows = {"solids": self.solid_by_species, "liquids": self.liquid, "gases": self.gas}
        return {phase: flow for phase, flow in flows.items() if getattr(self.mixture, phase)}

    def _enthalpy(self, flows: dict[str, Any], temperature: Any) -> Any:
        parts = [flow * self.mixture.enthalpies(phase, temperature) for phase, flow in flows.items()]
        total = sum((array_of(part).sum(part) for part in parts), np.float64(0.0))
        return total + self.mixture.heat_of_mixing(self.liquid, temperature)

    @property
    def enthalpy_flow(self) -> Any:
        """Enthalpy flow, W, against the reference states of the mixture."""
        return self.enthalpy_at(self.temperature)

    @property
    def liquid_fractions(self) -> Any:
        """Mass fractions of the liquid species (zero when there is no liquid)."""
        total = self.liquid_flow
        return self.liquid / array_of(total).where(total > 0, total, 1.0)

    @property
    def gas_fractions(self) -> Any:
        """Mass fractions of the gas species (zero when there is no gas)."""
        total = self.gas_flow
        return self.gas / array_of(total).where(total > 0, total, 1.0)

    @property
    def size_fractions(self) -> Any:
        """Mass fractions of the size classes (zero when there is no solid)."""
        total = self.solid_flow
        return self.solid_by_size / array_of(total).where(total > 0, total, 1.0)

    @property
    def solid_volume_flow(self) -> Any:
        """Volume of the solid, m³/s."""
        return (
            jnp.sum(self.solid_by_species / self.mixture.densities("solids", self.temperature))
            if self.mixture.solids
            else jnp.zeros(())
        )

    @property
    def liquid_volume_flow(self) -> Any:
        """Volume of the liquid, m³/s, component volumes being additive."""
        return (
            jnp.sum(self.liquid / self.mixture.densities("liquids", self.temperature))
            if self.mixture.liquids
            else jnp.zeros(())
        )

    @property
    def slurry_volume_flow(self) -> Any:
        """Solid and liquid volume, m³/s."""
        return self.solid_volume_flow + self.liquid_volume_flow

    @property
    def gas_volume_flow(self) -> Any:
        """Volume of the gas as an ideal gas, m³/s."""
        moles = sum(self.gas[i] / s.molar_mass for i, s in enumerate(self.mixture.gases))
        return moles * GAS_CONSTANT * self.temperature / self.pressure

    @property
    def solid_density(self) -> Any:
        """Mean density of the solid present, kg/m³; of the first species when there is none."""
        self.mixture.require("solids")
        return _mean_density(self.solid_by_species, self.mixture.densities("solids", self.temperature))

    @property
    def liquid_density(self) -> Any:
        """Density of the liquid, kg/m³; of the first species when there is none."""
        self.mixture.require("liquids")
        return _mean_density(self.liquid, self.mixture.densities("liquids", self.temperature))

    @property
    def liquid_viscosity(self) -> Any:
        """Viscosity of the liquid, Pa s."""
        law = self.mixture.liquid_viscosity
        if law is None:
            raise InputError(
                _("The mixture has no liquid viscosity; name its solvent or give 'liquid_viscosity'.")
            )
        return law(self.liquid_fractions, self.temperature)

    @property
    def gas_viscosity(self) -> Any:
        """Viscosity of the gas, Pa s."""
        law = self.mixture.gas_viscosity
        if law is None:
            raise InputError(
                _("The line has no gas, or none of known viscosity: choose a carrier gas for it.")
            )
        return law(self.gas_fractions, self.temperature)

    @property
    def gas_conductivity(self) -> Any:
        """Thermal conductivity of the gas, W/(m K)."""
        law = self.mixture.gas_conductivity
        if law is None:
            raise InputError(_("The mixture has no gas conductivity; name its carrier gas."))
        return law(self.gas_fractions, self.temperature)

    @property
    def gas_heat_capacity(self) -> Any:
        """Heat capacity of the gas, J/(kg K)."""
        slope = jax.jvp(
            lambda T: self.mixture.enthalpies("gases", T),
            (jnp.asarray(self.temperature, dtype=float),),
            (jnp.ones(()),),
        )[1]
        flow = self.gas_flow
        return jnp.sum(self.gas * slope) / jnp.where(flow > 0, flow, 1.0)

    @property
    def gas_density(self) -> Any:
        """Density of the gas, kg/m³ (zero when there is none)."""
        volume = self.gas_volume_flow
        return self.gas_flow / jnp.where(volume > 0, volume, 1.0)

    @property
    def moisture_dry_basis(self) -> Any:
        """Liquid per solid, kg/kg (zero when there is no solid)."""
        solid = self.solid_flow
        return self.liquid_flow / jnp.where(solid > 0, solid, 1.0) * (solid > 0)

    @property
    def solids_mass_fraction(self) -> Any:
        """Solid in solid and liquid, kg/kg."""
        solid = self.solid_flow
        total = solid + self.liquid_flow
        return solid / jnp.where(total > 0, total, 1.0)

    @property
    def solids_volume_fraction(self) -> Any:
        """Solid in the slurry by volume."""
        solid = self.solid_volume_flow
        total = solid + self.liquid_volume_flow
        return solid / jnp.where(total > 0, total, 1.0)

    # -- new streams
    # -------------------------------------------------------------------------------------------
    def replace(self, **changes: Any) -> Stream:
        """The same stream with some fields changed (``solid``, ``liquid``, ``gas``, ``temperature``,
        ``pressure``).
        """
        fields = {
            n: getattr(self, n) for n in ("solid", "liquid", "gas", "temperature", "pressure", "mixture")
        } | changes
        return Stream(**fields)

    def part(self, solid: Any = 0.0, liquid: Any = 0.0, gas: Any = 0.0) -> Stream:
        """The share of each phase (or of each species, class) that goes one way; shares broadcast over the
        arrays.

        A share of size class is given as ``share[None, :]`` padded with further axes by ``by_size``.
        """
        return self.replace(solid=self.solid * solid, liquid=self.liquid * liquid, gas=self.gas * gas)

    def by_size(self, per_class: Any) -> Any:
        """A vector over size classes shaped to multiply ``solid``."""
        return jnp.reshape(per_class, (1, -1) + (1,) * len(self.mixture.axes))

    def regraded(self, operator: Any) -> Stream:
        """Move solid between size classes by a transfer operator (target × source, columns summing to 1), all
        other axes riding along.
        """
        return self.replace(solid=jnp.moveaxis(jnp.tensordot(operator, self.solid, axes=([1], [1])), 0, 1))

    def at_enthalpy(self, enthalpy_flow: Any, guess: Any = None) -> Stream:
        """The same matter at the temperature that gives an enthalpy flow (W)."""
        scale = jnp.maximum(self.mass_flow, 1e-300) * 1e3  # makes the residual a temperature
        flows = self._by_phase()  # summed over the classes before the search
        root = find_root(
            lambda T: (self._enthalpy(flows, T) - enthalpy_flow) / scale,
            COLDEST,
            HOTTEST,
            start=self.temperature if guess is None else guess,
        )
        return self.replace(temperature=jnp.where(self.mass_flow > 0, root.value, self.temperature))

    def heated(self, duty: Any) -> Stream:
        """The same matter after taking up heat (W)."""
        return self.at_enthalpy(self.enthalpy_flow + duty)

    def __add__(self, other: Stream) -> Stream:
        """Adiabatic mixing at the lower of the two pressures."""
        if self.mixture != other.mixture:
            raise InputError(_("Streams of different mixtures cannot be added."))
        joined = self.replace(
            solid=self.solid + other.solid,
            liquid=self.liquid + other.liquid,
            gas=self.gas + other.gas,
            pressure=jnp.minimum(self.pressure, other.pressure),
        )
        a, b = self.mass_flow, other.mass_flow
        guess = (a * self.temperature + b * other.temperature) / jnp.where(a + b > 0, a + b, 1.0)
        return joined.at_enthalpy(self.enthalpy_flow + other.enthalpy_flow, guess=guess)


def settled(enthalpy_flow: Any, *parts: Stream) -> tuple[Stream, ...]:
    """Parts of one temperature at that at which they hold an enthalpy together (W): where a liquid with a
    heat of mixing was parted into stronger and weaker ones, another than that of the whole.
    """
    if parts[0].mixture.mixing is None:
        return parts
    scale = jnp.maximum(sum(part.mass_flow for part in parts), 1e-300) * 1e3
    root = find_root(
        lambda T: (sum(part.enthalpy_at(T) for part in parts) - enthalpy_flow) / scale,
        COLDEST,
        HOTTEST,
        start=parts[0].temperature,
    )
    return tuple(part.replace(temperature=root.value) for part in parts)


def empty(mixture: Mixture, temperature: Any = 298.15, pressure: Any = STANDARD_ATMOSPHERE) -> Stream:
    """A stream with nothing in it."""
    return Stream(
        # zeros of NumPy, which no compiler is asked for
        solid=jnp.asarray(np.zeros(mixture.solid_shape), dtype=float),
        liquid=jnp.asarray(np.zeros(len(mixture.liquids)), dtype=float),
        gas=jnp.asarray(np.zeros(len(mixture.gases)), dtype=float),
        temperature=jnp.asarray(temperature, dtype=float),
        pressure=jnp.asarray(pressure, dtype=float),
        mixture=mixture,
    )


def _mean_density(flows: Any, densities: Any) -> Any:
    """Density of what flows, component volumes being additive; of the first species when nothing does."""
    flow = jnp.sum(flows)
    some = flow > 0
    return jnp.where(some, flow / jnp.where(some, jnp.sum(flows / densities), 1.0), densities[0])


def median_of(masses: Any, edges: Any) -> Any:
    """Size that halves the mass of the classes, m: straight over the logarithm of size, over size itself in a
    class that starts at 0; 0 without mass.
    """
    below = jnp.append(0.0, jnp.cumsum(masses))
    half, edges = 0.5 * below[-1], jnp.asarray(edges)
    size = jnp.exp(jnp.interp(half, below, jnp.log(jnp.where(edges > 0.0, edges, edges[1]))))
    from_zero = (edges[0] <= 0.0) & (half < below[1])
    size = jnp.where(from_zero, edges[1] * half / jnp.where(from_zero, below[1], 1.0), size)
    return jnp.where(below[-1] > 0.0, size, 0.0)


class Summary(NamedTuple):
    """What a table says of a stream, SI; the size is not a number where there is no solid."""

    solid_flow: Any
    liquid_flow: Any
    gas_flow: Any
    temperature: Any
    median_size: Any


@begun
def summary(stream: Stream) -> Summary:
    """Flows of the phases, temperature, mass median size."""
    some = stream.solid_flow >= jnp.maximum(1e-12 * stream.mass_flow, 1e-300)
    size = jnp.where(some, median_of(stream.size_fractions, stream.mixture.edges), jnp.nan)
    return Summary(stream.solid_flow, stream.liquid_flow, stream.gas_flow, stream.temperature, size)


def median_size(stream: Stream) -> float | None:
    """Mass median size of a stream's solid, m; None without solid."""
    size = float(summary(stream).median_size)
    return None if size != size else size


def main_phase(stream: Any) -> str:
    """``gas`` for a gas stream, ``solid`` for a cake or powder, else ``liquid``."""
    solid, liquid, gas, *_rest = (float(x) for x in summary(stream))
    if gas > 0.5 * (solid + liquid + gas):
        return "gas"
    return "solid" if solid > 0.5 * (solid + liquid) else "liquid"
