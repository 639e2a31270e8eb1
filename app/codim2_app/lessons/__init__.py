"""Lessons: Markdown files that talk about a live picture, and questions that the picture itself decides."""
