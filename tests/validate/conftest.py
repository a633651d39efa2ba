"""The marker of the long comparisons with other renderers."""

import pytest


def pytest_configure(config: pytest.Config) -> None:
    """Makes the marker known."""
    config.addinivalue_line("markers", "validate: long checks against other renderers, left out of the gate")
