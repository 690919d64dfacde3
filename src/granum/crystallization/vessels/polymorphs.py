"""Two crystal forms in one vessel: the less stable one dissolves while the stable one grows from the same
solution.

Each step solves one equation for the composition at its end: growth paths of both forms follow from it, and
the solute balance must give it back. A richer solution grows more crystals, so that the root is bracketed;
solute and crystals are conserved to rounding.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    Length,
    MassRatio,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
)
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, Program, Solubility, Steps
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.composition import Trial, settled
from granum.crystallization.population.packets import Packets, Seeds, mean_power
from granum.crystallization.vessels.batch import along, check_charge, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal


class PolymorphCourse(NamedTuple):
    """A batch with two crystal forms over time, per kg of solvent, and its product."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_per_solvent: Annotated[MassRatio, Series("points")]
    solubility_stable: Annotated[MassRatio, Series("points")]
    crystals_metastable: Annotated[MassRatio, Series("points")]
    crystals_stable: Annotated[MassRatio, Series("points")]
    stable_fraction: Annotated[Fraction, Series("points")]
    stable_fraction_end: Fraction
    mean_diameter_metastable: Distance
    mean_diameter_stable: Distance
    step_error: Ratio


class Form(eqx.Module):
    """One crystal form: its solubility, what its crystals do, and what each is."""

    solubility: Any
    growth: Any
    nucleation: Any
    dissolution: Any
    crystal: Crystal

    def rate(self, ratio: Any, saturated: Any, temperature: Any) -> Any:
        """Growth rate, negative for dissolution."""
        grows = self.growth(ratio, saturated, temperature)
        return grows - self.dissolution(ratio, saturated, temperature)


class _Both(eqx.Module):
    forms: tuple[Form, Form]
    liquid_density: Any
    cross_nucleation: Any

    def kinetics(self, c: Any, T: Any, mass: list[Any]) -> tuple[list[Any], list[Any]]:
        """Growth rates and births of both forms."""
        forms = self.forms
        volume = (1.0 + c) / self.liquid_density + sum(
            m / f.crystal.density for m, f in zip(mass, forms, strict=True)
        )
        magma = (mass[0] / volume, (mass[1] + self.cross_nucleation * mass[0]) / volume)
        saturated = [f.solubility(T) for f in forms]
        rates = [f.rate(c, s, T) for f, s in zip(forms, saturated, strict=True)]
        born = [volume * f.nucleation(c, s, T, m) for f, s, m in zip(forms, saturated, magma, strict=True)]
        return rates, born


class _Step(Trial):
    both: _Both
    crystals: tuple[Packets, Packets]
    mass: list[Any]
    before: list[Any]
    births: list[Any]
    temperature: Any
    span: Any
    total: Any

    def rates_before(self) -> list[Any]:
        return self.before

    def rates(self, ratio: Any) -> list[Any]:
        return self.both.kinetics(ratio, self.temperature, self.mass)[0]

    def after(self, ratio: Any, weights: list[Any]) -> tuple[list[Any], list[Any]]:
        """Growth paths and births of both forms."""
        later, more = self.both.kinetics(ratio, self.temperature, self.mass)
        paths = [
            self.span * ((1.0 - w) * a + w * b) for w, a, b in zip(weights, self.before, later, strict=True)
        ]
        return paths, [0.5 * self.span * (a + b) for a, b in zip(self.births, more, strict=True)]

    def left(self, ratio: Any, weights: list[Any]) -> Any:
        held = sum(
            form.crystal.mass_per_cube * (p.cubes_after(d) + n * mean_power(0.0, jnp.maximum(d, 0.0), 3))
            for form, p, d, n in zip(self.both.forms, self.crystals, *self.after(ratio, weights), strict=True)
        )
        return self.total - held


class _State(NamedTuple):
    crystals: tuple[Packets, Packets]
    ratio: Any


class _Row(NamedTuple):
    temperature: Any
    ratio: Any
    saturated: Any
    masses: Any
    sizes: Any


@compiled
def transform(
    forms: tuple[Form, Form],
    seeds: tuple[Seeds, Seeds],
    program: Any,
    ratio: Any,
    times: Any,
    liquid_density: Any,
    cross_nucleation: Any,
) -> _Row:
    """Follow both forms through given times, one kg of solvent; births of the second also count a share of
    the first.
    """
    times = jnp.asarray(times, dtype=float)
    steps = times.shape[0] - 1

    def room(seed: Seeds) -> Packets:
        low, high, number = (jnp.append(x, jnp.zeros(steps)) for x in (seed.low, seed.high, seed.number))
        return Packets(low, high, number)

    cubes = [form.crystal.mass_per_cube for form in forms]
    kept = [seed.low.shape[0] for seed in seeds]
    total = ratio + sum(c * s.moments()[3] for c, s in zip(cubes, seeds, strict=True))

    def masses(crystals: tuple[Packets, Packets]) -> list[Any]:
        return [c * p.moments()[3] for c, p in zip(cubes, crystals, strict=True)]

    def row(state: _State, T: Any) -> _Row:
        moments = [p.moments() for p in state.crystals]
        return _Row(
            T + jnp.zeros(()),
            state.ratio,
            jnp.stack([f.solubility(T) + jnp.zeros(()) for f in forms]),
            jnp.stack(masses(state.crystals)),
            jnp.stack([jnp.where(m[3] > 0, m[4] / jnp.where(m[3] > 0, m[3], 1.0), 0.0) for m in moments]),
        )

    def advance(state: _State, given: tuple[Any, Any, Any]) -> tuple[_State, _Row]:
        start, end, index = given
        T, mass = program(end), masses(state.crystals)
        both = _Both(forms, liquid_density, cross_nucleation)
        rates, births = both.kinetics(state.ratio, program(start), mass)
        step = _Step(both, state.crystals, mass, rates, births, T, end - start, total)
        c, weights = settled(step, state.ratio, total)
        paths, born = step.after(c, weights)
        grown = tuple(
            p.grown(d, n, 0.0, k + index)
            for p, d, n, k in zip(state.crystals, paths, born, kept, strict=True)
        )
        new = _State((grown[0], grown[1]), total - sum(masses((grown[0], grown[1]))))
        return new, row(new, T)

    first = _State((room(seeds[0]), room(seeds[1])), jnp.asarray(ratio, dtype=float))
    _last, rows = lax.scan(advance, first, (times[:-1], times[1:], jnp.arange(steps)))
    begin = row(first, program(times[0]))
    return jax.tree.map(lambda a, b: jnp.concatenate([jnp.asarray(a)[None], b]), begin, rows)


