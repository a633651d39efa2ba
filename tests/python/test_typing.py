"""The stubs say what the module has."""

import os
import subprocess
import sys

import gonio
import pytest


@pytest.mark.timeout(240)
def test_stubs_match_the_module(tmp_path, pytestconfig):
    pytest.importorskip("mypy")
    # Half a minute goes into numpy's own stubs; the cache keeps what was found.
    environment = {**os.environ, "MYPY_CACHE_DIR": str(pytestconfig.cache.mkdir("mypy"))}
    line = [sys.executable, "-m", "mypy.stubtest", "gonio._gonio"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=environment, timeout=230)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.timeout(240)
def test_the_package_is_typed(tmp_path, pytestconfig):
    pytest.importorskip("mypy")
    environment = {**os.environ, "MYPY_CACHE_DIR": str(pytestconfig.cache.mkdir("mypy"))}
    line = [sys.executable, "-m", "mypy", "--strict", "-m", "gonio.scene"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=environment, timeout=230)
    assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_has_words():
    things = {name: getattr(gonio, name) for name in gonio.__all__ if not isinstance(getattr(gonio, name), str)}
    silent = [name for name, thing in things.items() if not thing.__doc__]
    for name, thing in things.items():
        classes = [base for base in thing.__mro__ if base.__module__.startswith("gonio")] if isinstance(thing, type) else []
        members = [member for base in classes for member in vars(base) if not member.startswith("_")]
        silent += [f"{name}.{member}" for member in members if not getattr(thing, member).__doc__]
    assert not silent


def test_the_simd_level_is_known():
    assert gonio.simd_level in {"avx512", "avx2", "sse4.2", "sse42", "neon", "scalar"}
