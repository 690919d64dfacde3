"""Costs: purchased and installed equipment, price index, energy, annual charges."""

from granum.costs.formulas.economics import (
    annual_capital_charge as annual_capital_charge,
    capital_cost_lang as capital_cost_lang,
    cost_index_annual as cost_index_annual,
    cost_updated as cost_updated,
    energy_cost_rate as energy_cost_rate,
    material_cost_rate as material_cost_rate,
    payback_time as payback_time,
)
from granum.costs.formulas.emissions import (
    emission_factor as emission_factor,
    greenhouse_gas_rate as greenhouse_gas_rate,
)
from granum.costs.formulas.purchase import (
    EquipmentCost as EquipmentCost,
    equipment_cost_by_area as equipment_cost_by_area,
    equipment_cost_by_diameter as equipment_cost_by_diameter,
    equipment_cost_by_volume as equipment_cost_by_volume,
    equipment_cost_mixer as equipment_cost_mixer,
    purchased_cost_evaporator as purchased_cost_evaporator,
    purchased_cost_exchanger as purchased_cost_exchanger,
    purchased_cost_fan as purchased_cost_fan,
    purchased_cost_pump as purchased_cost_pump,
    purchased_cost_scaled as purchased_cost_scaled,
)
from granum.costs.tables import (
    Correlation as Correlation,
    Emission as Emission,
)
