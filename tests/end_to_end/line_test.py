# SPDX-License-Identifier: Apache-2.0
"""What a page measures its line with: bounded bytes for who has a link, also while somebody asks without an end."""
import pathlib
import tempfile
import unittest

from raw_peer import Link, connect_tls, https_request
from theatron_process import Process, host

CAMERA = "synthetic:seconds=2,fps=10,quality=quick,loop=1"
MOST_DOWN, MOST_UP = 2 << 20, 256 << 10


class Line(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="theatron_e2e_")
        self.addCleanup(temporary.cleanup)
        self.state = pathlib.Path(temporary.name) / "state"

    def ask(self, link, method="GET", query="", body=b"", token=None):
        headers = [f"Authorization: Bearer {Link.parse(link).token if token is None else token}"]
        if method == "POST":
            headers.append(f"Content-Length: {len(body)}")
        return https_request(link, method, "/line" + query, headers=headers, body=body)

    def test_who_has_a_link_gets_and_gives_bounded_bytes(self):
        with host(self.state) as h:
            for role, link in h.greeting["links"].items():
                with self.subTest(role):
                    status, headers, body = self.ask(link, query="?bytes=100000&n=1")
                    self.assertEqual((status, len(body), headers["cache-control"]), (200, 100000, "no-store"))
                    self.assertEqual(self.ask(link)[::2], (200, b""))
                    for size in (0, 1, 20000, MOST_UP):
                        self.assertEqual(self.ask(link, "POST", body=b"x" * size)[::2], (204, b""))
            link = h.greeting["link"]
            self.assertEqual(len(self.ask(link, query=f"?bytes={MOST_DOWN}")[2]), MOST_DOWN)
            for query in (f"?bytes={MOST_DOWN + 1}", "?bytes=-1", "?bytes=x"):
                self.assertEqual(self.ask(link, query=query)[0], 400)
            self.assertEqual(self.ask(link, "HEAD", "?bytes=100")[::2], (200, b""))

    def test_strangers_and_larger_bodies_are_refused_before_they_are_read(self):
        with host(self.state) as h:
            link = h.greeting["link"]
            for token in ("", "wrong"):
                self.assertEqual(self.ask(link, query="?bytes=1000", token=token)[0], 401)
                self.assertEqual(self.ask(link, "POST", body=b"x" * 1000, token=token)[0], 401)
            known = f"Authorization: Bearer {Link.parse(link).token}"
            for length in (MOST_UP + 1, 10 ** 15):
                self.assertEqual(https_request(link, "POST", "/line", headers=[known, f"Content-Length: {length}"])[0], 413)
            # Without a length, and anywhere else, no request has a body.
            for headers, target in (([known], "/line"), ([known, "Transfer-Encoding: chunked"], "/line"),
                                    ([known, "Content-Length: 5"], "/status")):
                status, answered, _ = https_request(link, "POST", target, headers=headers)
                self.assertEqual((status, answered["allow"]), (405, "GET, HEAD"))
            self.assertEqual(https_request(link, "GET", "/line")[0], 401)

    def test_a_body_that_breaks_off_or_stops_costs_its_connection_alone(self):
        with host(self.state) as h:
            link = Link.parse(h.greeting["link"])
            begun = (f"POST /line HTTP/1.1\r\nHost: or\r\nAuthorization: Bearer {link.token}\r\nContent-Length: 1000\r\n\r\n").encode()
            with connect_tls(link) as stream:
                stream.sendall(begun + b"x" * 10)
            with connect_tls(link) as stream:
                stream.sendall(begun + b"x" * 10)
                self.assertEqual(stream.recv(100), b"", "ended without an answer")
            self.assertEqual(self.ask(h.greeting["link"], "POST", body=b"x" * 100)[0], 204)

    def test_a_flood_is_refused_and_a_session_goes_on(self):
        with host(self.state, CAMERA) as h, Process("join", h.greeting["link"], "--name", "Ada", "--no-window", "--every", "0.2") as ada:
            frames = ada.wait_for(lambda f: f["cameras"][0]["frames"] > 5)["cameras"][0]["frames"]
            bytes_got = refused = 0
            for _ in range(20):
                status, headers, body = self.ask(h.greeting["links"]["observer"], query=f"?bytes={MOST_DOWN}")
                self.assertIn(status, (200, 429))
                bytes_got += len(body) if status == 200 else 0
                if status == 429:
                    refused += 1
                    self.assertEqual(headers["retry-after"], "30")
                    self.assertIn(b"try again", body)
            self.assertGreater(refused, 0)
            self.assertGreaterEqual(bytes_got, MOST_DOWN)
            ada.wait_for(lambda f: f["cameras"][0]["frames"] > frames + 20)


if __name__ == "__main__":
    unittest.main()
