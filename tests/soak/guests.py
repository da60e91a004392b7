# SPDX-License-Identifier: Apache-2.0
"""One guest that misbehaves for some seconds:  guests.py KIND LINK SEED SECONDS

Being thrown out is what such a guest expects; it comes again until its time is over.
"""
import contextlib
import random
import socket
import ssl
import sys
import time

from raw_peer import RawPeer, connect, connect_tls, https_get, media_message

IDLE_SOCKETS = 200
MEDIA_BYTES = 8 << 20
PAUSE_S = 0.05  # between two attempts: this is one guest, not an attack on the processor


def garbage(link, random_, end):
    """Noise before, in and after the handshakes."""
    noise = random_.randbytes(random_.randint(1, 4000))
    with connect(link, timeout=1) as stream:
        stream.sendall(noise)
    with connect_tls(link, timeout=1) as stream:
        stream.sendall(noise)
    with RawPeer(link, timeout=1) as peer:
        peer.send(noise)
        peer.wait_for_end()


def wishes(link, random_, end):
    """A flood of other codecs, key frames and questions."""
    with RawPeer(link, timeout=1) as peer:
        peer.join(name="wishes")
        while time.monotonic() < end:
            peer.send_control("ChooseCodecs", depth_codec=random_.choice(["rvl", "trvl", "zstd", "lz4", "nonsense"]),
                              color_codec="")
            peer.send_control("RequestKey", stream=random_.randint(0, 70), setting=random_.randint(0, 70))
            peer.send_control("Ping", sent_us=random_.randint(0, 9))


def dear(link, random_, end):
    """The settings that take longest to encode."""
    with RawPeer(link, timeout=1) as peer:
        peer.join(name="dear", depth_codec="zstd:level=19", color_codec="h264:crf=18")
        while time.monotonic() < end:
            peer.receive()


def idle(link, random_, end):
    """Connections on which nothing is ever said."""
    with contextlib.ExitStack() as stack:
        for _ in range(IDLE_SOCKETS):
            stack.enter_context(connect(link, timeout=1))
        time.sleep(max(0.0, end - time.monotonic()))


def deaf(link, random_, end):
    """A participant that never reads."""
    with RawPeer(link, timeout=1, receive_buffer=4096) as peer:
        peer.join(name="deaf")
        while time.monotonic() < end:
            peer.send_control("Ping", sent_us=1)
            time.sleep(PAUSE_S)


def names(link, random_, end):
    """A name that is no text; then somebody asks for the names."""
    with RawPeer(link, timeout=1) as peer:
        peer.join(name=bytes(random_.randint(128, 255) for _ in range(random_.randint(3, 120))))
        peer.receive()
        https_get(link, f"/status?token={peer.link.token}", timeout=2)


def media(link, random_, end):
    """Pictures from one who has not even joined."""
    with RawPeer(link, timeout=1) as peer:
        peer.send_media(media_message(bytes(MEDIA_BYTES)))
        peer.wait_for_end()


KINDS = {guest.__name__: guest for guest in (garbage, wishes, dear, idle, deaf, names, media)}


def main(kind, link, seed, seconds):
    end = time.monotonic() + float(seconds)
    random_ = random.Random(int(seed))
    while time.monotonic() < end:
        # Closed, refused, not answered, cut in the middle: all of them are the host's right.
        with contextlib.suppress(OSError, EOFError, ValueError, ssl.SSLError, socket.timeout):
            KINDS[kind](link, random_, end)
        time.sleep(PAUSE_S)


if __name__ == "__main__":
    main(*sys.argv[1:])
