"""The explorer as one component, in a page or in a notebook."""
