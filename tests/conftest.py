"""What all tests share."""

import os

os.environ["COLUMNS"] = "100"
"""Characters of a line: what is told fills those of the terminal, which is another one wherever tests run."""
