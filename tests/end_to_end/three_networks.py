# SPDX-License-Identifier: Apache-2.0
"""Publisher, host and receiver in three network namespaces. Each two are joined by a link of their own, that of
publisher and receiver through a switch whose cable can be pulled: their packets vanish then, and neither is told."""
import os
import subprocess
import uuid


def missing():
    """The reason why this machine cannot do that, or None."""
    if os.geteuid() != 0:
        return "network namespaces need root"
    try:
        with ThreeNetworks() as networks:
            networks.cut()
    except (subprocess.CalledProcessError, FileNotFoundError) as error:
        return f"network namespaces cannot be joined here: {error}"
    return None


class ThreeNetworks:
    AT_PUBLISHER, AT_RECEIVER = "10.78.1.1", "10.78.2.1"  # the host's addresses on its two links

    def __init__(self):
        mark = uuid.uuid4().hex[:6]
        self.names = {side: f"theatron{mark}{side}" for side in ("publisher", "host", "receiver", "switch")}
        try:
            self._join()
        except (subprocess.CalledProcessError, FileNotFoundError):
            self.close()
            raise

    def _join(self):
        for name in self.names.values():
            self._ip("netns", "add", name)
            self._ip("-n", name, "link", "set", "lo", "up")
        self._cable("host", self.AT_PUBLISHER, "publisher", "10.78.1.2")
        self._cable("host", self.AT_RECEIVER, "receiver", "10.78.2.2")
        self._ip("-n", self.names["switch"], "link", "add", "bridge", "type", "bridge")
        self._ip("-n", self.names["switch"], "link", "set", "bridge", "up")
        for side, address in (("publisher", "10.78.3.1"), ("receiver", "10.78.3.2")):
            self._cable(side, address, "switch", None)
            self._ip("-n", self.names["switch"], "link", "set", f"to_{side}", "master", "bridge")

    def _cable(self, side, address, other, other_address):
        self._ip("link", "add", f"to_{other}", "netns", self.names[side], "type", "veth",
                 "peer", "name", f"to_{side}", "netns", self.names[other])
        for name, at, to in ((self.names[side], address, other), (self.names[other], other_address, side)):
            if at:
                self._ip("-n", name, "addr", "add", f"{at}/24", "dev", f"to_{to}")
            self._ip("-n", name, "link", "set", f"to_{to}", "up")

    @staticmethod
    def _ip(*words):
        subprocess.run(["ip", *words], check=True, capture_output=True)

    def at(self, side):
        return ["ip", "netns", "exec", self.names[side]]

    def cut(self):
        self._ip("-n", self.names["switch"], "link", "set", "to_receiver", "nomaster")

    def mend(self):
        self._ip("-n", self.names["switch"], "link", "set", "to_receiver", "master", "bridge")

    def close(self):
        for name in self.names.values():
            subprocess.run(["ip", "netns", "del", name], check=False, capture_output=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
