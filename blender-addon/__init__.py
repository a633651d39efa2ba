# SPDX-License-Identifier: GPL-3.0-or-later
"""Gonio in Blender: a render engine that opens an existing file and gives the same picture, in physical units."""

import importlib

# Each rank imports lower ones only; they register in this order and unregister in the opposite one.
RANKS = ("properties", "nodes", "operators", "engine", "ui")


def _modules():
    return [importlib.import_module(f".{rank}", __package__) for rank in RANKS]


def register() -> None:
    done = []
    try:
        for module in _modules():
            module.register()
            done.append(module)
    except Exception:
        # An engine that stays registered after a failure can hang Blender at its exit.
        for module in reversed(done):
            module.unregister()
        raise


def unregister() -> None:
    for module in reversed(_modules()):
        module.unregister()
