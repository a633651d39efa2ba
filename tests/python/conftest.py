"""Fixtures of the tests of the Python module."""

import pytest
from small_scenes import finished, floor_scene


@pytest.fixture
def floor():
    return floor_scene


@pytest.fixture
def render():
    return finished
