"""The paper's theorems, evaluated on the present system."""
