"""The commands, but for the server: what they take, what they print and write."""
