"""The plane of any two parameters: curves on which the portrait changes, where they meet, and the regions between."""
