"""Sludge volume indices and the settling velocities they predict."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.kinds import Concentration, Fraction, PositiveNumber, Speed, Volume, VolumePerMass


class Velocities(NamedTuple):
    """Constants of the Vesilind velocity."""

    vesilind_velocity: Speed
    vesilind_coefficient: VolumePerMass


_SVI = {"sludge_volume_index": (0.06, 0.25)}


@formula(
    source="mohlman1934; apha2005, method 2710 D",
    equation=r"\mathrm{SVI} = \frac{V_{30}}{V\,X}",
    symbols={"solids_concentration": "X"},
)
def sludge_volume_index(
    settled_volume: Volume, sample_volume: Volume, solids_concentration: Concentration
) -> VolumePerMass:
    """Sludge volume index (Mohlman): volume taken by a gram of sludge after 30 minutes of settling.

    Below 50 mL/g dense, 80 to 150 mL/g good, above 150 mL/g bulking. It grows with the concentration when the
    settled volume is more than about a quarter of the sample: dilute then, see
    ``sludge_volume_index_diluted``.

    >>> round(sludge_volume_index("250 mL", "1 L", "2.5 g/L") * 1e3, 6)
    100.0
    """
    return settled_volume / (sample_volume * solids_concentration)


@formula(
    source="white1975; apha2005",
    title="Diluted sludge volume index",
    equation=r"\mathrm{DSVI} = \frac{V_{30}}{V\,d\,X}",
    fitted={"settled_fraction": (0.0, 0.25)},
    symbols={"solids_concentration": "X", "sludge_volume_index": r"\mathrm{DSVI}"},
)
def sludge_volume_index_diluted(
    settled_volume: Volume,
    sample_volume: Volume,
    solids_concentration: Concentration,
    dilution: Fraction = 0.5,
) -> VolumePerMass:
    """Diluted sludge volume index: the index measured on a dilution with clear effluent, free of the effect
    of concentration.

    ``solids_concentration`` is that of the sludge before dilution and ``dilution`` the share of sludge in the
    mixture (1/2, 1/4 …), the weakest one that settles to less than 250 mL/L.

    >>> round(sludge_volume_index_diluted("200 mL", "1 L", "4 g/L", dilution=0.5) * 1e3, 6)
    100.0
    """
    watch(settled_fraction=settled_volume / sample_volume)
    return settled_volume / (sample_volume * dilution * solids_concentration)


@formula(
    source="white1975",
    equation=r"\mathrm{SSVI} = \frac{h_{30}}{h_0\,X}",
    family="stirred_sludge_volume_index",
    symbols={"solids_concentration": "X"},
)
def stirred_sludge_volume_index(
    settled_fraction: Fraction, solids_concentration: Concentration
) -> VolumePerMass:
    """Stirred specific volume index: settled height over initial height after 30 minutes of slow stirring,
    per concentration.

    The standard value is at 3.5 kg/m³ (interpolated between tests at other concentrations). Below 100 mL/g
    good, above 120 mL/g poor.

    >>> round(stirred_sludge_volume_index(settled_fraction=0.28, solids_concentration=3.5) * 1e3, 6)
    80.0
    """
    return settled_fraction / solids_concentration


@formula(
    source="daigger1985",
    equation=r"v_0 = 7.80,\quad k = 0.148 + 0.00210\,\mathrm{SVI}",
    typical=_SVI,
    fitted={"sludge_volume_index": (0.036, 0.402)},
    title="Vesilind constants from the index (Daigger and Roper)",
)
def vesilind_velocity_daigger_roper(sludge_volume_index: VolumePerMass) -> Velocities:
    """Vesilind constants from the unstirred sludge volume index after Daigger and Roper.

    A correlation of full-scale data with wide scatter: a factor of two in the velocity is common.

    >>> constants = vesilind_velocity_daigger_roper("100 mL/g")
    >>> round(constants.vesilind_velocity * 3600, 3), round(constants.vesilind_coefficient, 4)
    (7.8, 0.358)
    """
    k = 0.148 + 0.00210 * sludge_volume_index * 1e3
    return Velocities(7.80 / 3600 * jnp.ones_like(k), k)


@formula(
    source="hartel1992",
    equation=(
        r"v_0 = 17.4\,e^{-0.0113\,\mathrm{SVI}} + 3.931,\quad k = 1.043 - "
        r"0.9834\,e^{-0.00581\,\mathrm{SVI}}"
    ),
    typical=_SVI,
    title="Vesilind constants from the index (Härtel and Pöpel)",
)
def vesilind_velocity_hartel_popel(sludge_volume_index: VolumePerMass) -> Velocities:
    """Vesilind constants from the sludge volume index after Härtel and Pöpel.

    >>> constants = vesilind_velocity_hartel_popel("100 mL/g")
    >>> round(constants.vesilind_velocity * 3600, 2), round(constants.vesilind_coefficient, 3)
    (9.55, 0.493)
    """
    index = sludge_volume_index * 1e3
    return Velocities(
        (17.4 * jnp.exp(-0.0113 * index) + 3.931) / 3600, 1.043 - 0.9834 * jnp.exp(-0.00581 * index)
    )


@formula(
    source="apha2005",
    title="Underflow concentration from the sludge index",
    equation=r"C_u = \frac{1}{\mathrm{SVI}}",
)
def underflow_concentration_index(
    sludge_volume_index: VolumePerMass, thickening_factor: PositiveNumber = 1.0
) -> Concentration:
    """Rough return sludge concentration that the sludge volume index allows.

    >>> round(underflow_concentration_index("100 mL/g"), 6)
    10.0
    """
    return thickening_factor / sludge_volume_index
