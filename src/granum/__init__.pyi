"""Granum: fluid–solid unit operations from lab data to process line."""

from granum import app as app
from granum import cases as cases
from granum import centrifuges as centrifuges
from granum import comminution as comminution
from granum import conveying as conveying
from granum import core as core
from granum import costs as costs
from granum import crystallization as crystallization
from granum import cyclones as cyclones
from granum import drying as drying
from granum import dust as dust
from granum import estimation as estimation
from granum import evaporation as evaporation
from granum import filtration as filtration
from granum import flowsheet as flowsheet
from granum import fluidization as fluidization
from granum import humid_gas as humid_gas
from granum import materials as materials
from granum import numerics as numerics
from granum import particles as particles
from granum import porous as porous
from granum import reports as reports
from granum import settling as settling
from granum import streams as streams
from granum import studies as studies
from granum.cases import alone as alone
from granum.cases import read as read
from granum.cases import size as size
from granum.core.search import search as search

__version__: str
