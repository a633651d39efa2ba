"""Blender's shader nodes held to Cycles: the catalogue, the scenes that show it, the comparison, the page."""
