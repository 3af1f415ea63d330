"""Constants of nature."""

STANDARD_GRAVITY = 9.81  # m/s2

LANES = 8
"""Numbers that a kernel treats at once (``lanes``): those of an AVX-512 register."""
