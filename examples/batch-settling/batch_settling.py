"""How fast does a limestone slurry settle, and how large a thickener does it ask for?

One settling curve of a slurry of 236 g/L (Foust et al., Principles of Unit Operations) is read, its tangents
are taken without a hand, and the thickener for an underflow of 550 g/L follows. The same from the command
line:

    granum fit settling.batch_test limestone.csv initial_concentration="236 g/L"
    underflow_concentration="550 g/L"
"""

from __future__ import annotations

from pathlib import Path

from granum.settling.charts import settling_curve_chart
from granum.settling.lab_tests.batch_test import BatchTest

HERE = Path(__file__).parent


def main() -> None:
    test = BatchTest.read(
        HERE / "limestone.csv", initial_concentration="236 g/L", underflow_concentration="550 g/L"
    )
    found = test.fit()
    print("   C / g/L   v / cm/h")
    for C, v in zip(*test.tangents(), strict=True):
        print(f"{C:10.0f} {v * 3.6e5:10.3f}")
    unit_area = found["unit_area_talmage_fitch"].value
    print(
        f"constant rate {found['settling_velocity'].value * 3.6e5:.1f} cm/h; {unit_area / 86.4:.2f} m² "
        f"per tonne a day"
    )
    for flag in found.flags:
        print("-", flag["message"])
    settling_curve_chart(test.time, test.interface_height, test.initial_concentration).to_json()

    # The book's tangents: 15.65 cm/h at 236 g/L, 1.27 cm/h at 525 g/L, 0.158 cm/h at 714 g/L.
    assert abs(found["settling_velocity"].value * 3.6e5 - 15.65) < 0.8
    assert 0.5 < unit_area / 86.4 < 1.5


if __name__ == "__main__":
    main()
