"""Rooms: the present settings of many phones on one lecturer's atlas, for as long as the room is open."""
