"""Heat of mixing of solutions, over the enthalpies of their parts.

Elsewhere the enthalpies of solvent and solute add up, and diluting gives off no heat.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core.compiling import once
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.materials.activities import LEAST, ElectrolyteActivity
from granum.materials.formulas.activity import DISTANCE, SLOPE, fading, slope_over_temperature
from granum.materials.formulas.caustic import STRONGEST, caustic_enthalpy_olsson, specific_enthalpy
from granum.materials.ions import Ions
from granum.numerics.smooth import safe_divide

ROOM = 298.15
DILUTE = 1e-4  # mass fraction at which the solute is in much water
THINNEST = 1e-7


class CausticMixing(eqx.Module):
    """Of sodium hydroxide in water. ``heat_capacity`` is that by which the solute counts elsewhere, J/(kg K).

    Beyond the strongest solution that was measured a kilogram of solute keeps what it has there.
    """

    heat_capacity: float
    coldest, hottest = 273.15, 477.15
    others = True

    def __call__(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts (kg or kg/s) hold over their parts, J or W; nothing in much water at 25 °C."""
        total = solute + solvent
        w = jnp.clip(solute / jnp.where(total > 0.0, total, 1.0), THINNEST, STRONGEST)
        return solute * (self._apparent(temperature, w) - self._apparent(ROOM, DILUTE))

    def heard(self, temperature: Any, solute: Any, solvent: Any) -> None:
        """Flag a liquor outside the data."""
        caustic_enthalpy_olsson(temperature, safe_divide(solute, solute + solvent, 0.0))

    def _apparent(self, temperature: Any, w: Any) -> Any:
        T = jnp.clip(jnp.asarray(temperature, dtype=float), self.coldest, self.hottest)
        h = specific_enthalpy
        return (h(T, w) - (1.0 - w) * h(T, 0.0 * w)) / w - self.heat_capacity * (T - ZERO_CELSIUS)


