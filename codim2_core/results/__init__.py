"""What every result can do, and every sentence: shown, compared, written to files, read aloud."""
