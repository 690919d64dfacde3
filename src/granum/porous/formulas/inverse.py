"""Packed beds turned round: pressure drop of a bed, and velocity, particle size or porosity from it, under
any law.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, impossible, unconverged
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Law,
    Length,
    PressureDrop,
    Speed,
    Sphericity,
    VoidFraction,
)
from granum.numerics import find_root
from granum.porous.formulas.packed_beds import pressure_gradient_ergun

AT_REST = "Without flow a bed cannot be told from its pressure drop."

BedLaw = Annotated[Any, Law("pressure_gradient")]
LOGIT = 16.0  # porosities searched: 1e-7 to 1 − 1e-7


@formula(
    source="ergun1952; macdonald1979",
    title="Pressure drop of a packed bed",
    equation=r"\Delta p = L\,\frac{\mathrm dp}{\mathrm dz}(U, d_p, \varepsilon, \rho_f, \eta)",
)
def pressure_drop_packed_bed(
    superficial_velocity: Speed,
    length: Length,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> PressureDrop:
    """Pressure drop of a packed bed under any law, for a liquid or a gas whose density hardly changes.

    >>> round(
    ...     pressure_drop_packed_bed(
    ...         superficial_velocity=1e-3,
    ...         length=1.0,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     2,
    ... )
    1338.87
    """
    gradient = pressure_gradient(
        superficial_velocity, particle_diameter, void_fraction, fluid_density, dynamic_viscosity, sphericity
    )
    return length * gradient


@formula(
    source="ergun1952; macdonald1979",
    title="Superficial velocity in a packed bed",
    equation=r"\frac{\mathrm dp}{\mathrm dz}(U; d_p, \varepsilon, \rho_f, \eta) = \frac{\Delta p}{L}",
    typical={"length": (0.1, 2.0)},
)
def superficial_velocity_packed_bed(
    pressure_drop: PressureDrop,
    length: Length,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> Speed:
    """Superficial velocity that a pressure drop drives through a packed bed under any law.

    >>> round(
    ...     superficial_velocity_packed_bed(
    ...         pressure_drop=1338.8671875,
    ...         length=1.0,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     9,
    ... )
    0.001
    """
    d, e, rho, eta = sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    wanted = pressure_drop / length
    creeping = wanted * e**3 * d**2 / (150.0 * eta * (1.0 - e) ** 2)
    turbulent = jnp.sqrt(wanted * e**3 * d / (1.75 * rho * (1.0 - e)))
    start = jnp.log(1.0 / (1.0 / creeping + 1.0 / turbulent))

    def balance(y: Any) -> Any:
        return jnp.log(pressure_gradient(jnp.exp(y), particle_diameter, e, rho, eta, sphericity)) - jnp.log(
            wanted
        )

    root = find_root(balance, start - 12.0, start + 12.0, start=start)
    unconverged(root.converged)
    U = jnp.exp(root.value)
    pressure_gradient(U, particle_diameter, e, rho, eta, sphericity)  # for its flags
    return U


@formula(
    source="ergun1952; macdonald1979",
    title="Particle diameter from a packed bed",
    equation=r"\frac{\mathrm dp}{\mathrm dz}(d_p; U, \varepsilon, \rho_f, \eta) = \frac{\Delta p}{L}",
    typical={"length": (0.1, 2.0)},
)
def particle_diameter_packed_bed(
    superficial_velocity: Speed,
    pressure_drop: PressureDrop,
    length: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> Length:
    """Particle diameter of the bed that has a given pressure drop at a given velocity, under any law.

    >>> round(
    ...     1e6
    ...     * particle_diameter_packed_bed(
    ...         superficial_velocity=1e-3,
    ...         pressure_drop=1338.8671875,
    ...         length=1.0,
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     4,
    ... )
    800.0
    """
    U, e, rho, eta = superficial_velocity, void_fraction, fluid_density, dynamic_viscosity
    wanted = pressure_drop / length
    flows = U > 0.0
    impossible(~flows, U, "superficial_velocity", reason=AT_REST)
    speed = jnp.where(flows, U, 1.0)
    creeping = jnp.sqrt(150.0 * eta * speed * (1.0 - e) ** 2 / (wanted * e**3))
    turbulent = 1.75 * rho * speed**2 * (1.0 - e) / (wanted * e**3)
    start = jnp.log((creeping + turbulent) / sphericity)

    def balance(y: Any) -> Any:
        return jnp.log(pressure_gradient(speed, jnp.exp(y), e, rho, eta, sphericity)) - jnp.log(wanted)

    root = find_root(balance, start - 12.0, start + 12.0, start=start)
    unconverged(root.converged)
    d = jnp.exp(root.value)
    pressure_gradient(speed, d, e, rho, eta, sphericity)
    return jnp.where(flows, d, jnp.nan)


@formula(
    source="ergun1952; macdonald1979",
    title="Void fraction from a packed bed",
    equation=r"\frac{\mathrm dp}{\mathrm dz}(\varepsilon; U, d_p, \rho_f, \eta) = \frac{\Delta p}{L}",
    typical={"pressure_drop": (1e3, 1e5)},
)
def void_fraction_packed_bed(
    superficial_velocity: Speed,
    pressure_drop: PressureDrop,
    length: Length,
    particle_diameter: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    pressure_gradient: BedLaw = pressure_gradient_ergun,
) -> VoidFraction:
    """Porosity of the bed that has a given pressure drop at a given velocity, under any law.

    >>> round(
    ...     void_fraction_packed_bed(
    ...         superficial_velocity=1e-3,
    ...         pressure_drop=1338.8671875,
    ...         length=1.0,
    ...         particle_diameter="0.8 mm",
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     6,
    ... )
    0.4
    """
    wanted = pressure_drop / length
    flows = superficial_velocity > 0.0
    impossible(~flows, superficial_velocity, "superficial_velocity", reason=AT_REST)
    speed = jnp.where(flows, superficial_velocity, 1.0)

    def porosity(y: Any) -> Any:
        return 1.0 / (1.0 + jnp.exp(-y))

    def balance(y: Any) -> Any:
        gradient = pressure_gradient(
            speed, particle_diameter, porosity(y), fluid_density, dynamic_viscosity, sphericity
        )
        return jnp.log(gradient) - jnp.log(wanted)

    root = find_root(balance, -LOGIT, LOGIT, start=-0.4)
    unconverged(root.converged)
    e = porosity(root.value)
    pressure_gradient(speed, particle_diameter, e, fluid_density, dynamic_viscosity, sphericity)
    return jnp.where(flows, e, jnp.nan)
