"""When does the constant-rate period of a tray of foodstuff end, and how long does it take to dry?

Drying test of Geankoplis, problem 9.7-2, with its printed answers: 0.996 kg/(m² h), critical free moisture
0.12, and 4.1 h from a free moisture of 0.20 to 0.04. From the command line:

    granum fit drying.curve foodstuff_geankoplis.csv dry_solid_mass=3.765kg area=0.186m2
    equilibrium_moisture=0.0505 warm_up_time=0.4h
"""

from __future__ import annotations

from pathlib import Path

import granum as gr

HERE = Path(__file__).parent
EQUILIBRIUM = 0.190 / 3.765


def main() -> None:
    test = gr.drying.DryingCurve.read(
        HERE / "foodstuff_geankoplis.csv",
        dry_solid_mass="3.765 kg",
        area="0.186 m2",
        equilibrium_moisture=EQUILIBRIUM,
        warm_up_time="0.4 h",
    )
    found = test.fit()
    Xc, rate = found["critical_moisture"], found["drying_rate_constant"]
    print(
        f"critical free moisture {Xc.value - EQUILIBRIUM:.3f}, 95 % within ± "
        f"{Xc.interval_95[1] - Xc.value:.3f} (printed 0.12)"
    )
    print(f"constant rate {3600 * rate.value:.3f} kg/(m2 h) (printed 0.996)")
    time = gr.drying.drying_time(
        dry_solid_mass="3.765 kg",
        area="0.186 m2",
        drying_rate_constant=rate.value,
        moisture_dry_basis_start=0.20 + EQUILIBRIUM,
        moisture_dry_basis_end=0.04 + EQUILIBRIUM,
        critical_moisture=Xc.value,
        equilibrium_moisture=EQUILIBRIUM,
    )
    print(f"from 0.20 to 0.04: {time.drying_time / 3600:.2f} h (printed 4.1)")
    for flag in found.flags:
        print("-", flag["message"])
    test.chart().to_json()

    assert abs(3600 * rate.value / 0.996 - 1) < 0.03
    assert abs(Xc.value - EQUILIBRIUM - 0.12) < 0.02
    assert abs(time.drying_time / 3600 - 4.1) < 0.15


if __name__ == "__main__":
    main()
