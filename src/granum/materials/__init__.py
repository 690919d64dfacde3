"""Materials: fluids, solids, solutes and their solubility, gas–vapor pairs."""

from granum.core.registry import domain_names

__getattr__, __dir__ = domain_names(
    __name__, "fluid", "gas_vapor", "load", "names", "salt", "solid", "solute"
)
