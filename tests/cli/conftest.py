"""What the tests of the command line want."""

import pytest

pytest.importorskip("gonio")
pytest.importorskip("pxr")
