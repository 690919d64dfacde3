"""Recipes: the cooling program that keeps nucleation lowest, with exact gradients; the choice of a
process.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import scipy

from granum.core import procedure
from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MassRatio,
    Number,
    PositiveNumber,
    Ratio,
    Series,
    Temperature,
    Time,
    Within,
)
from granum.core.units import format_number
from granum.crystallization.formulas.programs import TemperaturePoints
from granum.crystallization.kinds import Growth, KineticDeviation, Nucleation, Solubility, Steps
from granum.crystallization.population.compiled import compiled
from granum.crystallization.population.lagrangian import Model, SuspensionVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.robust import Robustness, Scaled, guarded, reach
from granum.crystallization.vessels.batch import SEED_PACKETS, narrow_seeds
from granum.crystallization.vessels.crystals import Crystal


class CoolingRecipe(NamedTuple):
    """Best cooling program, and what it gains over linear cooling."""

    time: Annotated[Time, Series("points")]
    temperature: Annotated[Temperature, Series("points")]
    relative_supersaturation_maximum: Number
    nuclei_mass_fraction: Ratio
    nuclei_mass_fraction_linear: Ratio
    mean_diameter: Length
    relative_supersaturation_guarded: Number
    nuclei_mass_fraction_guarded: Ratio


@compiled
def _run(shares: Any, setting: tuple[Any, ...], steps: int) -> tuple[Any, Any, Any]:
    model, seeds, ratio, hot, cold, duration = setting
    knots = jnp.linspace(0.0, duration, shares.shape[0] + 1)
    temperature = hot - (hot - cold) * jnp.concatenate([jnp.zeros(1), jnp.cumsum(shares)])
    course = march(
        model,
        Programmed(TemperaturePoints(knots, temperature)),
        seeds,
        ratio,
        1.0,
        jnp.linspace(0.0, duration, steps + 1),
    )
    final = course.final
    low, high = final.low, final.high
    cubes = final.number * 0.25 * (low + high) * (low**2 + high**2)
    nuclei = jnp.sum(cubes[SEED_PACKETS:]) / jnp.sum(cubes)
    return nuclei, course.solute_per_solvent / course.solubility_per_solvent - 1.0, final.mean_size(4, 3)


@procedure(
    source="miller1994; chung1999; jones1974; nagy2004",
    title="Optimal cooling program of a seeded batch",
    typical={"duration": (3600.0, 7200.0)},
)
def optimal_cooling(
    solute_per_solvent: MassRatio,
    solubility: Solubility,
    growth: Growth,
    nucleation: Nucleation,
    temperature_start: Temperature,
    temperature_end: Temperature,
    duration: Time,
    crystal_density: Density,
    seed_mass_per_solvent: MassRatio,
    seed_size: Length,
    seed_width: Distance = 0.0,
    volume_shape_factor: PositiveNumber = 1.0,
    liquid_density: Density = 1000.0,
    relative_supersaturation_maximum: PositiveNumber = 1.0,
    intervals: Annotated[int, Within(1, 200)] = 12,
    steps: Steps = 200,
    growth_deviation: KineticDeviation = 0.0,
    nucleation_deviation: KineticDeviation = 0.0,
    guarded_probability: Annotated[Fraction, Within(0.5, 0.9999)] = 0.9,
    robustness: Robustness = "chance",
) -> CoolingRecipe:
    """Cooling program, straight by pieces and never rising, that leaves the least mass grown from nuclei at
    given start and end.

    The final temperature fixes the yield; the supersaturation is kept below a maximum. Gradients of the whole
    simulation are exact (SLSQP on the share of the temperature fall in each interval).

    Where rates are uncertain, give the relative standard deviation of growth and of nucleation: then the
    nuclei and each supersaturation on the way are those that are not exceeded with ``guarded_probability``
    (``chance``), or anywhere in the region that holds both rates with it (``worst case``), after Nagy and
    Braatz, with both ends of each range in place of slopes. Rates are taken as log-normal and not
    correlated; orders are as given.

    >>> recipe = optimal_cooling(
    ...     solute_per_solvent=0.492990,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 1.161167e-4, "growth_order": 1.32},
    ...     nucleation={
    ...         "law": "secondary_nucleation",
    ...         "nucleation_coefficient": 2.1959e8,
    ...         "nucleation_order": 1.78,
    ...     },
    ...     duration="80 min",
    ...     temperature_start=305.15,
    ...     temperature_end=301.15,
    ...     crystal_density=2110,
    ...     seed_mass_per_solvent=0.0005,
    ...     seed_size="100 um",
    ...     seed_width="20 um",
    ...     intervals=4,
    ...     steps=50,
    ... )
    >>> recipe.nuclei_mass_fraction < recipe.nuclei_mass_fraction_linear
    True
    """
    if temperature_end >= temperature_start:
        raise InputError(
            _("Cooling ends at {end} K, above its start at {start} K.").format(
                end=temperature_end, start=temperature_start
            ),
            name="temperature_end",
        )
    crystal = Crystal(crystal_density, volume_shape_factor)
    model = Model(solubility, growth, nucleation, crystal, SuspensionVolume(liquid_density))
    seeds = narrow_seeds(seed_size, seed_width, seed_mass_per_solvent, crystal.mass_per_cube)
    arrays = tuple(
        jnp.asarray(v, dtype=float)
        for v in (solute_per_solvent, temperature_start, temperature_end, duration)
    )
    setting = (model, seeds, *arrays)

    deviations = float(growth_deviation), float(nucleation_deviation)
    uncertain, times_guarded = any(deviations), reach(float(guarded_probability), robustness)

    def logs(q: Any, logarithms: Any) -> Any:
        """Logarithm of the nuclei and supersaturations, the rates being multiplied."""
        there = eqx.tree_at(
            lambda m: (m.growth, m.nucleation),
            model,
            tuple(Scaled(law, jnp.exp(logarithms[i])) for i, law in enumerate((growth, nucleation))),
        )
        nuclei, S, _size = _run(q, (there, *setting[1:]), steps)
        return jnp.concatenate([jnp.log(jnp.maximum(nuclei, 1e-30))[None], S[1:]])

    def figures(q: Any) -> Any:
        if uncertain:
            found = guarded(lambda x: logs(q, x), deviations, times_guarded)
            return found.at[0].set(jnp.exp(found[0]))
        nuclei, S, _size = _run(q, setting, steps)
        return jnp.concatenate([nuclei[None], S[1:]])

    value, slope = eqx.filter_jit(figures), eqx.filter_jit(jax.jacfwd(figures))
    memory: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}

    def both(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        key = np.asarray(q).tobytes()
        if key not in memory:
            memory.clear()
            memory[key] = np.asarray(value(jnp.asarray(q))), np.asarray(slope(jnp.asarray(q)))
        return memory[key]

    even = np.full(intervals, 1.0 / intervals)
    linear, at_linear, _size = _run(jnp.asarray(even), setting, steps)
    limit = float(relative_supersaturation_maximum)
    rules: list[dict[str, Any]] = [
        {"type": "eq", "fun": lambda q: np.sum(q) - 1.0, "jac": lambda q: np.ones((1, intervals))}
    ]
    if uncertain or float(jnp.max(at_linear)) > 0.2 * limit:
        rules.append(
            {
                "type": "ineq",
                "fun": lambda q: 1.0 - both(q)[0][1:] / limit,
                "jac": lambda q: -both(q)[1][1:] / limit,
            }
        )
    size = max(float(linear), 1e-30)
    start = np.diff(np.linspace(0.0, 1.0, intervals + 1) ** 2.0)
    found = scipy.optimize.minimize(
        lambda q: both(q)[0][0] / size,
        start,
        jac=lambda q: both(q)[1][0] / size,
        bounds=[(0.0, 1.0)] * intervals,
        constraints=rules,
        method="SLSQP",
        options={"maxiter": 200, "ftol": 1e-7},
    )
    if not found.success:
        raise ConvergenceError(
            _(
                "No cooling program was found: {reason}. Is the allowed supersaturation too low for the time?"
            ).format(reason=found.message),
            last=found.x,
        )
    shares = np.clip(found.x, 0.0, None) / np.sum(np.clip(found.x, 0.0, None))
    nuclei, S, mean = _run(jnp.asarray(shares), setting, steps)
    times = np.linspace(0.0, float(duration), intervals + 1)
    temperature = temperature_start - (temperature_start - temperature_end) * np.concatenate(
        [[0.0], np.cumsum(shares)]
    )
    kept = both(shares)[0]
    return CoolingRecipe(
        times,
        temperature,
        float(jnp.max(S)),
        float(nuclei),
        float(linear),
        float(mean),
        float(np.max(kept[1:])),
        float(kept[0]),
    )


Downstream = Literal["dryer", "centrifuge", "reaction"]


class Processes(NamedTuple):
    """Ways to crystallize, best first."""

    crystallization_process: Annotated[str, Series("processes")]
    suitability: Annotated[Fraction, Series("processes")]
    speaks_for: Annotated[str, Series("processes")]
    speaks_against: Annotated[str, Series("processes")]


TONNAGE_CONTINUOUS = 10_000.0 / 86_400.0  # kg/s: 10 t/d
# Relative change of solubility per kelvin. In the course notes potassium nitrate (2.8 %/K from 20 to 80 °C)
# is cooled, copper sulfate (1.7 %/K) cooled under vacuum, sodium chloride (0.1 %/K) boiled down.
STEEP, FLAT = 0.03, 0.0015
FLASHED = 0.0015  # of the solvent that boils off per kelvin of adiabatic cooling: 3.6 over 2400 kJ/kg


@procedure(
    source="mullin2001, ch. 8; garside1985",
    title="Choice of a crystallization process",
    typical={"crystal_flow": (0.01, 1.0)},
)
def choose(
    solubility: Solubility,
    temperature_hot: Temperature,
    temperature_cold: Temperature,
    crystal_flow: MassFlow,
    antisolvent_available: bool = False,
    fouling: bool = False,
    heat_sensitive: bool = False,
    narrow_sizes: bool = False,
    solvent_hazardous: bool = False,
    downstream: Downstream = "dryer",
) -> Processes:
    """Ways to crystallize by solubility slope, tonnage, fouling, hazard and quality, the best first, with
    what speaks for and against each.

    Steep solubility asks for cooling, a flat one for evaporation, one in between for vacuum cooling, which
    adds the evaporation of some 0.15 % of the solvent per kelvin to an incomplete cooling crop; below about
    10 t/d a batch, above it continuous operation. A hazardous solvent (flammable or toxic) is better not
    boiled, nor doubled. Crystals for a centrifuge must be coarse, and what is dissolved again (reaction) need
    not be.

    >>> best = choose(
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    ...     temperature_hot="80 degC",
    ...     temperature_cold="20 degC",
    ...     crystal_flow="20 tonne/day",
    ... )
    >>> best.crystallization_process[0]
    'cooling through a wall, continuous'
    """
    if temperature_hot <= temperature_cold:
        raise InputError(_("The hot temperature must be above the cold one."), name="temperature_hot")
    hot, cold = (
        float(np.asarray(solubility(temperature_hot))),
        float(np.asarray(solubility(temperature_cold))),
    )
    crop = 1.0 - cold / hot
    slope = np.log(hot / cold) / (temperature_hot - temperature_cold)
    shown = _("Solubility {cold} → {hot} kg/kg: cooling alone gives {crop} %.").format(
        cold=format_number(cold, 3), hot=format_number(hot, 3), crop=format_number(100 * crop, 2)
    )
    boiled = FLASHED * (temperature_hot - temperature_cold)
    vacuum_crop = 1.0 - (1.0 - boiled) * cold / hot
    flashed = _(
        "It also boils off {boiled} % of the solvent: the crop rises from {crop} to {more} %."
    ).format(
        boiled=format_number(100 * boiled, 2),
        crop=format_number(100 * crop, 2),
        more=format_number(100 * vacuum_crop, 2),
    )
    closed = _("Vapor of a hazardous solvent must be condensed wholly, with no air drawn in.")
    coarse = downstream == "centrifuge"
    steep = float(np.clip((slope - FLAT) / (STEEP - FLAT), 0.0, 1.0))
    between = 1.0 - abs(2.0 * steep - 1.0)
    tonnage = _(
        "{rate} t/d against about 10 t/d, below which lines of continuous crystallizers clog."
    ).format(rate=format_number(crystal_flow * 86.4, 3))
    large = crystal_flow >= TONNAGE_CONTINUOUS
    # each with its mark, what speaks for it and what against
    modes = [
        (
            _("cooling through a wall"),
            0.2 + 0.8 * steep - 0.35 * fouling,
            [shown, _("Lowest energy: sensible heat only.")] if steep > 0.5 else [],
            [
                _("The wall would foul: keep it within a few kelvin of the suspension.") if fouling else "",
                "" if steep > 0.5 else f"{shown} {_('The yield is low for its energy.')}",
            ],
        ),
        (
            _("vacuum (adiabatic) cooling"),
            0.2
            + 0.35 * steep
            + 0.4 * between
            + 0.3 * fouling
            + 0.1 * heat_sensitive
            - 0.25 * solvent_hazardous,
            [
                shown,
                flashed,
                _("The wall fouls: no cooled surface in a vacuum crystallizer.") if fouling else "",
                _("Boils well below what the substance does not stand.") if heat_sensitive else "",
            ],
            [closed if solvent_hazardous else ""],
        ),
        (
            _("evaporation"),
            0.9 - 0.8 * steep - 0.15 * heat_sensitive - 0.15 * solvent_hazardous,
            ["" if steep > 0.5 else shown],
            [
                _("Needs the latent heat of all the solvent; under vacuum for what does not stand heat."),
                closed if solvent_hazardous else "",
            ],
        ),
        (
            _("antisolvent"),
            (0.35 + 0.3 * (1 - steep) + 0.25 * heat_sensitive - 0.1 * solvent_hazardous - 0.1 * coarse)
            * antisolvent_available,
            [_("Works cold and gives high yields.")] if antisolvent_available else [],
            [
                _("The solvents must be separated afterwards.")
                if antisolvent_available
                else _("No miscible antisolvent is available."),
                _("Often fine crystals, which a centrifuge lets through.") if coarse else "",
                _("Two solvents to keep closed, and one of them distilled.") if solvent_hazardous else "",
            ],
        ),
    ]
    operations = [
        (_("continuous"), 0.9 if large else 0.25, [tonnage] if large else [], [] if large else [tonnage]),
        (
            _("seeded batch"),
            0.35 if large else 0.95,
            [
                "" if large else tonnage,
                _("Seeding and programmed cooling control the size.") if narrow_sizes else "",
            ],
            [tonnage] if large else [],
        ),
        (
            _("fluidized bed (Oslo), classified product"),
            (0.95 if narrow_sizes else 0.85 if coarse else 0.3 if downstream == "reaction" else 0.5)
            * (1.0 if large else 0.3),
            [
                _("Large and even crystals, growing without impellers.") if narrow_sizes else "",
                _("Coarse crystals leave a centrifuge dry and need little drying.") if coarse else "",
            ],
            [
                "" if large else tonnage,
                "" if narrow_sizes or coarse else _("Dearer than a stirred vessel."),
                _("What is dissolved again need not be coarse.") if downstream == "reaction" else "",
            ],
        ),
    ]
    rows = [
        (
            f"{mode}, {how}",
            float(np.clip(a, 0.0, 1.0) * b),
            *(" ".join(filter(None, x + y)) for x, y in ((good, more), (bad, worse))),
        )
        for mode, a, good, bad in modes
        for how, b, more, worse in operations
    ]
    rows.sort(key=lambda row: -row[1])
    columns: Any = list(zip(*rows, strict=True))
    return Processes(columns[0], np.asarray(columns[1], dtype=float), *columns[2:])
