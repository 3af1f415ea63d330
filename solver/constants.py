"""Constants of nature."""

STANDARD_GRAVITY = 9.81  # m/s2
