"""Surface of a solid from the gas that it adsorbs."""

from __future__ import annotations

from granum.core import formula
from granum.core.constants import AVOGADRO
from granum.core.kinds import Fraction, MolecularArea, PositiveNumber, SpecificSurfaceMass, SpecificVolume

MOLAR_VOLUME_NORMAL = 0.022413969545  # m³/mol at 0 °C and 1 atm, CODATA 2018
NITROGEN = 0.162e-18  # m², at 77 K


@formula(
    source="brunauer1938, eq. 28; iso9277, § 4",
    title="Gas adsorbed in layers (BET)",
    equation=r"\frac{v}{v_m} = \frac{C\,x}{(1-x)(1 + (C-1)x)},\quad x = p/p_0",
    fitted={"relative_pressure": (0.05, 0.3)},
    typical={"monolayer_constant": (20.0, 300.0)},
)
def adsorbed_volume_bet(
    relative_pressure: Fraction, monolayer_volume: SpecificVolume, monolayer_constant: PositiveNumber
) -> SpecificVolume:
    """Gas adsorbed on a solid in layers without end, by Brunauer, Emmett and Teller.

    >>> round(adsorbed_volume_bet(relative_pressure=0.25, monolayer_volume=3e-3, monolayer_constant=9.0), 9)
    0.003
    """
    x, C = relative_pressure, monolayer_constant
    return monolayer_volume * C * x / ((1.0 - x) * (1.0 + (C - 1.0) * x))


@formula(
    source="brunauer1938; iso9277, § 4",
    title="Surface from the monolayer (BET)",
    equation=r"S_m = \frac{v_m}{V_n}\,N_A\,a_m",
)
def specific_surface_mass_bet(
    monolayer_volume: SpecificVolume, molecule_area: MolecularArea = NITROGEN
) -> SpecificSurfaceMass:
    """Surface per mass that one layer of adsorbed molecules covers; 0.162 nm² each for nitrogen at 77 K.

    Krypton takes 0.202 nm², argon 0.142 nm² at 87 K.

    >>> round(specific_surface_mass_bet(monolayer_volume="1 cm^3/g"))
    4353
    """
    return monolayer_volume / MOLAR_VOLUME_NORMAL * AVOGADRO * molecule_area
