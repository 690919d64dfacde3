"""Several salts of the library in one water, as ions: how far each of their crystals is from saturation, and
what is left in solution once they have formed.

The solubility of each salt alone is that of the library; what the ions do to each other comes from Pitzer's
equations.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.at_once import at_once
from granum.core.constants import GAS_CONSTANT
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.materials.activities import SLACK, ElectrolyteActivity
from granum.materials.correlation import Owner
from granum.materials.double_salts import DOUBLE_SALTS, DoubleSalt, in_salts
from granum.materials.formulas.activity import TERMS, WATER, debye_huckel_slope, over_temperature
from granum.materials.formulas.mixed_electrolytes import Coefficients, excess, log_activities
from granum.materials.ions import Ions, ions_of
from granum.materials.library import Library, session
from granum.materials.solids import Solid
from granum.materials.solutes import Branch, SoluteSystem
from granum.numerics.complementarity import find_complementary

SOLVENT = "water"
TRACE = 1e-10  # mol of each ion per kg of water, so that none is ever absent
BESIDE = 5.0  # K within a stable range from which the solubility product goes on beyond it
DRIEST = 0.999  # of the solvent, which never boils off wholly
LEAST = 2e-4  # of the water there is, which crystals and vapor always leave
FIRST = 3.0  # K of elevation, from which a boiling point is sought
NEAR = 0.5  # of the solubility of a salt alone, from which equilibrium is sought
# logarithms of a solubility beside others over the one alone, between which it is sought
SHARES = np.linspace(-8.0, 1.0, 37)
PASSES = 8  # of Newton's method between two of them


class Mixing(NamedTuple):
    """A coefficient of ions upon each other, a + bT + c/T and the further terms of Pitzer's coefficients over
    temperature, known from a source between two temperatures.
    """

    value: tuple[float, ...]
    source: str
    low: float = 273.15
    high: float = 373.15

    def at(self, T: Any) -> Any:
        return over_temperature(T, self.value)


ROOM = (288.15, 308.15)  # K, where coefficients for 25 °C are taken as they are
WARM = (288.15, 373.15)
MOLLER, GREENBERG = "moller1988, table 3", "greenberg1989, table 3"
KIM, PABALAN, HARVIE = "pitzer1974mixed", "pabalan1987", "harvie1984"
# as transcribed in the open-source package pytzer; the prints were not opened
THETA = {
    frozenset({"Na", "K"}): Mixing((-5.02312111e-2, 0.0, 14.0213141), GREENBERG),
    frozenset({"Na", "Mg"}): Mixing((0.07, 0.0, 0.0), PABALAN, *WARM),
    frozenset({"K", "Mg"}): Mixing((0.0, 0.0, 0.0), PABALAN, *WARM),
    frozenset({"Na", "Ca"}): Mixing((0.05, 0.0, 0.0), MOLLER),
    frozenset({"K", "Ca"}): Mixing((0.1156, 0.0, 0.0), GREENBERG),
    frozenset({"Mg", "Ca"}): Mixing((0.007, 0.0, 0.0), HARVIE, *ROOM),
    frozenset({"Cl", "SO4"}): Mixing((0.07, 0.0, 0.0), MOLLER),
    frozenset({"Cl", "NO3"}): Mixing((0.016, 0.0, 0.0), KIM, *ROOM),
}
PSI = {
    (frozenset({"Na", "K"}), "Cl"): Mixing((1.34211308e-2, 0.0, -5.10212917), GREENBERG),
    (frozenset({"Na", "K"}), "SO4"): Mixing((3.48115174e-2, 0.0, -8.21656777), GREENBERG),
    (frozenset({"Na", "K"}), "NO3"): Mixing((-0.0012, 0.0, 0.0), KIM, *ROOM),
    (frozenset({"Na", "Mg"}), "Cl"): Mixing((1.99e-2, 0.0, -9.51), PABALAN, *WARM),
    (frozenset({"Na", "Mg"}), "SO4"): Mixing((-0.015, 0.0, 0.0), PABALAN, *WARM),
    (frozenset({"K", "Mg"}), "Cl"): Mixing((2.586e-2, 0.0, -14.27), PABALAN, *WARM),
    (frozenset({"K", "Mg"}), "SO4"): Mixing((-0.048, 0.0, 0.0), HARVIE, *ROOM),
    (frozenset({"Na", "Ca"}), "Cl"): Mixing((-0.003, 0.0, 0.0), MOLLER),
    (frozenset({"K", "Ca"}), "Cl"): Mixing((4.76278977e-2, 0.0, -27.0770507), GREENBERG),
    (frozenset({"Mg", "Ca"}), "Cl"): Mixing((-0.012, 0.0, 0.0), HARVIE, *ROOM),
    (frozenset({"Cl", "SO4"}), "Na"): Mixing((-0.009, 0.0, 0.0), MOLLER),
    (frozenset({"Cl", "SO4"}), "K"): Mixing((-2.12481475e-1, 2.84698333e-4, 37.5619614), GREENBERG),
    (frozenset({"Cl", "NO3"}), "Na"): Mixing((-0.006, 0.0, 0.0), KIM, *ROOM),
    (frozenset({"Cl", "NO3"}), "K"): Mixing((-0.006, 0.0, 0.0), KIM, *ROOM),
}
# another set that was fitted together: beside magnesium it is taken in place of these
BITTER_THETA = {frozenset({"Cl", "SO4"}): Mixing((0.03, 0.0, 0.0), PABALAN, *WARM)}
BITTER_PSI = {
    (frozenset({"Cl", "SO4"}), "Mg"): Mixing((-1.174e-1, 0.0, 32.63), PABALAN, *WARM),
    (frozenset({"Cl", "SO4"}), "Na"): Mixing((0.0, 0.0, 0.0), PABALAN, *WARM),
    (frozenset({"Cl", "SO4"}), "K"): Mixing((-0.005, 0.0, 0.0), PABALAN, *WARM),
}


def _mixings(ions: Sequence[str]) -> tuple[dict[Any, Mixing], dict[Any, Mixing]]:
    """The coefficients of two like ions, and of these with an unlike one, of a solution of ions."""
    bitter = "Mg" in ions
    return (THETA | BITTER_THETA, PSI | BITTER_PSI) if bitter else (THETA, PSI)


class Forms(NamedTuple):
    """A crystal: mol of each salt, of each ion and of water in a mole; its branch of the solubility of one
    salt, or what is known of it as a double salt.
    """

    solid: Solid
    salts: tuple[float, ...]
    ions: tuple[int, ...]
    water: float
    branch: Branch | None = None
    double: DoubleSalt | None = None

    @property
    def name(self) -> str:
        """Of the crystal."""
        return self.solid.name

    @property
    def salt(self) -> int | None:
        """Which salt it is; none where it is a double salt."""
        return None if self.branch is None else self.salts.index(1.0)


class Equilibrium(NamedTuple):
    """Crystals (mol), the water that stays liquid (kg), molalities of the ions in it, what evaporates (kg),
    the temperature (K), and whether all this was found.
    """

    crystals: Any
    water: Any
    molalities: Any
    evaporated: Any
    temperature: Any
    found: Any


class Boiling(NamedTuple):
    """What makes a brine boil.

    gone: at a temperature, the kg of water that evaporate where so many mol of each crystal have formed.
    excess: how far the solution lies above its boiling point, from temperature, logarithm of the activity of
        water, and mass fraction of what is dissolved.
    most: the largest share of the water that evaporates.
    """

    gone: Callable[[Any, Any], Any]
    excess: Callable[[Any, Any, Any], Any]
    most: float


class Brine(eqx.Module):
    """Salts of one or two cations and one or two anions in water, in all their combinations."""

    salts: tuple[SoluteSystem, ...] = eqx.field(static=True)
    parts: tuple[Ions, ...] = eqx.field(static=True)
    ions: tuple[str, ...] = eqx.field(static=True)
    crystals: tuple[Forms, ...] = eqx.field(static=True)

    @property
    def molar_masses(self) -> np.ndarray:
        """Of the salts without water, kg/mol: sums over their ions, so that an exchange keeps the mass."""
        return np.array([p.anhydrous_mass for p in self.parts])

    @property
    def ions_per_salt(self) -> np.ndarray:
        """Mol of each ion (columns) in a mole of each salt (rows)."""
        table = np.zeros((len(self.salts), len(self.ions)))
        for row, p in enumerate(self.parts):
            table[row, self.ions.index(p.cation)] = p.cation_count
            table[row, self.ions.index(p.anion)] = p.anion_count
        return table

    @property
    def charges(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Charge numbers of cations and anions, without sign."""
        cations = {p.cation: p.cation_charge for p in self.parts}
        anions = {p.anion: -p.anion_charge for p in self.parts}
        split = len(cations)
        return tuple(cations[i] for i in self.ions[:split]), tuple(anions[i] for i in self.ions[split:])

    def _law(self, system: SoluteSystem) -> ElectrolyteActivity:
        """The water activity of a salt, by the coefficients that go with those of ions upon each other."""
        law = system.activity_law
        assert isinstance(law, ElectrolyteActivity)
        return law if law.beside is None or len(self.salts) == 1 else law.beside

    def coefficients(self, T: Any) -> Coefficients:
        """Of Pitzer's equations at a temperature."""
        split = len(self.charges[0])
        cations, anions = self.ions[:split], self.ions[split:]
        sets = np.zeros((len(cations), len(anions), 4, TERMS))
        fades = np.zeros((2, len(cations), len(anions)))
        ends = np.zeros((2, len(cations), len(anions), 1))
        for system, p in zip(self.salts, self.parts, strict=True):
            law, at = self._law(system), (cations.index(p.cation), anions.index(p.anion))
            sets[at], ends[0][at], ends[1][at] = (
                (law.beta_zero, law.beta_one, law.c_phi, law.beta_two),
                law.coldest,
                law.hottest,
            )
            fades[(slice(None), *at)] = law.exponents
        binary = over_temperature(jnp.clip(T, *ends), np.moveaxis(sets, -1, 0))

        theta, psi = _mixings(self.ions)

        def like(names: tuple[str, ...], others: tuple[str, ...]) -> tuple[Any, Any]:
            if len(names) < 2:
                return 0.0, jnp.zeros(len(others))
            pair = frozenset(names)
            return theta[pair].at(T), jnp.stack([psi[pair, other].at(T) for other in others])

        of_cations, of_anions = like(cations, anions), like(anions, cations)
        slope = debye_huckel_slope.function(T)
        zero, one, phi, two = (binary[..., k] for k in range(4))
        pairs = two if sets[..., 3, :].any() else 0.0
        return Coefficients(slope, zero, one, phi, *of_cations, *of_anions, pairs, fades)

    def mixings(self) -> list[Mixing]:
        """What is known of the ions upon each other."""
        ions, (theta, psi) = set(self.ions), _mixings(self.ions)
        pairs = [m for like, m in theta.items() if like <= ions]
        return pairs + [m for (like, other), m in psi.items() if like <= ions and other in ions]

    @property
    def limits(self) -> tuple[float, float]:
        """Temperatures between which all coefficients are known, K."""
        every = [*self.mixings(), *(c.double for c in self.crystals if c.double is not None)]
        return max((m.low for m in every), default=273.15), min((m.high for m in every), default=373.15)

    def heard(self, T: Any, molalities: Any) -> None:
        """Record where a temperature, or what there is of the ions of a salt, lies outside what is known."""
        T, (low, high) = jnp.asarray(T, dtype=float), self.limits
        outside = (low - SLACK > T) | (high + SLACK < T)
        sources = "; ".join(dict.fromkeys(m.source for m in self.mixings()))
        flags.record(flags.EXTRAPOLATED, outside, T, "temperature", "materials.brines", low, high, sources)
        counts = self.ions_per_salt
        there = jnp.min(
            jnp.where(counts > 0.0, molalities / np.where(counts > 0.0, counts, 1.0), jnp.inf), axis=1
        )
        for system, m in zip(self.salts, there, strict=True):
            law = self._law(system)
            beyond = m > law.most * (1.0 + 1e-3)
            owner = Owner.of_property(system.name, "water activity", system.french)
            flags.record(flags.EXTRAPOLATED, beyond, m, "salt_molality", owner, 0.0, law.most, law.source)

    @at_once()
    def water_activity(self, T: Any, molalities: Any) -> Any:
        """Activity of water over the solution."""
        m = jnp.maximum(molalities, TRACE)
        return jnp.exp(log_activities(m, self.charges, self.coefficients(T))[1])

    @at_once()
    def excess_enthalpy(self, T: Any, molalities: Any) -> Any:
        """Enthalpy of ions in a kilogram of water over that at infinite dilution, J: from the slope of their
        excess Gibbs energy with temperature.
        """
        m, T = jnp.maximum(molalities, TRACE), jnp.asarray(T, dtype=float)
        _value, slope = jax.jvp(
            lambda t: excess(m, self.charges, self.coefficients(t)), (T,), (jnp.ones_like(T),)
        )
        return -GAS_CONSTANT * T**2 * slope

    def _products(self, given: Coefficients, molalities: Any) -> tuple[Any, Any]:
        """Logarithm of the activity product of each crystal, and of the activity of water."""
        m = jnp.maximum(molalities, TRACE)
        log_gamma, log_water = log_activities(m, self.charges, given)
        bound = jnp.asarray([c.water for c in self.crystals])
        logs = jnp.asarray([c.ions for c in self.crystals]) @ (jnp.log(m) + log_gamma) + bound * log_water
        return logs, log_water

    def _log_saturated(self, T: Any) -> Any:
        """Logarithm of the solubility product of each crystal: of a double salt its own, else from the
        solubility of its salt alone; beyond the temperatures at which it is the stable crystal it goes on
        with the slope that it has there.
        """
        branches = [(c, c.branch) for c in self.crystals if c.branch is not None]
        low = np.array([b.stable_from for _c, b in branches])
        high = np.array([b.stable_to for _c, b in branches])
        end = jnp.clip(T, low, high)
        inside = jnp.where(low > T, low + BESIDE, high - BESIDE)
        temperatures = jnp.stack([end, inside])
        masses = self.molar_masses
        alone = [b.value(temperatures[:, k]) / masses[c.salt] for k, (c, b) in enumerate(branches)]
        m = jnp.stack(alone)[..., None] * jnp.asarray([c.ions for c, _b in branches], dtype=float)[:, None]

        def products(t: Any, m: Any) -> Any:
            return self._products(self.coefficients(t), m)[0]

        known = jax.vmap(jax.vmap(products))(temperatures.T, m)
        k = np.arange(len(branches))
        at_end, at_inside = known[k, 0, k], known[k, 1, k]
        beyond = jnp.where(end == T, 0.0, (1.0 / T - 1.0 / end) / (1.0 / end - 1.0 / inside))
        doubles = [c.double.log_product(T) for c in self.crystals if c.double is not None]
        return jnp.append(at_end + (at_end - at_inside) * beyond, jnp.asarray(doubles))

    @at_once()
    def saturation(self, T: Any, molalities: Any) -> Any:
        """Logarithm of the saturation ratio of each crystal, per ion: zero at saturation."""
        counts = jnp.asarray([sum(c.ions) for c in self.crystals])
        T = jnp.asarray(T, dtype=float)
        products, _log_water = self._products(self.coefficients(T), molalities)
        return (products - self._log_saturated(T)) / counts

    def alone(self, T: Any) -> Any:
        """Solubility of each salt alone, mol/kg."""
        return jnp.stack([s.value(T) / M for s, M in zip(self.salts, self.molar_masses, strict=True)])

    @at_once("crystal")
    def solubility(self, T: Any, others: Any, crystal: int) -> Any:
        """What dissolves of one crystal beside the ions of other salts (mol/kg), mol of its salt per kg of
        water; far more than alone of a hydrate that no liquor there is saturated with.
        """
        T, form = jnp.asarray(T, dtype=float), self.crystals[crystal]
        given, goal = self.coefficients(T), self._log_saturated(T)[crystal]
        part = jnp.asarray(form.ions, dtype=float)

        def excess(log_m: Any) -> Any:
            products, _log_water = self._products(given, others + jnp.exp(log_m) * part)
            return (products[crystal] - goal) / sum(form.ions)

        # a hydrate has two, as more salt takes its water away, or none: then it dissolves in any liquor
        tried = jnp.log(self.alone(T)[form.salt]) + SHARES
        over = jax.vmap(excess)(tried) >= 0.0
        first = jnp.argmax(over)
        low, high = jax.lax.stop_gradient((tried[jnp.maximum(first - 1, 0)], tried[first]))

        def step(_pass: Any, log_m: Any) -> Any:
            value, slope = jax.jvp(excess, (log_m,), (jnp.ones_like(log_m),))
            return jnp.clip(log_m - value / slope, low, high)

        found = jax.lax.fori_loop(0, PASSES, step, 0.5 * (low + high))
        return jnp.exp(jnp.where(jnp.any(over), found, tried[-1]))

    def equilibrium(
        self, T: Any, water: Any, ions: Any, which: Sequence[int], boiling: Boiling | None = None
    ) -> Equilibrium:
        """What crystallizes of the given crystals from water (kg) and ions (mol), all crystals counted as
        dissolved before; where it boils, at the boiling point, which is sought from a temperature below it.
        """
        T, some = jnp.asarray(T, dtype=float), jnp.asarray(water) > 0.0
        whole = jnp.where(some, water, 1.0)
        N = jnp.maximum(jnp.where(some, ions, 0.0), 0.0) / whole + TRACE
        forms, places = [self.crystals[k] for k in which], np.array(which, dtype=int)
        table = np.array([c.ions for c in forms], dtype=float).reshape(len(forms), len(self.ions))
        bound = WATER * np.array([c.water for c in forms])
        counts = np.array([sum(c.ions) for c in self.crystals])
        masses = 0.5 * np.abs(self.ions_per_salt.T) @ self.molar_masses

        def gone(t: Any, n: Any) -> Any:
            if boiling is None:
                return jnp.zeros(())
            return jnp.clip(boiling.gone(t, n * whole) / whole, 0.0, boiling.most)

        def split(x: Any) -> tuple[Any, Any, Any, Any]:
            t, n = (T, x) if boiling is None else (T + x[-1], x[:-1])
            evaporated = gone(t, n)
            return t, n, evaporated, 1.0 - evaporated - bound @ n

        def slack(x: Any) -> Any:
            t, n, _evaporated, liquid = split(x)
            m = (N - n @ table) / liquid
            products, log_water = self._products(self.coefficients(t), m)
            left = ((self._log_saturated(t) - products) / counts)[places]
            if boiling is None:
                return left
            dissolved = jnp.sum(m * masses)
            return jnp.append(left, boiling.excess(t, log_water, dissolved / (1.0 + dissolved)))

        def positive(x: Any) -> Any:
            _t, n, _evaporated, liquid = split(x)
            return jnp.append(N - n @ table, liquid - LEAST)

        start = self._begun(T, N, forms, 1.0 - gone(T, jnp.zeros(len(forms))))
        if boiling is not None:
            start = jnp.append(start, FIRST)
        found = find_complementary(slack, start, positive)
        t, n, evaporated, liquid = split(found.value)
        n = jnp.where(some, n, 0.0)
        return Equilibrium(
            n * whole,
            liquid * whole,
            jnp.maximum(N - TRACE - n @ table, 0.0) / liquid,
            evaporated * whole,
            t,
            ~some | (found.residual < 1e-9),
        )

    def _begun(self, T: Any, N: Any, forms: Sequence[Forms], liquid: Any) -> Any:
        """Crystals from which equilibrium is sought: they leave a solution that is not far from it."""
        alone, rest, made = self.alone(T), N, []
        for c in forms:
            # of several crystals of a salt the one with least water: the others would take up the solvent
            first = c.salt is not None and all(c.water <= o.water for o in forms if o.salt == c.salt)
            part = jnp.asarray(c.ions, dtype=float)
            there = jnp.min(jnp.where(part > 0.0, rest / jnp.where(part > 0.0, part, 1.0), jnp.inf))
            n = 1e-3 * there
            if first:
                n = jnp.maximum(there - NEAR * alone[c.salt] * liquid, n)
            if c.water:
                n = jnp.minimum(n, 0.5 * liquid / (WATER * c.water * len(forms)))
            rest = rest - n * part
            made.append(n)
        return jnp.stack(made) if made else jnp.zeros(0)


