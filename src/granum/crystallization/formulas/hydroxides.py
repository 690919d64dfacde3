"""Hydroxides of metals: the pH at which they fall, and that of water which they saturate."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.flags import unconverged
from granum.core.kinds import Fraction, Molality, Number, PositiveNumber, Temperature, Within
from granum.materials.formulas.precipitation import (
    ROOM,
    activity_coefficient_davies,
    ionization_exponent_water,
)
from granum.numerics.roots import find_root

MetalMolality = Annotated[Molality, Within(1e-12, 20.0)]
Product = Annotated[PositiveNumber, Within(1e-60, 100.0)]
Hydroxides = Annotated[PositiveNumber, Within(1.0, 4.0)]
HIGHEST = 0.5  # mol/kg, up to which Davies' equation holds
LN10 = 2.302585092994046


class HydroxideRange(NamedTuple):
    """pH at which a hydroxide begins to fall, and at which all but a share of the metal has fallen."""

    ph_value_start: Number
    ph_value_end: Number


@formula(
    source="stumm1996, ch. 7",
    title="pH between which a hydroxide precipitates",
    equation=(
        r"\mathrm{pH}_1 = \mathrm{p}K_w + \tfrac{1}{q}\log_{10}\frac{K_{sp}}{\gamma_c m_c},\quad "
        r"\mathrm{pH}_2 = \mathrm{pH}_1 - \tfrac{1}{q}\log_{10}\varphi"
    ),
    output="precipitation_range",
    typical={
        "cation_molality": (1e-3, 0.5),
        "solubility_product": (1e-39, 1e-5),
        "anion_count": (2.0, 3.0),
        "residual_fraction": (1e-4, 1e-2),
        "ionic_strength": (0.0, 0.3),
    },
    fitted={"ionic_strength": (0.0, HIGHEST)},
)
def ph_precipitation_hydroxide(
    cation_molality: MetalMolality,
    solubility_product: Product,
    anion_count: Hydroxides = 2.0,
    residual_fraction: Annotated[Fraction, Within(1e-12, 1.0)] = 1e-3,
    ionic_strength: Molality = 0.0,
    temperature: Temperature = ROOM,
) -> HydroxideRange:
    """pH at which alkali begins to precipitate the hydroxide of a metal, and at which only a share of the
    metal is left.

    All ions are free: neither complexes with hydroxide, by which amphoteric metals (aluminum, zinc, chromium,
    lead) dissolve again beyond, nor basic salts, which often fall first. Fresh, amorphous hydroxides are more
    soluble than aged ones. Ideal at an ionic strength of zero, else by Davies. Magnesium of 1 mmol/kg with a
    product of 1e-11 begins at pH 10.

    >>> round(ph_precipitation_hydroxide(1e-3, 1e-11).ph_value_start, 2)
    10.0
    """
    strength = jnp.minimum(ionic_strength, HIGHEST)
    metal = activity_coefficient_davies.function(anion_count, strength, temperature)
    log = jnp.log(solubility_product) - jnp.log(metal * cation_molality)
    start = ionization_exponent_water.function(temperature) + log / (anion_count * LN10)
    return HydroxideRange(start, start - jnp.log10(residual_fraction) / anion_count)


class SaturatedHydroxide(NamedTuple):
    """Water that a hydroxide saturates."""

    ph_value: Number
    cation_molality: Molality


@formula(
    source="stumm1996, ch. 7; davies1962, ch. 3",
    title="pH of water saturated with a hydroxide",
    equation=(
        r"q\,m_c + m_H = m_{OH},\quad \gamma_c m_c\,(\gamma_1 m_{OH})^q = K_{sp},\quad "
        r"\gamma_1^2\,m_H m_{OH} = K_w"
    ),
    output="saturated_hydroxide",
    fitted={"ionic_strength": (0.0, HIGHEST)},
    typical={"solubility_product": (1e-39, 1e-5), "anion_count": (2.0, 3.0)},
)
def ph_saturated_hydroxide(
    solubility_product: Annotated[PositiveNumber, Within(1e-60, 1.0)],
    anion_count: Hydroxides = 2.0,
    temperature: Temperature = ROOM,
) -> SaturatedHydroxide:
    """pH of pure water over the hydroxide of a metal, by the balance of charges with water's own ions.

    Activities by Davies, kept beyond 0.5 mol/kg; without carbon dioxide of the air and without complexes.
    Saturated limewater, a standard of pH, has 12.45 (bates1956): complexes of calcium with
    hydroxide make it a little more alkaline than this. Water's own ions decide for iron(III): pH 7.

    >>> round(ph_saturated_hydroxide(5.61e-12).ph_value, 1)
    10.4
    """
    q, T = anion_count, temperature
    water = 10.0 ** -ionization_exponent_water.function(T)

    def ions(log_hydroxide: Number) -> tuple[Number, Number, Number, Number]:
        hydroxide = jnp.exp(log_hydroxide)
        ideal = water / hydroxide
        metal = jnp.maximum(hydroxide - ideal, 0.0) / q
        strength = jnp.minimum(0.5 * (q**2 * metal + hydroxide + ideal), HIGHEST)
        one, many = (activity_coefficient_davies.function(z, strength, T) for z in (1.0, q))
        logs = jnp.log(solubility_product) - jnp.log(many) - q * (jnp.log(one) + log_hydroxide)
        return hydroxide, water / (hydroxide * one**2), jnp.exp(jnp.minimum(logs, 50.0)), one

    def short(log_hydroxide: Number) -> Number:
        hydroxide, hydrogen, metal, _one = ions(log_hydroxide)
        return jnp.log((q * metal + hydrogen) / hydroxide)

    root = find_root(short, 0.5 * jnp.log(water) - 0.5, jnp.log(20.0))
    unconverged(root.converged)
    hydroxide, hydrogen, metal, one = ions(root.value)
    watch(ionic_strength=0.5 * (q**2 * metal + hydroxide + hydrogen))
    return SaturatedHydroxide(-jnp.log10(water / (one * hydroxide)), metal)
