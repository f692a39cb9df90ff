"""Blender's evaluated scene, as the core's."""
