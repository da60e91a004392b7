# SPDX-License-Identifier: Apache-2.0
"""Has recordings examined as they are finished, one after the other, by a process that waits for everybody else."""
import json
import pathlib
import subprocess
import sys
import threading

import examine
from processes import die_with_parent

SCRIPT = pathlib.Path(examine.__file__)


class Examiner:
    """`content`: how many pictures are compared with the cameras'. Good recordings are deleted unless `keep`."""

    def __init__(self, folder, stage, content, keep):
        self.folder, self.stage, self.content, self.keep = folder, stage, content, keep
        self.files = {}  # name: findings
        self.compared = 0
        self.hashes = folder / "known.json"
        self.hashes.write_text(json.dumps(examine.known_hashes(stage.source, folder)))
        self.stopping = threading.Event()
        self.process = None
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _waiting(self, all_of_them):
        files = sorted(f for f in self.stage.recordings.glob("*.mkv") if "." not in f.stem)
        # The newest is still being written.
        return [f for f in (files if all_of_them else files[:-1]) if f.name not in self.files]

    def _run(self):
        while not self.stopping.wait(1.0):
            for path in self._waiting(all_of_them=False)[:1]:
                self._examine(path)

    def _examine(self, path):
        answer = path.with_suffix(".json")
        with_content = "yes" if self.compared < self.content else "no"
        self.process = subprocess.Popen(["nice", "-n", "19", sys.executable, SCRIPT, path, self.hashes, with_content, answer],
                                        stderr=subprocess.PIPE, text=True, preexec_fn=die_with_parent,
                                        start_new_session=True)
        errors = self.process.communicate()[1]
        if self.process.returncode != 0:
            self.files[path.name] = {"entries": {}, "bytes": path.stat().st_size,
                                     "problems": [f"cannot be examined: {errors.strip()[-300:]}"]}
            return
        found = json.loads(answer.read_text())
        answer.unlink()
        if with_content == "yes":
            self.compared += sum(len(e) for stream, e in found["entries"].items() if int(stream) % 2 == 0)
        self.files[path.name] = found
        if not self.keep and not found["problems"]:
            for file in examine.files_of(path):
                file.unlink()

    def finish(self):
        """The rest, once nothing is recorded any more."""
        self.stopping.set()
        self.thread.join()
        for path in self._waiting(all_of_them=True):
            self._examine(path)

    def close(self):
        self.stopping.set()
        if self.process and self.process.poll() is None:
            self.process.kill()
        self.thread.join()
