"""Balances of whole dryers: solids, moisture, gas and heat, with any consistent set of knowns."""
