"""The site: documentation, notebooks, and the explorer as a folder of files."""
