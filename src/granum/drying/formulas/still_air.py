"""Drying where no fan blows: natural convection at a level surface, and what a layer between others sees of
the room.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_GRAVITY, STEFAN_BOLTZMANN
from granum.core.kinds import Length, PositiveNumber, Ratio
from granum.numerics import Root, find_root, safe_divide

LAMINAR_PLATE = 0.664  # Nu = 0.664 Re^1/2 Pr^1/3, incropera2007, ch. 7
LEAST_RAYLEIGH = 1e-6  # below it the root of nothing would have no slope


@formula(
    source="mcadams1954, ch. 7; incropera2007, ch. 9",
    equation=(
        r"\mathrm{Nu} = \max\left(0.54\,\mathrm{Ra}^{1/4},\ 0.15\,\mathrm{Ra}^{1/3}\right),\quad "
        r"L = \frac{A}{P}"
    ),
    fitted={"rayleigh_number": (1e4, 1e11)},
    typical={"rayleigh_number": (1e4, 1e9)},
    output="nusselt_number",
    title="Natural convection at a level plate, unstable side",
)
def nusselt_number_plate_unstable(rayleigh_number: Ratio) -> PositiveNumber:
    """Nusselt number of a level surface from which the fluid turns away by itself: warm or light gas over it,
    cold or heavy gas under it.

    The length is area over perimeter. Vapor counts as heat does: in the Rayleigh number stands the whole
    difference of density. The two lines are taken where they cross, at Ra 4.7e6, in place of 1e7, where the
    print jumps by 6 %. Sources not opened; the lines were read in three texts that give them.

    By hand at Ra 1e4: 0.54 · 10 = 5.4.

    >>> round(nusselt_number_plate_unstable(1e4), 2)
    5.4
    """
    Ra = jnp.maximum(rayleigh_number, LEAST_RAYLEIGH)
    return jnp.maximum(0.54 * Ra**0.25, 0.15 * Ra ** (1.0 / 3.0))


@formula(
    source="mcadams1954, ch. 7; incropera2007, ch. 9",
    equation=r"\mathrm{Nu} = 0.27\,\mathrm{Ra}^{1/4},\quad L = \frac{A}{P}",
    fitted={"rayleigh_number": (1e5, 1e10)},
    typical={"rayleigh_number": (1e5, 1e9)},
    output="nusselt_number",
    title="Natural convection at a level plate, stable side",
)
def nusselt_number_plate_stable(rayleigh_number: Ratio) -> PositiveNumber:
    """Nusselt number of a level surface on which the fluid rests in layers: cold or heavy gas over it, that
    must creep off to its edges, or warm and light gas under it.

    Half of what the other side has. The length is area over perimeter. Sources not opened; the line was read
    in three texts that give it.

    By hand at Ra 1e8: 0.27 · 100 = 27.

    >>> round(nusselt_number_plate_stable(1e8), 2)
    27.0
    """
    return 0.27 * jnp.maximum(rayleigh_number, LEAST_RAYLEIGH) ** 0.25


@formula(
    source="incropera2007, ch. 13",
    equation=r"F = 1 + \frac{s}{b} - \sqrt{1 + \left(\frac{s}{b}\right)^2}",
    typical={"tray_gap": (0.05, 0.3), "tray_width": (0.5, 2.0)},
    title="What a tray in a rack sees of the room",
    output="view_factor",
    symbols={"view_factor": "F", "tray_gap": "s", "tray_width": "b"},
)
def view_factor_rack(tray_gap: Length, tray_width: Length) -> Ratio:
    """View factor from a long tray past the tray above it, through the two open sides.

    What it does not see of the other tray, by crossed strings; open ends are left out. By hand at a gap as
    high as the width: 2 − √2 = 0.586.

    >>> round(view_factor_rack(1.0, 1.0), 3)
    0.586
    """
    r = tray_gap / tray_width
    return 1.0 + r - jnp.sqrt(1.0 + r**2)


class RoomAir(NamedTuple):
    """Air of a room over a wet level tray.

    temperature, fraction: K, and mol/mol of vapor.
    density, viscosity, conductivity, heat_capacity: of the moist gas.
    gas_molar_mass, vapor_molar_mass: kg/mol.
    length: area of a tray over its perimeter. run: its length in the direction of drafts, at ``velocity``.
    lewis_factor: heat over mass transfer, h/(k c).
    saturated: mole fraction of vapor in saturated gas at a temperature.
    """

    temperature: Any
    fraction: Any
    density: Any
    viscosity: Any
    conductivity: Any
    heat_capacity: Any
    gas_molar_mass: Any
    vapor_molar_mass: Any
    length: Any
    run: Any
    velocity: Any
    lewis_factor: Any
    saturated: Callable[[Any], Any]

    def humidity(self, y: Any) -> Any:
        """Vapor per dry gas, kg/kg."""
        return y / jnp.maximum(1.0 - y, 1e-6) * self.vapor_molar_mass / self.gas_molar_mass

    def heavier(self, Ts: Any) -> Any:
        """By which share the gas at a wet surface is denser than that of the room."""
        lighter = self.vapor_molar_mass - self.gas_molar_mass
        weighs, room = (self.gas_molar_mass + lighter * y for y in (self.saturated(Ts), self.fraction))
        return weighs / room * self.temperature / Ts - 1.0

    def heat_transfer(self, Ts: Any) -> tuple[Any, Any]:
        """Coefficients above and below a tray whose surface is so warm: natural convection, or the draft in
        the room where that is more.
        """
        heavier = self.heavier(Ts)
        diffuses = self.conductivity / self.heat_capacity
        rayleigh = (
            STANDARD_GRAVITY
            * jnp.abs(heavier)
            * self.density**2
            * self.length**3
            / (self.viscosity * diffuses)
        )
        turns, rests = (
            law.function(rayleigh) for law in (nusselt_number_plate_unstable, nusselt_number_plate_stable)
        )
        above, below = (jnp.where(heavier > 0.0, *pair) for pair in ((rests, turns), (turns, rests)))
        reynolds = self.density * self.velocity * self.run / self.viscosity
        prandtl = self.viscosity / diffuses
        draft = (
            LAMINAR_PLATE * jnp.sqrt(jnp.maximum(reynolds, 1e-12)) * prandtl ** (1.0 / 3.0) / self.run
        ) * self.conductivity
        film = self.conductivity / self.length
        return jnp.maximum(above * film, draft), jnp.maximum(below * film, draft)

    def transfer(self, h: Any) -> Any:
        """Mass transfer coefficient on the difference of humidities, kg/(m² s)."""
        return h / (self.lewis_factor * self.heat_capacity * (1.0 + self.humidity(self.fraction)))

    def evaporated(self, Ts: Any, h: Any) -> Any:
        """Flux from a wet surface, kg/(m² s)."""
        return self.transfer(h) * (self.humidity(self.saturated(Ts)) - self.humidity(self.fraction))


class StillSurface(NamedTuple):
    """A wet tray in a room: its temperature, coefficients of both sides together, flux per area of tray."""

    surface_temperature: Any
    heat_transfer: Any
    flux: Any
    found: Any


def still_surface(
    air: RoomAir, sides: Any, exchange: Any, latent: Callable[[Any], Any], coldest: Any
) -> StillSurface:
    """Where heat of the air and of the walls of the room, as warm as it, evaporates the liquid; ``exchange``
    is emissivity times view factor of each side.
    """

    def together(Ts: Any) -> Any:
        above, below = air.heat_transfer(Ts)
        return above + (sides - 1.0) * below

    def heat(Ts: Any, h: Any) -> Any:
        radiated = sides * exchange * STEFAN_BOLTZMANN * (air.temperature**4 - Ts**4)
        return h * (air.temperature - Ts) + radiated

    def surplus(Ts: Any) -> Any:
        h = together(Ts)
        return air.evaporated(Ts, h) * latent(Ts) - heat(Ts, h)

    root: Root = find_root(surplus, coldest, air.temperature, start=air.temperature - 5.0, tolerance=1e-13)
    Ts = root.value
    h = together(Ts)
    return StillSurface(Ts, h, safe_divide(heat(Ts, h), latent(Ts)), root.converged)
