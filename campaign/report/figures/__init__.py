"""The figures of a campaign; besides these modules nothing imports matplotlib."""
