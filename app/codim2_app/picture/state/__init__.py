"""Everything that a user can set."""
