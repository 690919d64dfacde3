"""Salts that exchange their ions: which liquids of a mixture make a sparingly soluble solid of it, and the
ions as the components that are then conserved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from granum.core.compiling import once
from granum.core.errors import InputError
from granum.materials.ions import Ions, ions_of
from granum.materials.library import Library
from granum.materials.salts import Salt
from granum.streams.mixture import Species

STANDARD = 298.15  # K, of heats of dissolution


class Exchange(NamedTuple):
    """``cation salt + anion salt → solid + byproduct``: places among the liquids, kg of each per mole of the
    solid, with that of the solvent bound in it; charges (amount times charge squared) of the byproduct.
    """

    salt: Salt
    cation_source: int
    anion_source: int
    byproduct: int
    cation_mass: float
    anion_mass: float
    byproduct_mass: float
    anhydrous_mass: float
    water_mass: float


def salt_of(known: Library, solid: str) -> tuple[Salt, Ions] | None:
    """The sparingly soluble salt that a solid of the library is, with its ions."""
    try:
        formula = known.solid(solid).formula
        ions = ions_of(formula)
        return None if ions is None else (known.salt(formula), ions)
    except InputError:
        return None


def exchanges(
    known: Library, solid: str, liquids: Sequence[str], formulas: Mapping[str, str]
) -> list[Exchange]:
    """The exchanges of ions by which liquids of a mixture can make a solid."""
    found = salt_of(known, solid)
    if found is None:
        return []
    salt, made = found
    dissolved = {name: ions for name, formula in formulas.items() if (ions := ions_of(formula)) is not None}
    out = []
    for first, one in dissolved.items():
        for second, other in dissolved.items():
            if one.cation != made.cation or other.anion != made.anion or one.anion == made.anion:
                continue
            for third, rest in dissolved.items():
                if (rest.cation, rest.anion) != (other.cation, one.anion):
                    continue
                moles = made.cation_count / one.cation_count, made.anion_count / other.anion_count
                left = moles[1] * other.cation_count / rest.cation_count
                out.append(
                    Exchange(
                        salt,
                        liquids.index(first),
                        liquids.index(second),
                        liquids.index(third),
                        moles[0] * one.anhydrous_mass,
                        moles[1] * other.anhydrous_mass,
                        left * rest.anhydrous_mass,
                        made.anhydrous_mass,
                        made.water_mass,
                    )
                )
    return out


def reciprocal(names: Sequence[str], formulas: Mapping[str, str]) -> dict[str, float]:
    """The four salts of two cations and two anions among liquids, with how many moles of each are made when
    the ions of two are exchanged; none where they are not all there.
    """
    ions = {name: found for name in names if (found := ions_of(formulas.get(name, ""))) is not None}
    cations = list(dict.fromkeys(i.cation for i in ions.values()))
    anions = list(dict.fromkeys(i.anion for i in ions.values()))
    if len(ions) != 4 or len(cations) != 2 or len(anions) != 2:
        return {}
    signs = {(c, a): (-1.0) ** (i + j) for i, c in enumerate(cations) for j, a in enumerate(anions)}
    if {(i.cation, i.anion) for i in ions.values()} != set(signs):
        return {}
    return {n: signs[i.cation, i.anion] / (i.cation_count * i.cation_charge) for n, i in ions.items()}


def additive(
    liquids: Sequence[Species], four: Mapping[str, float], formulas: Mapping[str, str]
) -> Sequence[Species]:
    """The liquids with heat capacities of four salts that are sums over their ions, so that no heat depends
    on which salts a solution of the ions is counted as; all four are shifted alike, by mole of charge.
    """
    if not four:
        return liquids
    masses = {n: i.anhydrous_mass for n in four if (i := ions_of(formulas[n])) is not None}
    curves = {s.name: np.polynomial.Polynomial(s.heat_capacity) for s in liquids if s.name in four}
    off = sum(four[n] * masses[n] * curves[n] for n in four) / len(four)
    shifted = {n: curves[n] - off / (four[n] * masses[n]) for n in four}
    return [replace(s, heat_capacity=tuple(shifted[s.name].coef)) if s.name in four else s for s in liquids]


def by_ions(
    known: Library, solids: Sequence[Species], liquids: Sequence[Species], formulas: Mapping[str, str]
) -> tuple[tuple[Species, ...], tuple[Species, ...]]:
    """Solids and liquids with their ions as components, where some liquids can make a solid by exchanging
    them, or are the four salts of two cations and two anions; as they are where none can.
    The heat of dissolution places the solid.
    """
    names = [s.name for s in liquids]
    possible = {s.name: exchanges(known, s.name, names, formulas) for s in solids}
    four = reciprocal(names, formulas)
    if not any(possible.values()) and not four:
        return tuple(solids), tuple(liquids)
    liquids = additive(liquids, four, formulas)
    parts = {
        name: ions.shares for name, formula in formulas.items() if (ions := ions_of(formula)) is not None
    }

    def split(species: Species) -> Species:
        made: dict[str, float] = {}
        for name, share in species.composition:
            for part, inner in parts.get(name, ((name, 1.0),)):
                made[part] = made.get(part, 0.0) + share * inner
        return replace(species, composition=tuple(made.items()))

    def solid(species: Species) -> Species:
        ways = possible[species.name]
        found = salt_of(known, species.name)
        if not ways or found is None:
            return split(species)
        _salt, ions = found
        whole = ions.anhydrous_mass + ions.water_mass
        dry = tuple((name, share * ions.anhydrous_mass / whole) for name, share in ions.shares)
        wet = ((liquids[0].name, ions.water_mass / whole),) if ions.water_count else ()
        return replace(
            species,
            composition=dry + wet,
            molar_mass=whole,
            reference_enthalpy=species.reference_enthalpy
            + float(once(partial(_place, species, liquids, ways[0], whole))),
        )

    return tuple(map(solid, solids)), tuple(map(split, liquids))


def _place(species: Species, liquids: Sequence[Species], way: Exchange, whole: float) -> Any:
    """By how much a solid must lie elsewhere for its formation to give off the heat of dissolution, J/kg."""
    heat = way.salt.enthalpy_of_dissolution or 0.0
    taken = (
        (way.cation_source, way.cation_mass),
        (way.anion_source, way.anion_mass),
        (way.byproduct, -way.byproduct_mass),
        (0, way.water_mass),
    )
    before = sum(mass * liquids[place].enthalpy(STANDARD) for place, mass in taken)
    return (before - heat) / whole - species.enthalpy(STANDARD)
