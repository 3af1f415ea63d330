"""Estimates with their doubt, and when they suffice."""
