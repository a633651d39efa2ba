"""What the tests of the USD front end want."""

import pytest

pytest.importorskip("gonio")
pytest.importorskip("pxr")
