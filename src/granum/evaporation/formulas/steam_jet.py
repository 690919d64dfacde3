"""Steam jets that press vapor together."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.kinds import Pressure, Ratio, Temperature

KILO = 1e3  # Pa, in which the fit counts
FREEZING = 273.15  # K
WEAK = "Motive steam drives a jet only from a pressure above that which the jet delivers."
NO_RISE = "A jet raises the pressure of the vapor: what it delivers must lie above what it sucks in."


@formula(
    source="eldessouky1997; power1994",
    equation=(
        r"\mathrm{Ra} = 0.296\,\frac{p_s^{1.19}}{p_e^{1.04}}\left(\frac{p_m}{p_e}\right)^{0.015}"
        r"\frac{3\cdot10^{-7}p_m^2 - 0.0009\,p_m + 1.6101}{2\cdot10^{-8}T_e^2 - 0.0006\,T_e + 1.0047}"
    ),
    fitted={
        "pressure_motive": (1e5, 3.5e6),
        "pressure_rise_ratio": (1.81, 6.0),
        "motive_steam_ratio": (0.0, 4.0),
    },
    typical={
        "pressure_motive": (4e5, 2e6),
        "pressure_suction": (2e4, 5e4),
        "pressure_delivery": (1e5, 1.2e5),
        "temperature_suction": (330.0, 355.0),
    },
    title="Motive steam of a steam jet (El-Dessouky)",
)
def motive_steam_ratio_el_dessouky(
    pressure_motive: Pressure,
    pressure_suction: Pressure,
    pressure_delivery: Pressure,
    temperature_suction: Temperature,
) -> Ratio:
    """Motive steam per vapor that a steam jet sucks in and presses to its delivery, fitted to Power's chart.

    Pressures in kPa and degrees Celsius in the print. Read in the documentation of WaterTAP; in the program
    itself, which was opened too, a sign of the second term has slipped. Makers build below the pressure ratio
    of 1.81 at which the fit begins; at one it would still ask for steam.

    By hand, 3 bar, 1 bar to 1.9 bar at 100 °C: 0.296·514.9/120.2·1.0166·1.3671/0.9449.

    >>> round(motive_steam_ratio_el_dessouky("3 bar", "1 bar", "1.9 bar", "100 degC"), 3)
    1.865
    """
    pm, pe, ps = (p / KILO for p in (pressure_motive, pressure_suction, pressure_delivery))
    T = temperature_suction - FREEZING
    watch(pressure_rise_ratio=ps / pe)
    impossible(ps <= pe, pressure_delivery, "pressure_delivery", pressure_suction, jnp.inf, NO_RISE)
    impossible(pm <= ps, pressure_motive, "pressure_motive", pressure_delivery, jnp.inf, WEAK)
    pressure = 3e-7 * pm**2 - 0.0009 * pm + 1.6101
    temperature = 2e-8 * T**2 - 0.0006 * T + 1.0047
    return 0.296 * ps**1.19 / pe**1.04 * (pm / pe) ** 0.015 * pressure / temperature
