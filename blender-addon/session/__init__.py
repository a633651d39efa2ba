# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything between Blender's callbacks and the renderer; needs no window and no engine instance."""

from .final import FinalSession
from .viewport import ViewportSession

__all__ = ["FinalSession", "ViewportSession"]
