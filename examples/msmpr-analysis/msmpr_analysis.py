"""How fast do the crystals grow and how many are born? The urea crystallizer of Bennett and Van Buren, worked
in Perry's Handbook.

Run it in this folder: ``python msmpr_analysis.py``, or ``granum fit crystallization.msmpr_analysis
urea_bennett1969.csv residence_time=3.38h``.
"""

from pathlib import Path

import granum as gr

data = Path(__file__).parent / "urea_bennett1969.csv"
fit = gr.crystallization.MsmprAnalysis.read(data, residence_time="3.38 hour", crystal_density=1335).fit()
growth, births = fit["growth_rate"], fit["nucleation_rate"]
print(
    f"G = {growth.value * 3.6e6:.4f} mm/h, B0 = {births.value * 3.6:.3g} 1/(L h), magma density of the "
    f"line {fit['magma_density'].value:.0f} g/L"
)
assert abs(growth.value * 3.6e6 - 0.0324) < 0.0005  # printed: 0.0324 mm/h
assert abs(births.value * 3.6 / 12.6e6 - 1) < 0.1  # printed: 12.6e6 per liter and hour
assert growth.interval_95[0] < growth.value < growth.interval_95[1]

# Sodium carbonate decahydrate, Geankoplis example 12.11-1: 10 000 kg of 30 % solution cooled to 20 °C, 3 % of
# it evaporating
salt = gr.crystallization.crystallizer_balance(
    mass_flow=10000.0,
    solute_mass_fraction=0.30,
    solubility_per_solvent=0.215,
    solute_fraction_of_crystal=106.0 / 286.2,
    evaporation=300.0,
)
print(f"decahydrate {salt.crystal_flow:.0f} kg, mother liquor {salt.mother_liquor_flow:.0f} kg")
assert abs(salt.crystal_flow / 6630 - 1) < 0.003  # printed: 6630 kg
