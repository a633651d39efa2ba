# SPDX-License-Identifier: GPL-3.0-or-later
"""Why an operator cannot run: what its button's tooltip says then."""


def can_run(kind, *conditions: tuple[bool, str]) -> bool:
    """Whether all of a poll's conditions hold; the first that does not gives its words to the tooltip."""
    for holds, words in conditions:
        if not holds:
            kind.poll_message_set(words)
            return False
    return True


def is_engine(context) -> tuple[bool, str]:
    """The condition that Gonio renders the scene."""
    return context.scene is not None and context.scene.render.engine == "GONIO", "The render engine is not Gonio"
