"""Time of the processor, which other work on the machine lengthens less than that of the clock."""

import resource


def processor_seconds() -> float:
    """What all threads of this process have used."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime
