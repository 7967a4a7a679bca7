"""Runs the program, tells how far it is and stops it. Knows nothing of Cura."""
import json
import subprocess
import sys
import threading

from .command import environment_for

CANCELLED = 4  # the program's exit code


class Program:
    """One run. start() blocks until it ends; cancel() may come from any thread, also before start()."""

    def __init__(self, path, arguments, environment):
        self._command = [path] + list(arguments)
        self._environment = environment_for(path, environment)
        self._lock = threading.Lock()
        self._process = None
        self._is_cancelled = False

    def start(self, on_progress):
        """(exit code, the lines that it said). on_progress(share done, stage) is called for each step."""
        with self._lock:
            if self._is_cancelled:
                return CANCELLED, []
            flags = {"creationflags": 0x08000000} if sys.platform == "win32" else {}  # no console window
            self._process = subprocess.Popen(self._command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                             stderr=subprocess.STDOUT, env=self._environment, **flags)
        said = []
        with self._process.stdout as stream:
            for raw in stream:
                line = raw.decode("utf-8", "replace").rstrip("\r\n")
                progress = progress_of(line)
                if progress:
                    on_progress(*progress)
                else:
                    said.append(line)
        code = self._process.wait()
        return (CANCELLED if self._is_cancelled else code), said

    def cancel(self):
        with self._lock:
            self._is_cancelled = True
            if self._process and self._process.poll() is None:
                self._process.terminate()


def progress_of(line):
    """(share done, stage) of a line of progress; None for any other."""
    if not line.startswith("{"):
        return None
    try:
        told = json.loads(line)
        return float(told["progress"]), str(told["stage"])
    except (ValueError, KeyError, TypeError):
        return None
