"""Campaigns beside each other: realizations that all of them have, and what differs from the first campaign."""
