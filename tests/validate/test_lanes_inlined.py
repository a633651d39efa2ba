"""No operation on lanes is left as a call: what the compiler does not inline runs without its level's instructions, one call an operation."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# One operation of a level, as a function: it is there only where something calls it.
OPERATION = re.compile(r"simd_trait::Simd>::(\w+)::kernel::")


def built() -> str:
    """The program of `cargo bench`, which has all kernels."""
    command = ["cargo", "bench", "--quiet", "--package", "gonio-bench", "--bench", "stages", "--no-run", "--message-format", "json"]
    lines = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    programs = [message["executable"] for message in map(json.loads, lines) if message.get("executable")]
    assert len(programs) == 1, programs
    return str(programs[0])


@pytest.mark.validate
@pytest.mark.timeout(1800)  # Building takes minutes.
def test_no_operation_on_lanes_is_a_call() -> None:
    if shutil.which("nm") is None:
        pytest.skip("nm is not installed")
    symbols = subprocess.run(["nm", "--demangle", built()], capture_output=True, text=True, check=True).stdout
    assert "vectorize" in symbols, "the program has lost its symbols"
    assert sorted(set(OPERATION.findall(symbols))) == []
