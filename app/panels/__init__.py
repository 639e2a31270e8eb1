"""What is beside the picture: one module a panel."""
