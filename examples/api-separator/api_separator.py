"""How long must an oil–water separator be? API 421 with its limits, and what such a channel does to a
spectrum of globules.

The sizing follows a published calculation sheet (224.8 m³/h, 880 against 1000 kg/m³, 1 mPa·s): 1.13 m deep,
3.63 m wide and 18.1 m long. ``separator.toml`` is the same channel with a feed (``granum run
separator.toml``).
"""

from __future__ import annotations

from pathlib import Path

import granum as gr
from granum.settling.equipment.api_separator import ApiSeparator


def main() -> None:
    sized = ApiSeparator.size(224.79 / 3600, 1000.0, 880.0, 1e-3, depth_over_width=0.311)
    print(
        f"{sized.channel_number:.0f} channel of {sized.height:.2f} m × {sized.width:.2f} m × "
        f"{sized.length:.1f} m"
    )
    assert abs(sized.height - 1.13) < 0.01
    assert abs(sized.width - 3.63) < 0.02
    assert abs(sized.length - 18.13) < 0.1

    run = gr.read(Path(__file__).parent / "separator.toml").solve()
    oil, left = (float(run.streams[name].solid_by_species[0]) for name in ("oil", "treated"))
    print(
        f"{100 * oil / (oil + left):.0f} % of the oil is skimmed; "
        f"{1e6 * left / float(run.streams['treated'].liquid_flow):.0f} mg/kg left"
    )
    assert 0.5 < oil / (oil + left) < 0.95
    assert run.audit["mass_closure"] < 1e-10


if __name__ == "__main__":
    main()
