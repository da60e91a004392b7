# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python package share."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import patience
from theatron_process import make_recording, run

try:
    import numpy
    import theatron
except ImportError:  # built without pybind11, or run by an interpreter that is not Debian's
    numpy = theatron = None

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "examples" / "python"
STANDINS = ROOT / "tests" / "python_standins"
needs_package = unittest.skipUnless(theatron, "there is no Python package: build the target python_package, and set PYTHONPATH")


def example(name, *arguments, check=True):
    """Runs an example with the stand-ins; returns its output, or with check=False the finished process."""
    path = os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(STANDINS)])
    done = patience.run([sys.executable, EXAMPLES / name, *map(str, arguments)], env={**os.environ, "PYTHONPATH": path})
    if check and done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout if check else done


class PythonCase(unittest.TestCase):
    """A folder, in which a recording of a moving box can be made."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_python_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def record(self, name="a.mkv", frames=12, options=("--depth-codec", "zstd:delta=1"), color=True, fps=30):
        source = self.folder / "source"
        if not source.exists():
            make_recording(source, frames=frames, color=color)
        code, _, errors = run("record", "--camera", f"folder:{source},fps={fps}", *options, self.folder / name)
        self.assertIn(code, (0, 3), errors)  # 3: a busy machine passes over pictures
        return self.folder / name
