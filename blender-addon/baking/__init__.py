# SPDX-License-Identifier: GPL-3.0-or-later
"""Baking: what Blender's Bake operator asks for, by the renderer's pixels on surfaces."""

from .session import bake

__all__ = ["bake"]
