"""Put the pointwise laws of the solver's tests where verification can import them."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "solver"))
