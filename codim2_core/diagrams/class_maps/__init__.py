"""The classes of portraits over one or two parameters, and their stretches along one."""
