"""One setting: the flow on the hemisphere, what it consists of, its name, and what the paper's theorems claim."""