class ElectrolyteMixing(eqx.Module):
    """Of a salt in water, by the slope of its activities with temperature. The solute counts elsewhere with
    the heat capacity that it has in a solution of the molality ``strong``.

    Beyond the temperatures of the activities it keeps what it has at their end; beyond their molality it goes
    on with the slope that it has there over the mass fraction.
    """

    activity: ElectrolyteActivity
    coldest: float = eqx.field(static=True)
    strong: float
    others = False
    """Whether it holds beside other salts as it is."""

    def __call__(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts (kg or kg/s) hold over their parts, J or W; nothing in much water at 25 °C."""
        law = self.activity
        m = jnp.minimum(self._molality(solute, solvent), law.most)
        T = self._inside(temperature)
        total, strongest = solute + solvent, law.most * law.molar_mass
        beyond = safe_divide(solute, total, 0.0) - strongest / (1.0 + strongest)
        further = jnp.maximum(beyond, 0.0) * (1.0 + strongest) ** 2 / law.molar_mass
        both = jnp.stack([T, jnp.full_like(T, ROOM)])
        slopes = law.slopes(both)
        here = [slope[0] for slope in slopes]
        held, slope = jax.jvp(lambda m: law.apparent_enthalpy(T, m, here), (m,), (further,))
        # beside its heat capacity elsewhere, which is that in the strong solution
        strong, strong_at_room = law.apparent_enthalpy(both, self.strong, slopes)
        return solute / law.molar_mass * (held + slope - strong + strong_at_room)

    @property
    def room(self) -> float:
        """Of a mole in the strong solution at 25 °C, J."""
        return float(once(self.activity.apparent_enthalpy, ROOM, self.strong))

    def _inside(self, temperature: Any) -> Any:
        return jnp.clip(jnp.asarray(temperature, dtype=float), self.coldest, self.activity.hottest)

    def heard(self, temperature: Any, solute: Any, solvent: Any) -> None:
        """Flag a solution outside the temperatures and the molality of the activities."""
        self.activity.heard(temperature, self._molality(solute, solvent))

    def _molality(self, solute: Any, solvent: Any) -> Any:
        """Of no solution that of the strongest."""
        law = self.activity
        return safe_divide(solute, solvent * law.molar_mass, jnp.where(solute > 0.0, law.most, 0.0))


class _Slopes(NamedTuple):
    """With temperature, times its square: of Debye and Hückel, of the same at the temperature of each pair of
    ions, and of the four coefficients of each.
    """

    far: Any
    each_far: Any
    each: Any


class IonMixing(eqx.Module):
    """Of several salts in one water, by the slopes of the activities of each cation with each anion.

    What like ions do to each other is taken as the same at all temperatures, charges of unequal size
    included: brines of one ionic strength and one common ion mix without heat. Beyond the ionic strength of
    the data, shared by how much there is of each pair, the salts go on with the slope that they have there
    over the mass fraction, each pair beyond its temperatures with what it has at their end.

    Parameters
    ----------
    pairs: the law of each cation (rows) with each anion.
    charges: of the cations and the anions, without sign.
    table: ions (columns) in a mole of each dissolved salt (rows).
    masses: of a mole of each dissolved salt, kg.
    places: of each dissolved salt among the pairs.
    room: what a mole of each pair holds at 25 °C in its strong solution, J.
    exchange: moles of each dissolved salt that an exchange of ions makes, where all four of two cations and
        two anions are counted; all none elsewhere.
    """

    pairs: tuple[tuple[ElectrolyteMixing, ...], ...]
    charges: tuple[tuple[int, ...], tuple[int, ...]] = eqx.field(static=True)
    table: tuple[tuple[int, ...], ...] = eqx.field(static=True)
    masses: tuple[float, ...] = eqx.field(static=True)
    places: tuple[int, ...] = eqx.field(static=True)
    room: tuple[float, ...] = eqx.field(static=True)
    exchange: tuple[float, ...] = eqx.field(static=True)

    @classmethod
    def of(
        cls,
        dissolved: Mapping[str, Ions],
        laws: Mapping[tuple[str, str], ElectrolyteMixing],
        exchange: Mapping[str, float],
    ) -> IonMixing | None:
        """Of dissolved salts, with the laws of salts by their ions; None where a pair of ions has none."""
        parts = tuple(dissolved.values())
        cations = tuple(dict.fromkeys((p.cation, p.cation_charge) for p in parts))
        anions = tuple(dict.fromkeys((p.anion, -p.anion_charge) for p in parts))
        pairs = [(c, a) for c, _zc in cations for a, _za in anions]
        if any(pair not in laws for pair in pairs):
            return None
        ions = [name for name, _charge in (*cations, *anions)]
        counts = [{p.cation: p.cation_count, p.anion: p.anion_count} for p in parts]
        return cls(
            tuple(tuple(laws[c, a] for a, _za in anions) for c, _zc in cations),
            (tuple(z for _c, z in cations), tuple(z for _a, z in anions)),
            tuple(tuple(each.get(ion, 0) for ion in ions) for each in counts),
            tuple(p.anhydrous_mass for p in parts),
            tuple(pairs.index((p.cation, p.anion)) for p in parts),
            tuple(laws[pair].room for pair in pairs),
            tuple(exchange.get(name, 0.0) for name in dissolved),
        )

    def __call__(self, temperature: Any, solutes: Sequence[Any], solvent: Any) -> Any:
        """What these amounts (kg or kg/s, or series of them) hold over their parts, J or W; nothing in much
        water at 25 °C.
        """

        def held(T: Any, water: Any, *salts: Any) -> Any:
            return self._held(T, jnp.stack(salts), water)

        return jnp.vectorize(held)(jnp.asarray(temperature, dtype=float), solvent, *solutes)

    def _held(self, T: Any, solutes: Any, solvent: Any) -> Any:
        moles, slopes = solutes / np.array(self.masses), self._slopes(T)
        total = jnp.sum(solutes)
        ions = safe_divide(moles @ np.array(self.table, dtype=float), total, 0.0)
        share = self._share(ions)  # of the strongest solution, in one of a kilogram of salts per kg of water
        most = 1.0 / jnp.where(share > 0.0, share, 1.0)
        ratio = jnp.clip(safe_divide(total, solvent, most), THINNEST, most)
        beyond = jnp.maximum(safe_divide(total, total + solvent, 0.0) - most / (1.0 + most), 0.0)
        held, slope = jax.jvp(
            lambda r: self._apart(slopes, r * ions) / r, (ratio,), (beyond * (1.0 + most) ** 2,)
        )
        return total * (held + slope) + jnp.sum(moles * self._levels(slopes))

    def heard(self, temperature: Any, solutes: Sequence[Any], solvent: Any) -> None:
        """Flag a solution outside the temperatures of the activities, or with more of the ions of a salt than
        it alone is known with.
        """
        moles = [x / mass for x, mass in zip(solutes, self.masses, strict=True)]
        ions = [
            safe_divide(sum(n * x for n, x in zip(column, moles, strict=True)), solvent, 0.0)
            for column in zip(*self.table, strict=True)
        ]
        for j, row in enumerate(self.pairs):
            for k, law in enumerate(row):
                p, q = law.activity.counts
                there = jnp.minimum(ions[j] / p, ions[len(self.pairs) + k] / q)
                law.activity.heard(temperature, there)

    def _share(self, ions: Any) -> Any:
        """Ionic strength over that of the strongest solutions of the pairs of ions, each counted by the
        charges of its ions.
        """
        positive, negative = (np.array(z, dtype=float) for z in self.charges)
        cations, anions = ions[: len(positive)], ions[len(positive) :]
        strength = 0.5 * (jnp.sum(cations * positive**2) + jnp.sum(anions * negative**2))
        most = [
            [m.activity.most * 0.5 * np.dot(m.activity.counts, np.square(m.activity.charges)) for m in row]
            for row in self.pairs
        ]
        charge = jnp.sum(cations * positive)
        pairs = (cations * positive) @ (1.0 / np.array(most)) @ (anions * negative)
        return safe_divide(strength * pairs, charge**2, 0.0)

    def _slopes(self, T: Any) -> _Slopes:
        """Of the coefficients of each pair with temperature, times its square."""
        laws = [m.activity for row in self.pairs for m in row]
        sets = np.array([(a.beta_zero, a.beta_one, a.beta_two, a.c_phi) for a in laws], dtype=float)
        low = np.array([m.coldest for row in self.pairs for m in row])
        high = np.array([a.hottest for a in laws])
        t = jnp.clip(T, low, high)
        table = np.moveaxis(sets, -1, 0)
        slopes = slope_over_temperature(t[:, None], table)
        inside = jnp.append(t, jnp.clip(T, np.min(low), np.max(high)))
        far = slope_over_temperature(inside, SLOPE) * inside**2
        return _Slopes(far[-1], far[:-1], slopes * t[:, None] ** 2)

    def _apart(self, slopes: _Slopes, m: Any) -> Any:
        """Of ions (mol) in a kilogram of water over the same in much water, J."""
        positive, negative = (np.array(z, dtype=float) for z in self.charges)
        cations, anions = m[: len(positive)], m[len(positive) :]
        strength = 0.5 * (jnp.sum(cations * positive**2) + jnp.sum(anions * negative**2))
        root, charge = jnp.sqrt(jnp.maximum(strength, LEAST)), jnp.sum(cations * positive)
        alone = -4.0 * slopes.far * strength / DISTANCE * jnp.log1p(DISTANCE * root)
        pairs = (self._second(slopes, root) + charge * self._third(slopes)).reshape(len(positive), -1)
        return -GAS_CONSTANT * (alone + 2.0 * cations @ pairs @ anions)

    def _second(self, slopes: _Slopes, root: Any) -> Any:
        exponents = np.array([m.activity.exponents for row in self.pairs for m in row])
        zero, one, two = (slopes.each[:, k] for k in range(3))
        return zero + one * fading(exponents[:, 0] * root) + two * fading(exponents[:, 1] * root)

    def _third(self, slopes: _Slopes) -> Any:
        products = np.outer(*(np.array(z, dtype=float) for z in self.charges)).ravel()
        return slopes.each[:, 3] / (2.0 * np.sqrt(products))

    def _levels(self, slopes: _Slopes) -> Any:
        """Of a mole of each salt: it counts elsewhere with the heat capacity that it has in a strong
        solution; sums over ions where those of four salts are.
        """
        p, q = np.array([m.activity.counts for row in self.pairs for m in row], dtype=float).T
        zc, za = np.array([m.activity.charges for row in self.pairs for m in row], dtype=float).T
        strong = np.array([m.strong for row in self.pairs for m in row], dtype=float)
        strength = 0.5 * (p * zc**2 + q * za**2)
        root = np.sqrt(strength * strong)
        alone = -4.0 * strength / DISTANCE * np.log1p(DISTANCE * root) * slopes.each_far
        pairs = self._second(slopes, root) + strong * p * zc * self._third(slopes)
        strongest = -GAS_CONSTANT * (alone + 2.0 * strong * p * q * pairs)
        levels = (np.array(self.room) - strongest)[np.array(self.places)]
        made = np.array(self.exchange)
        if not made.any():
            return levels
        return levels - (made @ levels) / (len(made) * np.where(made, made, 1.0))
