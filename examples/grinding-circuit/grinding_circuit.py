"""How much returns to the mill? A ball mill in closed circuit with a screen, and what its holdup does to the
circulating load.

Run it in this folder: ``python grinding_circuit.py``. The line itself is ``circuit.toml`` (``granum run
circuit.toml``).
"""

from pathlib import Path

import granum as gr

line = gr.read(Path(__file__).parent / "circuit.toml")
run = line.solve()
load = float(run.streams["returned"].solid_flow / run.streams["product"].solid_flow)
print(
    f"circulating load {100 * load:.0f} %, product 80 % below "
    f"{run.figure('mill.product_size') * 1e6:.0f} um at the mill exit"
)
assert bool(run.solution.converged)
assert run.audit["mass_closure"] < 1e-8
assert 2.5 < load < 3.5  # the usual 250 to 350 % of a ball mill circuit

# Bond's law for the same duty, limestone: the shaft power of the mill is of the right size
energy = gr.comminution.specific_energy_bond(
    feed_size="1.56 mm", product_size="281 um", work_index=gr.comminution.work_index("limestone")
)
power = energy * float(run.streams["fresh"].solid_flow) / 1e3
print(f"Bond asks for {power:.0f} kW, the line gives 150 kW")
assert 80.0 < power < 160.0

# More solid in the mill grinds more per pass. With much less than 1600 kg there is no steady state: the mill
# breaks less than is fed.
loads = []
for holdup in (1600.0, 2000.0, 3000.0):
    other = line.with_values(**{"mill.holdup_mass": holdup}).solve()
    loads.append(float(other.streams["returned"].solid_flow / other.streams["product"].solid_flow))
    print(f"holdup {holdup:.0f} kg: circulating load {100 * loads[-1]:.0f} %")
assert loads[0] > loads[1] > loads[2]
