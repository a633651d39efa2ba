# SPDX-License-Identifier: GPL-3.0-or-later
"""Handlers of single nodes, which register themselves here."""

# bl_idname of a node -> function(translator, node, context, output socket) -> Value
VALUES = {}
# bl_idname of a shader node -> function(translator, node, context) -> list of closures without their weights; None for what stands inside
CLOSURES = {}


def value_node(*names):
    """Registers a function that computes a node's outputs."""

    def register(function):
        VALUES.update(dict.fromkeys(names, function))
        return function

    return register


def closure_node(*names):
    """Registers a function that turns a shader node into closures."""

    def register(function):
        CLOSURES.update(dict.fromkeys(names, function))
        return function

    return register
