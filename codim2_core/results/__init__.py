"""Results: how they are shown, compared and written to files, and all sentences about them."""
