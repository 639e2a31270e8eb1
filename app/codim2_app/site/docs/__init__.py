"""The site: how to begin, lessons, all portraits, the theory on two pages, the public names, hosting, changes."""
