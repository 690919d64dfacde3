"""Well-mixed beds: the closed forms of the spread of residence times, deep beds, figures of the youngest."""

from __future__ import annotations

from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES
from tests.sharing.samples import SAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.gas_solid.dryer import PLAIN, ready
from granum.drying.gas_solid.kinetics import AbstractKinetics, Meeting, SurfaceKinetics
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.mixed import Bed, Gas, Solid, steady_bed
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.products import PRODUCTS
from granum.streams.audit import closure
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

MIXTURE = mixture_of(["water"], ["calcite"], ["dry air", "water"], [0.9e-3, 1.1e-3])
MATTER = Matter(MIXTURE, jnp.ones((1, 1)), jnp.array([1.0, 0.0]), 101325.0)
WET = 0.1
EXAMPLE = EXAMPLES / "dryers" / "fluid-bed.toml"
WIDE = mixture_of(["water"], ["calcite"], ["dry air", "water"], list(np.geomspace(1e-4, 4e-3, 5)))
BEDS = max(200, SAMPLES)
COOL = {"compiler_options": PLAIN} if jax.default_backend() == "cpu" else {}


class Given(AbstractKinetics):
    """A rate whatever the gas: of first order, or constant down to (almost) nothing."""

    first: float
    constant: float

    def equilibrium(self, at: Meeting):
        return 0.0 * at.moisture

    def rate(self, at: Meeting):
        return self.first * at.moisture + self.constant * jnp.clip(at.moisture / (1e-6 * WET), 0.0, 1.0)


@ready
def left(first, constant):
    """Moisture of the product over that of the feed, the wettest that leaves, for a residence time of
    100 s.
    """
    bed = Bed(MATTER, Given(first, constant), jnp.array([500.0]), jnp.array([1.0]), 100.0, 20.0)
    found = steady_bed(bed, Solid(jnp.array([WET]), jnp.array([313.15])), Gas(0.001, jnp.asarray(393.15)))
    return found.water[0] / WET, found.wettest / WET, found.converged


def test_residence_times_of_a_mixed_bed_are_exponential() -> None:
    """Kinetics of first order leave 1/(1 + kτ); a constant rate leaves 1 − (1 − e^(−x))/x of particles dry
    after xτ (Kunii and Levenspiel).
    """
    for k in np.geomspace(0.1, 50.0, 9):
        share, wettest, found = left(jnp.asarray(k / 100.0), jnp.asarray(0.0))
        assert found
        assert float(share) == pytest.approx(1.0 / (1.0 + k), rel=1e-3)
        assert float(wettest) == pytest.approx(1.0)  # some leave as they came
    for x in np.geomspace(0.05, 10.0, 9):
        share, _wettest, found = left(jnp.asarray(0.0), jnp.asarray(WET / (100.0 * x)))
        assert found
        assert float(share) == pytest.approx(1.0 + np.expm1(-x) / x, rel=5e-3)


def test_a_solid_with_an_isotherm_in_the_example(tmp_path: Path) -> None:
    """Gas that comes near equilibrium with the bed: this case was printed unsolved, with an exhaust as hot as
    the gas.
    """
    text = EXAMPLE.read_text().replace(
        "critical_moisture = 0.01", 'critical_moisture = 0.01, isotherm = "wheat"'
    )
    (tmp_path / "solids_made.toml").write_text((EXAMPLE.parent / "solids_made.toml").read_text())
    (tmp_path / "wheat.toml").write_text(text)
    run = gr.read(tmp_path / "wheat.toml").solve()
    wet, gas, product, exhaust = (run.streams[name] for name in ("wet_mineral", "gas", "product", "exhaust"))
    found = closure([wet, gas], [product, exhaust])
    assert max(float(found.mass), float(found.energy)) < 1e-9
    assert 0.0 < float(product.moisture_dry_basis) < 0.1
    assert float(wet.temperature) < float(exhaust.temperature) < 400.0  # it evaporates most of 10 % of water


