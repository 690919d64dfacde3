"""Heat from steam to paper on a cylinder: condensate, shell, contact."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import (
    HeatTransferCoefficient,
    Length,
    MassFlow,
    MassFlux,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Speed,
)
from granum.settling.kinds import LineLoad


@formula(
    source="wilhelmsson1995; karlsson2000",
    equation=r"h_c = h_0 + 955\,X",
    fitted={"moisture_dry_basis": (0.0, 2.0)},
    typical={"moisture_dry_basis": (0.05, 1.5), "heat_transfer_coefficient_dry": (200.0, 600.0)},
    symbols={"heat_transfer_coefficient_dry": "h_0", "heat_transfer_coefficient": "h_c"},
    output="heat_transfer_coefficient",
    title="Contact between cylinder and paper (Wilhelmsson)",
)
def heat_transfer_coefficient_paper(
    moisture_dry_basis: MoistureDryBasis, heat_transfer_coefficient_dry: HeatTransferCoefficient = 350.0
) -> HeatTransferCoefficient:
    """Coefficient of contact between a cylinder and the web that a fabric presses on it: water in the paper
    fills the gap.

    The slope is recalled, not opened. The value of dry paper hangs on smoothness and tension, 200 to
    600 W/(m² K).

    By hand: 350 + 955 · 1.2 = 1496.

    >>> round(heat_transfer_coefficient_paper(1.2))
    1496
    """
    return heat_transfer_coefficient_dry + 955.0 * moisture_dry_basis


@formula(
    source="tappi0404",
    equation=r"N = \frac{\dot m_e}{\pi D\,n\,l}",
    typical={
        "evaporation_rate": (1.0, 15.0),
        "diameter": (1.2, 1.83),
        "cylinder_count": (20.0, 60.0),
        "width": (2.0, 10.0),
    },
    title="Drying rate of a paper machine (TAPPI)",
)
def evaporation_per_area_tappi(
    evaporation_rate: MassFlow, diameter: Length, cylinder_count: PositiveNumber, width: Length
) -> MassFlux:
    """Water evaporated per whole circumference of the steam-heated cylinders times the width of the sheet, by
    which paper machines are compared.

    By hand: 12 t/h on 40 cylinders of 1.5 m, 5 m wide, that is 942.5 m², make 12.7 kg/(m² h).

    >>> round(evaporation_per_area_tappi("12 t/h", 1.5, 40, 5.0) * 3600, 1)
    12.7
    """
    return evaporation_rate / (3.141592653589793 * diameter * cylinder_count * width)


@formula(
    source="eaton1997; swietlik",
    equation=r"P = n\,q\,l\,v",
    typical={
        "cylinder_count": (5.0, 60.0),
        "running_load": (100.0, 600.0),
        "width": (2.0, 10.0),
        "web_speed": (1.0, 30.0),
    },
    title="Shaft power of the cylinders of a paper machine (TAPPI)",
)
def shaft_power_cylinders(
    cylinder_count: PositiveNumber, running_load: LineLoad, width: Length, web_speed: Speed
) -> Power:
    """Power that turns steam-heated cylinders and their felt rolls, from the normal running load of one: the
    pull per width that bearings, felts and condensate take.

    Paper makers write the load as hp per inch of width and 100 ft/min, of which 0.01 are 578 N/m. By hand: 40
    cylinders of 270 N/m, 5 m wide, at 15 m/s take 810 kW.

    >>> round(shaft_power_cylinders(40, 270.0, 5.0, 15.0))
    810000
    """
    return cylinder_count * running_load * width * web_speed
