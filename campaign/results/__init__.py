"""From records to one dataset, and back from its file."""
