"""What the tests of the USD front end share."""

import pytest

pytest.importorskip("gonio")
pytest.importorskip("pxr")
