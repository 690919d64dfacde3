"""What is the air of a room, and what does a convective dryer do to it?

The readings of the course notes (U V.7, D I.3), then the path of drying air on the Mollier–Ramzin chart. The
same from the command line:

    granum calc humid_gas.state temperature=22.2degC wet_bulb_temperature=17degC pressure=1atm granum calc
    humid_gas.mixing dry_gas_flow_first=1.5 humidity_ratio_first=0.027 enthalpy_first="100 kJ/kg" …
"""

from __future__ import annotations

import granum as gr

air = gr.humid_gas


def celsius(T: float) -> float:
    return T - 273.15


def main() -> None:
    room = air.state(temperature="22.2 degC", wet_bulb_temperature="17 degC")
    print(
        f"room: {100 * room.relative_humidity:.0f} %, {room.enthalpy / 1e3:.1f} kJ/kg, dew point "
        f"{celsius(room.dew_point_temperature):.1f} °C"
    )
    mixed = air.mixing(1.5, 0.027, "100 kJ/kg", 2.5, 0.04, "160 kJ/kg")
    print(
        f"mixture: {mixed.enthalpy / 1e3:.1f} kJ/kg, {mixed.humidity_ratio:.4f}, "
        f"{celsius(mixed.temperature):.1f} °C, {100 * mixed.relative_humidity:.0f} %"
    )

    # Ambient air heated to 90 °C and dried with, adiabatically and with losses of 400 kJ per kg of water
    hot = air.heating("20 degC", 0.008, "90 degC", dry_gas_flow="1 kg/s")
    ideal = air.adiabatic_drying("90 degC", 0.008, 0.025)
    slope = air.drying_slope("20 degC", specific_energy_loss="400 kJ/kg")
    real = air.real_drying("90 degC", 0.008, 0.025, drying_slope=slope)
    wet = air.wet_bulb_temperature("90 degC", 0.008)
    print(
        f"heater {hot.heat_duty / 1e3:.1f} kW; outlet {celsius(ideal.temperature):.1f} °C ideal, "
        f"{celsius(real.temperature):.1f} °C with losses"
    )
    chart = air.mollier_chart(
        temperature=["20 degC", "90 degC", real.temperature],
        humidity_ratio=[0.008, 0.008, 0.025],
        temperature_high="100 degC",
    )
    chart.to_json()

    # Printed in the notes
    assert abs(room.relative_humidity - 0.60) < 0.01
    assert abs(room.enthalpy - 47.8e3) < 300
    assert abs(celsius(room.dew_point_temperature) - 14) < 0.3
    assert abs(mixed.enthalpy - 137.5e3) < 1
    assert abs(mixed.humidity_ratio - 0.035) < 2e-4
    assert abs(celsius(mixed.temperature) - 46.5) < 1.0
    # An adiabatic dryer moves along a line of constant wet bulb
    assert abs(air.wet_bulb_temperature(ideal.temperature, 0.025) - wet) < 1e-6
    assert real.temperature < ideal.temperature


if __name__ == "__main__":
    main()