def test_deep_beds_of_coarse_grains() -> None:
    """Ever more of 1 mm calcite, 1 kg/s with 0.2 kg/kg in 10 kg/s of gas at 150 °C, dries ever further and
    stays above equilibrium.
    """
    feed = empty(MIXTURE, 293.15).replace(solid=jnp.array([[1.0]]), liquid=jnp.array([0.2]))
    gas = empty(MIXTURE, 423.15).replace(gas=jnp.array([9.9, 0.1]))

    def outlet(mass):
        bed = FluidBedDryer(
            area=8.0,
            mass=mass,
            kinetics=SurfaceKinetics(0.1, isotherm=PRODUCTS["wheat"]()),
            bypass_fraction=0.0,
        )
        out = bed(feed, gas)
        found = closure([feed, gas], [out.product, out.exhaust])
        return out.product.moisture_dry_basis, jnp.maximum(found.mass, found.energy)

    moisture, left = jax.jit(lambda masses: jax.lax.map(outlet, masses), **COOL)(
        jnp.geomspace(150.0, 3600.0, 6)
    )
    assert left.max() < 1e-9
    assert (np.diff(moisture) < 0).all()
    assert 0.0 < moisture[-1] < moisture[0] < 0.2


def test_a_well_mixed_bed_in_time_is_refused() -> None:
    """One cell has ages in the steady state, which the run in time does not follow."""
    feed = empty(MIXTURE, 293.15).replace(solid=jnp.array([[1.0]]), liquid=jnp.array([0.2]))
    gas = empty(MIXTURE, 423.15).replace(gas=jnp.array([9.9, 0.1]))
    bed = FluidBedDryer(area=8.0, mass=600.0, kinetics=SurfaceKinetics(0.1))
    with pytest.raises(InputError, match="'cells' = 2 or more"):
        bed.dynamic(feed, gas, 10.0, bed.inlet(feed, gas))


def random_bed(x):
    """Flows over two decades, up to 0.5 kg/kg of water, gas from 60 to 180 °C, narrow and wide sizes, shallow
    and deep beds.
    """
    flow, X, ratio = 10 ** (-1 + 1.7 * x[0]), 0.02 + 0.5 * x[1] ** 2, 10 ** (1.3 * x[3])
    classes = len(WIDE.sizes)
    sizes = jnp.exp(-0.5 * ((jnp.arange(classes) + 0.5 - x[5] * classes) / (0.1 + 2.0 * x[4])) ** 2)
    feed = empty(WIDE, 283.0 + 40.0 * x[6]).replace(
        solid=flow * sizes[None] / jnp.sum(sizes), liquid=jnp.array([1.0]) * flow * X
    )
    gas = empty(WIDE, 333.0 + 120.0 * x[2]).replace(
        gas=flow * ratio * jnp.stack([1.0, 0.003 + 0.03 * x[7] ** 2])
    )
    area = flow * ratio / (0.6 + 1.5 * x[8])
    kinetics = SurfaceKinetics(0.08 + 0.1 * x[10], isotherm=Gab(0.05 + 0.05 * x[11], 10.0, 0.8))
    out = FluidBedDryer(area=area, mass=area * (0.05 + 0.6 * x[9]) * 1500.0, kinetics=kinetics)(feed, gas)
    found = closure([feed, gas], [out.product, out.exhaust])
    moist = Matter.of(feed, gas).relative_humidity(
        out.exhaust.temperature, out.exhaust.gas[1] / out.exhaust.gas[0]
    )
    warmed = out.exhaust.temperature - jnp.where(out.product.moisture_dry_basis > X, jnp.inf, gas.temperature)
    return jnp.maximum(found.mass, found.energy), out.product.moisture_dry_basis, moist, warmed


@pytest.mark.long
def test_random_beds_are_solved() -> None:
    """Mass and energy close, no moisture is negative, no exhaust beyond saturation, none hotter than the gas
    unless vapor condenses in the solid.
    """
    sets = np.random.default_rng(3).random((BEDS, 12))
    left, moisture, moist, warmed = jax.jit(lambda xs: jax.lax.map(random_bed, xs), **COOL)(sets)
    assert left.max() < 1e-9
    assert moisture.min() > 0.0
    assert moist.max() < 1.0 + 1e-6
    assert warmed.max() < 1e-6
