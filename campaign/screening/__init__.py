"""Which modelling choices of a scene matter."""
