# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits of an extension's properties reach the viewport only when their data-block is tagged."""


def tag_data(settings, _context) -> None:
    """An `update` callback: tells the dependency graph that the data-block of these settings changed."""
    if settings.id_data is not None:
        settings.id_data.update_tag()


def tag_passes(settings, context) -> None:
    """An `update` callback: sockets of Render Layers nodes follow the passes."""
    tag_data(settings, context)
    if context is not None and context.view_layer is not None:
        context.view_layer.update_render_passes()
