# SPDX-License-Identifier: Apache-2.0
"""A folder on a disk that stalls, fails or is full when a test says so (tests/slow_disk)."""
import os
import pathlib

LIBRARY = os.environ.get("THEATRON_SLOW_DISK", "build/release/tests/slow_disk/libslow_disk.so")


class SlowDisk:
    """`folder` is new and empty, inside `parent`; programs started with `environment` see its faults."""

    def __init__(self, parent):
        parent = pathlib.Path(parent).resolve()
        self.folder = parent / "disk"
        self.folder.mkdir()
        self.control = parent / "disk.control"
        self.be("well")
        self.environment = dict(os.environ, LD_PRELOAD=str(pathlib.Path(LIBRARY).resolve()),
                                SLOW_DISK_FOLDER=str(self.folder), SLOW_DISK_CONTROL=str(self.control))

    def be(self, state):
        """From now on: well, stall, slow MILLISECONDS, full, error or gone."""
        new = self.control.with_suffix(".new")
        new.write_text(state)
        new.rename(self.control)
