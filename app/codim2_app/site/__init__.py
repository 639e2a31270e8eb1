"""What is read or copied elsewhere: the documentation, the notebooks, the explorer as a folder of files."""
