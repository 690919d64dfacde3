"""Crystals in liquor that rises: which size it just carries."""

from __future__ import annotations

import math
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, unconverged
from granum.core.kinds import Density, DynamicViscosity, Length, PositiveNumber, Velocity, VoidFraction
from granum.numerics.roots import find_root
from granum.particles.formulas.hindered import settling_exponent_rowe
from granum.particles.formulas.terminal import terminal_velocity

FINEST, COARSEST = 1e-6, 0.05  # m, between which sizes that float are sought


class Upflow(eqx.Module):
    """Liquor that rises through crystals: velocity over the whole section (m/s), density and viscosity."""

    velocity: Any
    density: Any
    viscosity: Any

    def falls(self, size: Any, crystal: Any) -> tuple[Any, Any]:
        """Terminal velocity of a crystal, as of the sphere of its volume, and its exponent of hindrance."""
        d = size * (6.0 * crystal.volume_shape_factor / math.pi) ** (1.0 / 3.0)
        v = terminal_velocity.function(d, crystal.density, self.density, self.viscosity)
        v = jnp.maximum(v, 1e-30)  # crystals that rise never settle
        return v, settling_exponent_rowe.function(self.density * v * d / self.viscosity)

    def void_fraction(self, size: Any, crystal: Any) -> Any:
        """Void fraction at which crystals of a size float."""
        v, n = self.falls(size, crystal)
        return (self.velocity / v) ** (1.0 / n)

    def size_at(self, void_fraction: Any, crystal: Any) -> Any:
        """Size that floats at a void fraction, and whether there is one."""

        def misses(logarithm: Any) -> Any:
            v, n = self.falls(jnp.exp(logarithm), crystal)
            return jnp.log(v) + n * jnp.log(void_fraction) - jnp.log(self.velocity)

        root = find_root(misses, math.log(FINEST), math.log(COARSEST))
        return jnp.exp(root.value), root.converged


class _Solid(eqx.Module):
    density: Any
    volume_shape_factor: Any


@formula(
    source="richardson1954; rowe1987",
    title="Cut size of an upflow",
    equation=r"v_t(L, \rho_c, \rho_l, \eta)\,\varepsilon^{n} = U",
    output="cut_size",
    typical={
        "superficial_velocity": (1e-3, 0.05),
        "crystal_density": (1500.0, 2500.0),
        "liquid_density": (1000.0, 1300.0),
        "dynamic_viscosity": (5e-4, 3e-3),
        "void_fraction": (0.8, 0.99),
        "volume_shape_factor": (0.4, 1.0),
    },
    symbols={"cut_size": "L"},
)
def cut_size_upflow(
    superficial_velocity: Velocity,
    crystal_density: Density,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction = 0.999,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Length:
    """Size of the crystals that float in liquor that rises: smaller ones are carried up, larger ones fall.

    The settling velocity is that of the sphere of equal volume, hindered by its neighbors with Richardson and
    Zaki's law and the exponent of Rowe. It is the cut behind the baffle and in the elutriation leg of a
    draft-tube crystallizer; a real cut is not as sharp.

    >>> L = cut_size_upflow(
    ...     superficial_velocity="10 mm/s",
    ...     crystal_density=2110,
    ...     liquid_density=1200,
    ...     dynamic_viscosity="1 mPa*s",
    ... )
    >>> bool(100e-6 < L < 200e-6)
    True
    """
    upflow = Upflow(superficial_velocity, liquid_density, dynamic_viscosity)
    size, found = upflow.size_at(void_fraction, _Solid(crystal_density, volume_shape_factor))
    unconverged(found)
    return size
