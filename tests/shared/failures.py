"""Runs of the command line that end with an error."""


def error_of(done, status=1):
    """The one line that a run has said."""
    assert done.returncode == status, (done.returncode, done.stderr)
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1 and lines[0].startswith("gonio: error: "), done.stderr
    return lines[0]


def fails(run, *arguments, status=1):
    """The one line that the run of these arguments says."""
    return error_of(run(*arguments), status)
