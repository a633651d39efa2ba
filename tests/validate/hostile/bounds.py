"""What a run on hostile input may take and say."""

import resource

# Addresses that a run may have, bytes, and time of the processor, seconds: that of the clock depends on what else runs.
MOST, LONGEST = 6 << 30, 120
BAD_WORDS = ("Traceback", "panicked", "RUST_BACKTRACE", "Segmentation", "memory allocation of", "core dumped", "Aborted", "broke down")


def limited():
    """Has a child get no more than that."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST, MOST))
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))


def judged(done, statuses=(0, 1), longest=800):
    """The run, if it ended in order: one line for an error, of no more letters than that, and no word of a crash."""
    assert done.returncode in statuses and not any(word in done.stderr for word in BAD_WORDS), (done.returncode, done.stderr[-2000:])
    errors = [line for line in done.stderr.splitlines() if line.startswith("gonio: error: ")]
    assert len(errors) == (done.returncode != 0), done.stderr[-2000:]
    assert all(len(line) < longest for line in errors), "an error is one line that can be read"
    return done


def refused(done, name=""):
    """The one line of a run that could not be; it names what was wrong."""
    assert judged(done).returncode == 1, "it was taken"
    line = next(line for line in done.stderr.splitlines() if line.startswith("gonio: error: "))
    assert name in line, line
    return line
