import contextlib
import os
import pathlib


def hurry():
    """CuraEngine makes way for all else (nice 10), so that beside other tests it takes ten times as long: where one may, it gets its turn again."""
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has ended, or one may not
            pid, _, rest = stat.read_text().partition(" (CuraEngine) ")
            if rest and int(rest.split()[1]) == os.getpid():
                os.setpriority(os.PRIO_PROCESS, int(pid), 0)
