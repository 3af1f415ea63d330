"""Constants of nature and of the machine."""

STANDARD_GRAVITY = 9.81  # m/s2

LANE_COUNT = 8
"""Numbers that a kernel treats at once (``lanes``): those of an AVX-512 register."""
