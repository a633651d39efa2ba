"""A thousand malformed variants of ten stages: no crash, no hang, one clear message each.

GONIO_VARIANTS says how many, GONIO_VARIANTS_LEDGER names the file of a run that goes on where the last one ended.
"""

import os
import pathlib

import malformed
import pytest

COUNT = int(os.environ.get("GONIO_VARIANTS", malformed.COUNT))


@pytest.mark.validate
@pytest.mark.timeout(7200)
def test_malformed_variants(run, tmp_path):
    pytest.importorskip("pxr")
    ledger = os.environ.get("GONIO_VARIANTS_LEDGER")
    known = malformed.judge_all(run, tmp_path, COUNT, ledger and pathlib.Path(ledger))
    assert len(known) >= COUNT
    faults = malformed.faults_of(known)
    assert not faults, "\n".join(faults)
