"""Speed against accuracy for one scene."""
