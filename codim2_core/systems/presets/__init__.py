"""The paper's figures as data: the presets."""
