"""One realization: what all share, and one simulated."""