def known_salts() -> str:
    """The combinations of ions whose mixtures are known, in words."""
    pairs = [f"{'/'.join(sorted(like))} + {other}" for like, other in PSI | BITTER_PSI]
    return "; ".join(pairs)


def find_brine(names: Sequence[str], materials: Library | None = None) -> Brine | None:
    """The brine of solutes by name; None where one is no salt in water whose ions are known beside the
    others.
    """
    known = materials or session()
    return _brine(tuple(known.called(name, "solute") or name for name in names), known)


def brine(names: Sequence[str], materials: Library | None = None) -> Brine:
    """The same; a mixture that is not known is refused."""
    found = find_brine(names, materials)
    if found is None:
        raise InputError(
            _(
                "How {salts} act on each other in water is not known here; known are ions of the same sign "
                "beside another: {known}."
            ).format(salts=", ".join(names), known=known_salts())
        )
    return found


def salts_of_pairs() -> list[str]:
    """The salts of the library that are known beside another one, by name."""
    names = [system.name for system in salts_of_ions(session())]
    return [one for one in names if any(one != other and find_brine((one, other)) for other in names)]


@lru_cache(maxsize=64)
def _brine(names: tuple[str, ...], known: Library) -> Brine | None:
    given = [known.solute(name) for name in names if name in known.names("solute")]
    parts = {s.name: ions_of(s.formula) for s in given}
    if len(given) < len(names) or not given or any(p is None for p in parts.values()):
        return None
    cations = tuple(dict.fromkeys(p.cation for p in parts.values() if p))
    anions = tuple(dict.fromkeys(p.anion for p in parts.values() if p))
    mixed = [frozenset(like) for like in (cations, anions) if len(like) == 2]
    others = {frozenset(cations): anions, frozenset(anions): cations}
    theta, psi = _mixings(cations)
    if max(len(cations), len(anions)) > 2 or any(
        like not in theta or any((like, other) not in psi for other in others[like]) for like in mixed
    ):
        return None
    by_ions = {(p.cation, p.anion): s for s in salts_of_ions(known) if (p := ions_of(s.formula))}
    salts = list(given)
    for pair in ((c, a) for c in cations for a in anions):
        if pair not in by_ions:
            return None
        if not any(p and (p.cation, p.anion) == pair for p in parts.values()):
            salts.append(by_ions[pair])
    if not all(s.solvent.name == SOLVENT and isinstance(s.activity_law, ElectrolyteActivity) for s in salts):
        return None
    ions = (*cations, *anions)
    split = tuple(p for s in salts if (p := ions_of(s.formula)))
    crystals = []
    for k, (system, p) in enumerate(zip(salts, split, strict=True)):
        counts = {p.cation: p.cation_count, p.anion: p.anion_count}
        own = tuple(float(k == other) for other in range(len(salts)))
        for branch in system.branches:
            bound = float(branch.solvent_ratio) * float(system.molar_mass) / WATER
            made = tuple(counts.get(i, 0) for i in ions)
            crystals.append(Forms(branch.crystal, own, made, bound, branch))
    for name, double in DOUBLE_SALTS.items():
        parts = in_salts(split, double.ions)
        if parts is not None:
            made = tuple(double.ions.get(i, 0) for i in ions)
            crystals.append(Forms(known.solid(name), parts, made, double.water, None, double))
    return Brine(tuple(salts), split, ions, tuple(crystals))


@lru_cache(maxsize=8)
def salts_of_ions(known: Library) -> tuple[SoluteSystem, ...]:
    """Salts of the library of ions that are known beside others."""
    ions = frozenset().union(*THETA)
    return tuple(
        known.solute(name)
        for name, entry in sorted(known.entries("solute").items())
        if (p := ions_of(entry.formula))
        and {p.cation, p.anion} <= ions
        and known.entry("fluid", entry.solvent)[0] == SOLVENT
    )
