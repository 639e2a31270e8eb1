"""The explorer as a folder of files: a worker in the visitor's browser is its server."""
