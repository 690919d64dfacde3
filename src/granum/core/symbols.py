"""Symbols of quantities: from LaTeX to HTML for charts and to plain text for the terminal."""

from __future__ import annotations

import re

_CHARACTERS = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "Delta": "Δ",
    "varepsilon": "ε",
    "epsilon": "ε",
    "eta": "η",
    "theta": "θ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "varphi": "φ",
    "phi": "φ",
    "psi": "ψ",
    "Psi": "Ψ",
    "omega": "ω",
    "Omega": "Ω",
    "kappa": "κ",
    "chi": "χ",
    "zeta": "ζ",
    "Gamma": "Γ",
    "Sigma": "Σ",
    "Phi": "Φ",
    "Lambda": "Λ",
    "infty": "∞",
    "partial": "∂",
    "perp": "⊥",
    "int": "∫",
    "ln": "ln ",
}


def html_symbol(latex: str) -> str:
    """A short LaTeX symbol (Greek, one subscript or superscript, a dot) as HTML."""
    text = re.sub(r"\\(?:mathrm|text|mathit)\{([^{}]*)\}", r"\1", latex)
    text = re.sub(r"\\dot\s*\{?(\\?\w+)\}?", lambda m: m.group(1) + "\u0307", text)
    text = re.sub(r"\\(?:bar|overline)\s*\{?(\\?\w+)\}?", lambda m: m.group(1) + "\u0304", text)
    text = re.sub(r"\\tilde\s*\{?(\\?\w+)\}?", lambda m: m.group(1) + "\u0303", text)
    text = re.sub(r"\\,\s*", " ", text)
    text = re.sub(r"\\([A-Za-z]+)\s*", lambda m: _CHARACTERS.get(m.group(1), m.group(1)), text)
    text = re.sub(r"_\{([^{}]*)\}|_([\w∞⊥])", lambda m: f"<sub>{m.group(1) or m.group(2)}</sub>", text)
    text = re.sub(r"\^\{([^{}]*)\}|\^([\w*∞])", lambda m: f"<sup>{m.group(1) or m.group(2)}</sup>", text)
    return text.replace("{", "").replace("}", "").replace("\\", "")


def text_symbol(latex: str) -> str:
    """The same symbol as plain text.

    >>> text_symbol(r"\\rho_p"), text_symbol(r"\\mathrm{Re}"), text_symbol(r"\\Delta H^\\infty")
    ('ρ_p', 'Re', 'ΔH^∞')
    """
    html = html_symbol(latex)
    html = re.sub(r"<sub>(.*?)</sub>", r"_\1", html)
    return re.sub(r"<sup>(.*?)</sup>", r"^\1", html)
