"""A server as a process: its port, its log, its memory, and its end."""
