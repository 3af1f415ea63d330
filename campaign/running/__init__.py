"""A campaign under way: hand-out, one rank's work, the directory, the account, and what the user reads."""
