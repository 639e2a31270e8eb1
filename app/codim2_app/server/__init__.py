"""The command, and the server with its page."""
