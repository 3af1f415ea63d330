"""Put the bodies of the verification ladder where the atlas can import them."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "verification"))
