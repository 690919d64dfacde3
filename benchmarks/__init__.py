"""Granum beside its peers: ``python -m benchmarks`` runs every script, ``python -m benchmarks.NAME`` one."""