@procedure(
    source="cardew1985; ono2004; schoell2006",
    title="Batch with two polymorphs (solvent-mediated transformation)",
    typical={"duration": (3600.0, 36000.0)},
)
def polymorph_batch(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    solubility_law_stable: Solubility,
    growth: Growth,
    growth_stable: Growth,
    dissolution: Dissolution,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    nucleation_stable: Nucleation = NoNucleation(),
    cross_nucleation: Ratio = 0.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
    seed_mass_stable: MassRatio = 0.0,
    seed_size_stable: Length = 50e-6,
    volume_shape_factor: PositiveNumber = 1.0,
    volume_shape_factor_stable: PositiveNumber = 1.0,
    liquid_density: Density = 1000.0,
    steps: Steps = 400,
) -> PolymorphCourse:
    """Concentration and both crystal forms of one substance over time: the metastable form dissolves while
    the stable one is born and grows.

    Where dissolving is the faster, the concentration stays at the solubility of the metastable form until
    that has gone; where growing is, it falls to that of the stable form at once (Cardew and Davey). Births of
    the stable form count its own magma and, with ``cross_nucleation``, a share of the other's. Both forms
    have one density and hold no solvent; they dissolve by one law.

    >>> out = polymorph_batch(
    ...     solute_per_solvent=0.02,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.02]},
    ...     solubility_law_stable={"law": "polynomial_solubility", "coefficients": [0.015]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     growth_stable={"law": "power_law_growth", "growth_coefficient": 1e-7, "growth_order": 1.0},
    ...     dissolution={"law": "power_law_dissolution", "dissolution_coefficient": 1e-5},
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 298.15,
    ...         "temperature_end": 298.15,
    ...         "duration": 3600,
    ...     },
    ...     duration="8 hour",
    ...     crystal_density=1540,
    ...     seed_mass_per_solvent=0.01,
    ...     seed_mass_stable=0.001,
    ...     steps=100,
    ... )
    >>> bool(out.stable_fraction_end > 0.9)
    True
    """
    temperatures = along(temperature_program, duration)
    for law in (solubility, solubility_law_stable):
        check_charge(seed_size, seed_width, steps, solute_per_solvent, law, temperatures)
    gaps = np.array([float(solubility(T)) - float(solubility_law_stable(T)) for T in temperatures])
    if (gaps <= 0.0).all():
        raise InputError(
            _(
                "The stable form dissolves more than the other at every temperature of the batch: change "
                "the two solubilities round."
            ),
            name="solubility_law_stable",
        )
    shapes = (volume_shape_factor, volume_shape_factor_stable)
    one, other = (Crystal(crystal_density, shape) for shape in shapes)
    forms = (
        Form(solubility, growth, nucleation, dissolution, one),
        Form(solubility_law_stable, growth_stable, nucleation_stable, dissolution, other),
    )
    seeds = (
        narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, one.mass_per_cube),
        narrow_seeds(seed_size_stable, 0.0, seed_mass_stable, other.mass_per_cube),
    )
    steps += steps % 2
    times, index = jnp.linspace(0.0, duration, steps + 1), np.arange(steps + 1)
    # the coarse run takes every second step with zero length, so that both are one compiled program
    fine, coarse = (
        transform(forms, seeds, temperature_program, solute_per_solvent, t, liquid_density, cross_nucleation)
        for t in (times, times[index + index % 2])
    )
    crystals = np.asarray(fine.masses)
    every = np.maximum(crystals.sum(axis=1), 1e-300)
    share = crystals[:, 1] / every
    apart = np.abs(np.asarray(fine.masses)[-1] - np.asarray(coarse.masses)[-1]).max() / every[-1]
    return PolymorphCourse(
        times,
        fine.temperature,
        fine.ratio,
        fine.saturated[:, 0],
        fine.saturated[:, 1],
        crystals[:, 0],
        crystals[:, 1],
        share,
        float(share[-1]),
        float(fine.sizes[-1, 0]),
        float(fine.sizes[-1, 1]),
        float(apart) / 3.0,
    )
