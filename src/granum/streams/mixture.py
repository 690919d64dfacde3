"""What streams are made of: species in each phase, the conserved components behind them, and the particle
size classes.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.at_once import at_once
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.materials.library import Library, session


@dataclass(frozen=True)
class Species:
    """One substance in one phase.

    Parameters
    ----------
    name: name within its phase.
    composition: conserved components with their mass fractions, ``(("water", 1.0),)``; a hydrate crystal has
        two.
    density: kg/m³, polynomial coefficients in temperature above 0 °C, lowest power first; a gas gives none.
    heat_capacity: J/(kg K), polynomial coefficients in temperature above 0 °C, lowest power first.
    reference_enthalpy: J/kg at 0 °C. Zero for the reference state of each component, so that differences
        between the species of one component are heats of phase change: 2.501e6 for water vapor against liquid
        water.
    molar_mass: kg/mol.
    valid: K, between which the heat capacity is taken as given; outside it stays what it is at the end, so
        that enthalpy always grows with temperature.
    """

    name: str
    composition: tuple[tuple[str, float], ...]
    density: tuple[float, ...] = ()
    heat_capacity: tuple[float, ...] = (0.0,)
    reference_enthalpy: float = 0.0
    molar_mass: float = float("nan")
    valid: tuple[float, float] = (0.0, 1e4)

    def enthalpy(self, temperature: Any) -> Any:
        """Specific enthalpy, J/kg, at a temperature in K."""
        inside = jnp.clip(jnp.asarray(temperature, dtype=float), *self.valid)
        theta = inside - ZERO_CELSIUS
        total, slope = 0.0, 0.0
        for power in range(len(self.heat_capacity), 0, -1):  # Horner on the integral of the polynomial
            total = (total + self.heat_capacity[power - 1] / power) * theta
            slope = slope * theta + self.heat_capacity[power - 1]
        return self.reference_enthalpy + total + slope * (temperature - inside)


SORTS = {"solids": ("solid",), "liquids": ("fluid", "solute"), "gases": ("fluid",)}
"""What the library calls that which stands in a phase."""
AIR = "dry air"
STEAM = 0.98  # mass share of the vapor from which on a gas counts as steam, which is its own carrier


def carrier_of(gases: Iterable[str], vapor: str | None) -> str | None:
    """The gas that carries a vapor: dry air where it is among them, else the first by name, so that their
    order says nothing.
    """
    others = sorted(name for name in gases if name != vapor)
    return AIR if AIR in others else next(iter(others), None)


@dataclass(frozen=True, eq=False)
class Mixture:
    """The species a set of streams shares. Immutable and hashable, so that compiled code is reused between
    equal mixtures.

    Parameters
    ----------
    solids, liquids, gases: species of each phase, in the order of the stream's arrays.
    size_edges: class boundaries of the particle size, m, increasing (n + 1 of them).
    axes: further axes of the solid: ``(("porosity", edges), …)``; every unit that does not know an axis
        leaves it alone.
    mixing: function of (flows of the liquid species, temperature) → W, what they hold over their parts, which
        knows its ``solutes`` by place and flags with ``heard`` what lies outside its data; None where
        enthalpies add up.
    liquid_viscosity: function of (mass fractions of the liquid species, temperature) → Pa s.
    gas_viscosity, gas_conductivity: functions of (mass fractions of the gas species, temperature) → Pa s,
        W/(m K).
    materials: where the fluids behind the species are found by name.
    """

    solids: tuple[Species, ...]
    liquids: tuple[Species, ...]
    gases: tuple[Species, ...]
    size_edges: tuple[float, ...]
    axes: tuple[tuple[str, tuple[float, ...]], ...] = ()
    liquid_viscosity: Callable[[Any, Any], Any] | None = None
    gas_viscosity: Callable[[Any, Any], Any] | None = None
    gas_conductivity: Callable[[Any, Any], Any] | None = None
    materials: Library = field(default_factory=session)
    mixing: Any = None
    _key: Any = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        edges = np.asarray(self.size_edges)
        if edges.size < 2 or np.any(np.diff(edges) <= 0) or edges[0] < 0:
            raise InputError(_("Size classes need at least two increasing boundaries of zero or more."))
        key = (
            self.solids,
            self.liquids,
            self.gases,
            self.size_edges,
            self.axes,
            self.liquid_viscosity,
            self.gas_viscosity,
            self.gas_conductivity,
            self.materials,
            self.mixing,
        )
        object.__setattr__(self, "_key", (hash(key), key))

    def __hash__(self) -> int:
        return self._key[0]

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Mixture) and self._key == other._key)

    @cached_property
    def components(self) -> tuple[str, ...]:
        """The conserved components, in order of first appearance."""
        found: dict[str, None] = {}
        for species in (*self.liquids, *self.gases, *self.solids):
            for name, _share in species.composition:
                found.setdefault(name)
        return tuple(found)

    def composition_matrix(self, species: tuple[Species, ...]) -> np.ndarray:
        """(species × components) mass of component per mass of species."""
        matrix = np.zeros((len(species), len(self.components)))
        for row, item in enumerate(species):
            for name, share in item.composition:
                matrix[row, self.components.index(name)] = share
        return matrix

    @cached_property
    def edges(self) -> np.ndarray:
        """Size class boundaries, m."""
        return np.asarray(self.size_edges)

    @cached_property
    def sizes(self) -> np.ndarray:
        """Representative size of each class, m: the geometric mean of its boundaries (half the upper one when
        the lower is 0).
        """
        low, high = self.edges[:-1], self.edges[1:]
        return np.where(low > 0, np.sqrt(low * high), 0.5 * high)

    @property
    def solid_shape(self) -> tuple[int, ...]:
        """Shape of a stream's solid array: species × size class × further axes."""
        return (len(self.solids), len(self.size_edges) - 1, *(len(edges) - 1 for _name, edges in self.axes))

    def require(self, phase: str) -> None:
        """Refuses a mixture without a phase that a unit needs: ``solids``, ``liquids`` or ``gases``."""
        if not getattr(self, phase):
            raise InputError(
                _("The mixture has no {phase}, which this unit needs: name some in the mixture.").format(
                    phase=_(phase)
                ),
                name=phase,
            )

    def index(self, phase: str, name: str) -> int:
        """Position of a species in its phase (``solids``, ``liquids``, ``gases``), by its name there or by
        another that the library knows it by; a clear error for an unknown name.
        """
        names = [species.name for species in getattr(self, phase)]
        if name in names:
            return names.index(name)
        called = [self.materials.called(n, *SORTS[phase]) for n in (name, *names)]
        if called[0] is None or called[0] not in called[1:]:
            raise unknown_name(_("Species"), name, names, _("among the {phase}").format(phase=_(phase)))
        return called.index(called[0], 1) - 1

    @cached_property
    def _tables(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Coefficients of enthalpy and density, species × powers of the temperature above 0 °C, for each
        phase.
        """
        tables = {}
        for phase in ("solids", "liquids", "gases"):
            species = getattr(self, phase)
            tables[phase] = (_heats(species), _table([s.density for s in species]))
        return tables

    def enthalpies(self, phase: str, temperature: Any) -> Any:
        """Specific enthalpies of the species of a phase, J/kg."""
        table, species = self._tables[phase][0], getattr(self, phase)
        if table.shape[1] < 3:  # constant heat capacities
            return _horner(table, temperature)
        if array_of(temperature) is np:
            return _enthalpies(table, species, temperature)
        return _enthalpies_traced(species, temperature)

    def heat_of_mixing(self, liquids: Any, temperature: Any) -> Any:
        """What flows of the liquid species hold over their parts, W."""
        if self.mixing is None:
            return 0.0
        numbers = array_of(liquids) is np and array_of(temperature) is np
        return (_held_by_numbers if numbers else _held)(self.mixing, liquids, temperature)

    def densities(self, phase: str, temperature: Any) -> Any:
        """Densities of the (condensed) species of a phase, kg/m³."""
        return _horner(self._tables[phase][1], temperature)


@functools.partial(jax.jit, static_argnums=0)
def _held(mixing: Any, liquids: Any, temperature: Any) -> Any:
    """A program of its own, traced and differentiated once for all places of a line that ask for it."""
    return mixing(liquids, temperature)


@at_once()
def _held_by_numbers(mixing: Any, liquids: Any, temperature: Any) -> Any:
    return mixing(liquids, temperature)


def array_of(value: Any) -> Any:
    """What calculates with a value: NumPy with its own, which no compiler is asked for, else JAX."""
    return np if isinstance(value, np.ndarray | np.generic | float) else jnp


def _table(rows: list[tuple[float, ...]]) -> np.ndarray:
    width = max((len(row) for row in rows), default=1)
    return np.array([row + (0.0,) * (width - len(row)) for row in rows]).reshape(len(rows), width)


def _heats(species: tuple[Species, ...]) -> np.ndarray:
    return _table(
        [
            (s.reference_enthalpy, *(c / (power + 1) for power, c in enumerate(s.heat_capacity)))
            for s in species
        ]
    )


def _enthalpies(table: np.ndarray, species: tuple[Species, ...], temperature: Any) -> Any:
    xp = array_of(temperature)
    T = xp.asarray(temperature, dtype=float)
    ends = zip(*(s.valid for s in species), strict=True)
    low, high = (np.array(side).reshape((-1,) + (1,) * T.ndim) for side in ends)
    inside = xp.clip(T, low, high)
    slopes = table[:, 1:] * np.arange(1, table.shape[1])
    return _horner(table, inside, by_row=True) + _horner(slopes, inside, by_row=True) * (T - inside)


@functools.partial(jax.jit, static_argnums=0)
def _enthalpies_traced(species: tuple[Species, ...], temperature: Any) -> Any:
    """As ``_held``."""
    return _enthalpies(_heats(species), species, temperature)


def _horner(table: np.ndarray, temperature: Any, by_row: bool = False) -> Any:
    """One polynomial a row, at a temperature common to the rows or, ``by_row``, at one for each."""
    xp = array_of(temperature)
    theta = xp.asarray(temperature, dtype=float) - ZERO_CELSIUS
    inner = theta.ndim - by_row
    columns = [column.reshape((-1,) + (1,) * inner) for column in table.T]
    shape = theta.shape if by_row else (len(table), *theta.shape)
    total = xp.broadcast_to(columns[-1], shape) if columns else xp.zeros(shape)
    for column in reversed(columns[:-1]):
        total = total * theta + column
    return total
