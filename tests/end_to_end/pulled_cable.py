# SPDX-License-Identifier: Apache-2.0
"""A cable between participants and a host that breaks as real ones do: the participants lose their connections, the host notices nothing."""
import contextlib
import socket
import threading

from raw_peer import Link


class PulledCable:
    """Listens in front of the host of `link`; `through(link)` is the way of a link of that host through it."""

    def __init__(self, link):
        self.port = Link.parse(link).port
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.guard = threading.Lock()
        self.ends = []  # of participants, whose connections stand
        self.kept = []  # at the host
        self.thread = threading.Thread(target=self._listen, daemon=True)
        self.thread.start()

    def through(self, link):
        return str(Link.parse(link)._replace(port=self.listener.getsockname()[1]))

    def _listen(self):
        while True:
            try:
                participant, _ = self.listener.accept()
            except OSError:
                return
            try:
                host = socket.create_connection(("127.0.0.1", self.port))
            except OSError:  # the host is away
                participant.close()
                continue
            with self.guard:
                self.ends.append(participant)
                self.kept.append(host)
            for source, sink in ((participant, host), (host, participant)):
                threading.Thread(target=self._carry, args=(participant, source, sink), daemon=True).start()

    def _carry(self, participant, source, sink):
        with contextlib.suppress(OSError):
            while data := source.recv(1 << 16):
                with self.guard:
                    if participant not in self.ends:
                        return
                sink.sendall(data)
        with self.guard:
            stands = participant in self.ends
        if stands:
            with contextlib.suppress(OSError):
                sink.shutdown(socket.SHUT_RDWR)

    def pull(self):
        """All connections break at the participants' side alone, and new ones can be made."""
        with self.guard:
            broken, self.ends = self.ends, []
        for participant in broken:
            with contextlib.suppress(OSError):
                participant.shutdown(socket.SHUT_RDWR)
            participant.close()

    def close(self):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.thread.join(5)
        self.pull()
        for host in self.kept:
            with contextlib.suppress(OSError):
                host.shutdown(socket.SHUT_RDWR)
            host.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
