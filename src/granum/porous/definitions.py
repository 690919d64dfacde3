"""The dimensionless number of a packed bed, spelled out for the equations of cards."""

from __future__ import annotations

BED_REYNOLDS = r",\quad \mathrm{Re}_1 = \frac{\rho_f\,U\,\psi\,d_p}{\eta\,(1 - \varepsilon)}"
