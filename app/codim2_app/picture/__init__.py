"""The picture: what a user can set, the frame under way, shapes and colours."""
