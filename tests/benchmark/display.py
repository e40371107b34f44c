"""An X server of one's own, and live windows on it. Nothing here needs more than Python itself."""

import json
import os
import pathlib
import subprocess
import sys
import time


class Display:
    """Its name is empty where there is no Xvfb. It stays as it is between clients: an X server that starts over takes
    50 ms, and waiting for that makes what runs next slower, by cold caches, than it is."""

    def __enter__(self):
        read, write = os.pipe()
        try:
            self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24",
                                            "-nolisten", "tcp", "-noreset"],
                                           pass_fds=[write], stderr=subprocess.DEVNULL)
        except FileNotFoundError:
            self.server = None
        os.close(write)
        number = os.fdopen(read).readline().strip()
        self.name = ":" + number if number else ""
        return self

    def __exit__(self, *_):
        if self.server:
            self.server.terminate()
            self.server.wait()


class Window:
    """A live window, and the lines of its statistics. Its light is OpenSCAD's: a line is of a finished picture, and
    the studio's light takes seconds to finish."""

    def __init__(self, program, design, folder, display):
        self.path = folder / "stats"
        self.path.unlink(missing_ok=True)
        self.process = subprocess.Popen(
            [program, "--imgsize=640,480", "--shading=openscad", f"--stats={self.path}", str(design)],
            env=dict(os.environ, DISPLAY=display, XDG_STATE_HOME=str(folder)), stderr=subprocess.DEVNULL)
        self.seen = 0
        self.next_picture()

    def next_picture(self, timeout_s=60):
        """Returns the statistics of the next one that is shown."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            if self.path.exists():
                lines = self.path.read_text().split("\n")[:-1]
                if len(lines) > self.seen:
                    self.seen = len(lines)
                    return json.loads(lines[-1])
            time.sleep(0.003)
        sys.exit("error: the window shows no picture")

    def memory_kib(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().split("\n"):
            if line.startswith("VmRSS"):
                return int(line.split()[1])

    def close(self):
        self.process.terminate()
        self.process.wait()
