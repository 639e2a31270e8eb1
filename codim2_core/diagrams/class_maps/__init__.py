"""The atlas of any system over two parameters, or along one: regions of one class, and what happens between them."""
