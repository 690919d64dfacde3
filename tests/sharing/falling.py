"""The sphere that falls: the formula with which studies, command and server are tried."""

from __future__ import annotations

from tests.sharing.places import EXAMPLES

STOKES = "particles.terminal_velocity_stokes"
SPHERE = {
    "particle_diameter": "85 um",
    "particle_density": "2630 kg/m3",
    "fluid_density": "1020 kg/m3",
    "dynamic_viscosity": "1.2 cP",
}
SLURRY = {"particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
SPREAD = {
    "particle_diameter": {"distribution": "lognormal", "median": "20 um", "geometric_standard_deviation": 1.3}
}
SETTLING = EXAMPLES / "studies" / "settling.toml"
