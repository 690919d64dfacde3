"""Physical constants (CODATA 2018 exact values; standard gravity and atmosphere by definition) and units by
which sources count.
"""

import math

STANDARD_GRAVITY = 9.80665  # m/s², CGPM 1901
GAS_CONSTANT = 8.31446261815324  # J/(mol K)
BOLTZMANN = 1.380649e-23  # J/K
ELEMENTARY_CHARGE = 1.602176634e-19  # A s
VACUUM_PERMITTIVITY = 8.8541878128e-12  # A s/(V m), CODATA 2018, measured
AVOGADRO = 6.02214076e23  # 1/mol
STEFAN_BOLTZMANN = 5.670374419e-8  # W/(m² K⁴)
STANDARD_ATMOSPHERE = 101325.0  # Pa
ZERO_CELSIUS = 273.15  # K
DARCY = 9.869232667160130e-13  # m²: 1 cP · 1 cm/s per atm/cm = 1e-7/101325 m²
MINUTE, HOUR, DAY = 60.0, 3600.0, 86400.0  # s
RPM = 2.0 * math.pi / 60.0  # radian/s
