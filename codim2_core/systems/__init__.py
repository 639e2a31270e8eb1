"""Systems: e-linear and typed systems, Psi, mechanisms, examples, the paper's figures as presets."""
