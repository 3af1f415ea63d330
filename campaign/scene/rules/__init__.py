"""Rules that tie several keys of a scene together: a module for each section in which they are reported."""
