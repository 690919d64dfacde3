"""Two stages for a large temperature fall: what does the second add, and what does the flash spare?

Run it in this folder: ``python cascade.py``. The line itself is ``cascade.toml`` (``granum run
cascade.toml``).
"""

from pathlib import Path

import granum as gr

line = gr.read(Path(__file__).parent / "cascade.toml")
run = line.solve()
fed = 0.5  # kg/s of potassium nitrate
first, second = (float(run.streams[name].solid_flow) for name in ("suspension", "product"))
print(
    f"crystals {first:.3f} kg/s after the flash, {second:.3f} kg/s after cooling: yield "
    f"{100 * second / fed:.0f} %"
)
assert run.audit["mass_closure"] < 1e-10

# At 20 °C the liquor is saturated with 31.6 g per 100 g of water (CRC Handbook), to within its small
# supersaturation:
# what has not crystallized is what the water left by the flash holds.
liquid = run.streams["product"].liquid
ratio = float(liquid[1] / liquid[0])
print(f"mother liquor {ratio:.4f} kg/kg")
assert abs(ratio - 0.316) < 0.01

# The flash evaporates about what its sensible heat pays for: 1 kg/s of 85 °C liquor down to 45 °C, 2.4 MJ/kg
# of vapor.
vapor = float(run.streams["vapor"].gas_flow)
print(f"vapor {vapor:.4f} kg/s; no cooling surface in the first stage")
assert 0.045 < vapor < 0.075

# Second stage: crystals of the first grow on, so the product is coarser than from one vessel of the same
# residence time at 20 °C.
assert run.figure("cooled.mass_median_size") > run.figure("flash.mass_median_size")
