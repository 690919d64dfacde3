"""Gas–solid contact in cells: the core that the distributed dryers share."""
