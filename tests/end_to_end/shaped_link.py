# SPDX-License-Identifier: Apache-2.0
"""Host and viewer in two network namespaces, joined by a link that a script shapes."""
import os
import pathlib
import subprocess
import uuid

SHAPER = pathlib.Path(os.environ.get("THEATRON_LINK_SHAPER", "build/release/tools/link_shaper"))
HOST_ADDRESS = "10.77.0.1"


def missing():
    """The reason why this machine cannot shape links, or None."""
    if os.geteuid() != 0:
        return "shaping a link needs root"
    if not pathlib.Path("/dev/net/tun").exists():
        return "this machine has no /dev/net/tun"
    if not SHAPER.exists():
        return "link_shaper has not been built"
    name = f"theatron{uuid.uuid4().hex[:8]}"
    if subprocess.run(["ip", "netns", "add", name], capture_output=True).returncode != 0:
        return "network namespaces cannot be made here"
    # Not where the root is no mount of its own.
    joined = subprocess.run(["ip", "-n", name, "link", "set", "lo", "up"], capture_output=True).returncode == 0
    subprocess.run(["ip", "netns", "del", name], check=False)
    return None if joined else "network namespaces cannot be joined here"


class ShapedLink:
    """settings: words of link_shaper, for example ["delay_ms=30", "--at", "10", "rate=25%"]."""

    def __init__(self, *settings, priority=()):
        mark = uuid.uuid4().hex[:8]
        self.names = [f"theatron{mark}{side}" for side in "ab"]
        for name in self.names:
            subprocess.run(["ip", "netns", "add", name], check=True)
            subprocess.run(["ip", "-n", name, "link", "set", "lo", "up"], check=True)
        self.shaper = subprocess.Popen([*priority, SHAPER, *self.names, *map(str, settings)], stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, text=True)
        if self.shaper.stdout.readline() != "ready\n":
            self.close()
            raise AssertionError("the link shaper did not start")

    def at_host(self):
        return ["ip", "netns", "exec", self.names[0]]

    def at_viewer(self):
        return ["ip", "netns", "exec", self.names[1]]

    def begin(self):
        """The times of the script count from now."""
        self.shaper.stdin.write("begin\n")
        self.shaper.stdin.flush()

    def change(self, *settings):
        """These settings hold from now on."""
        self.shaper.stdin.write(" ".join(map(str, settings)) + "\n")
        self.shaper.stdin.flush()

    def close(self):
        self.shaper.kill()
        self.shaper.wait()
        self.shaper.stdin.close()
        self.shaper.stdout.close()
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], check=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
