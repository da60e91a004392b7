# SPDX-License-Identifier: Apache-2.0
"""An organisation's own certificate, and what the host's port answers to requests of all kinds."""
import hashlib
import json
import os
import pathlib
import socket
import ssl
import subprocess
import tempfile
import unittest

from raw_peer import Link, RawPeer, connect_tls, https_request
from theatron_process import host, run, wait_until


def make_certificate(folder, name, days=90):
    """NAME.pem and NAME.key for localhost; returns the fingerprint."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                    "-subj", f"/CN={name}", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1", "-days", str(days),
                    "-keyout", folder / f"{name}.key", "-out", folder / f"{name}.pem"], check=True, capture_output=True)
    return hashlib.sha256(ssl.PEM_cert_to_DER_cert((folder / f"{name}.pem").read_text())).hexdigest()


def shown_fingerprint(link):
    """The fingerprint of the certificate that the port shows now."""
    with connect_tls(link) as stream:
        return hashlib.sha256(stream.getpeercert(binary_form=True)).hexdigest()


class Https(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="theatron_e2e_")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.state = self.folder / "state"
        self.files = ["--certificate", self.folder / "or.pem", "--key", self.folder / "or.key"]

    def install(self, certificate, key=None):
        """Puts a pair where the host looks, as certbot does: one file after the other, each at once."""
        for ending, source in ((".pem", certificate), (".key", key or certificate)):
            draft = self.folder / f"draft{ending}"
            draft.write_bytes((self.folder / f"{source}{ending}").read_bytes())
            draft.chmod(0o600)
            os.replace(draft, self.folder / f"or{ending}")

    def test_a_renewed_certificate_is_shown_without_a_restart_and_a_broken_one_is_not(self):
        first, second = make_certificate(self.folder, "first"), make_certificate(self.folder, "second")
        self.install("first")
        with host(self.state, options=self.files) as h:
            link = h.greeting["link"]
            self.assertEqual(Link.parse(link).fingerprint, first)

            def status(new_link):
                code, out, errors = run("status", new_link, "--json")
                self.assertEqual(code, 0, errors)
                return json.loads(out)["certificates"][0]

            self.assertEqual(status(link)["problem"], "")
            with RawPeer(link) as peer:
                peer.join()
                peer.receive_control("Welcome")
                self.install("second")
                wait_until(lambda: shown_fingerprint(link) == second)
                # Participants who are in stay in.
                peer.send_control("Ping", sent_us=1)
                peer.receive_control("Pong")
            wait_until(lambda: any("links changed with the certificate" in line for line in h.errors))
            code, out, errors = run("link", "--state", self.state, "--show", "expert")
            self.assertEqual(code, 0, errors)
            new_link = out.strip()
            self.assertEqual(Link.parse(new_link).fingerprint, second)

            self.install("first", key="second")
            wait_until(lambda: "was made for another key than" in status(new_link)["problem"])
            self.assertEqual(shown_fingerprint(link), second)
            self.assertIn("stays in use", run("status", new_link)[1])
            self.assertTrue(any("was made for another key than" in line for line in h.errors), h.errors)
            # A pipe is not waited for: links are still revoked, and good files are read again.
            (self.folder / "or.pem").unlink()
            os.mkfifo(self.folder / "or.pem")
            wait_until(lambda: "is no file" in status(new_link)["problem"])
            self.install("second")
            wait_until(lambda: status(new_link)["problem"] == "")
            self.install("first", key="second")
            wait_until(lambda: "was made for another key than" in status(new_link)["problem"])
            token = (self.state / "metrics.token").read_text().strip()
            metrics = https_request(link, "GET", "/metrics", headers=[f"Authorization: Bearer {token}"])[2].decode()
            self.assertIn('theatron_certificate_problem{of="host"} 1', metrics)

            self.install("second")
            wait_until(lambda: status(new_link)["problem"] == "")
            # Certificates of the test are for 90 days.
            self.assertAlmostEqual(status(new_link)["seconds_left"], 90 * 24 * 3600, delta=600)

    def test_hsts_is_sent_only_where_it_was_asked_for_and_has_a_certificate(self):
        code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.state, "--hsts", "--seconds", "0.2")
        self.assertEqual(code, 1)
        self.assertIn("add --certificate and --key", errors)

        make_certificate(self.folder, "or")
        for options, expected in ((self.files, None), ([*self.files, "--hsts"], "max-age=31536000")):
            with self.subTest(options), host(self.state, options=options) as h:
                for target in ("/", "/status", "/nothing"):
                    _, headers, _ = https_request(h.greeting["link"], "GET", target)
                    self.assertEqual(headers.get("strict-transport-security"), expected)

    def test_head_is_get_without_its_body_and_other_methods_are_refused(self):
        with host(self.state) as h:
            link = h.greeting["link"]
            for target in ("/", "/status", f"/status?token={Link.parse(link).token}", "/nothing"):
                with self.subTest(target):
                    got, asked = https_request(link, "GET", target), https_request(link, "HEAD", target)
                    self.assertEqual(asked[0], got[0])
                    self.assertEqual(asked[1].keys(), got[1].keys())
                    self.assertEqual(got[1]["content-length"], str(len(got[2])))
                    self.assertGreater(int(asked[1]["content-length"]), 0)
                    self.assertEqual(asked[2], b"")
            upgrade = ["Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: eA=="]
            for method, options in (("POST", {"headers": ["Content-Length: 5"], "body": b"hello"}), ("PUT", {}),
                                    ("DELETE", {}), ("OPTIONS", {}), ("TRACE", {}), ("BREW", {}),
                                    ("POST", {"headers": upgrade})):
                with self.subTest(method):
                    status, headers, body = https_request(link, method, "/", **options)
                    self.assertEqual((status, headers["allow"]), (405, "GET, HEAD"))
                    self.assertTrue(body)

    def test_http_without_tls_gets_one_sentence(self):
        with host(self.state) as h:
            link = Link.parse(h.greeting["link"])
            for request in (b"GET / HTTP/1.1\r\nHost: or-3\r\n\r\n",
                            b"POST / HTTP/1.1\r\nHost: or-3\r\nContent-Length: 30000\r\n\r\n" + b"x" * 30000):
                with self.subTest(request[:8]), socket.create_connection((link.host, link.port), timeout=10) as stream:
                    stream.sendall(request)
                    stream.shutdown(socket.SHUT_WR)
                    answer = b""
                    while data := stream.recv(4096):
                        answer += data
                    head, _, body = answer.partition(b"\r\n\r\n")
                    self.assertTrue(head.startswith(b"HTTP/1.1 400 "), answer)
                    self.assertNotIn(b"location", head.lower())
                    self.assertIn(b"https://", body)

    def test_a_host_with_a_name_refuses_others(self):
        with host(self.state, options=["--public-name", "OR-3.hospital.example"]) as h:
            self.assertRegex(h.greeting["link"], r"^https://or-3\.hospital\.example:\d+/#")
            here = Link.parse(h.greeting["link"])._replace(host="127.0.0.1")
            for name, status in (("or-3.hospital.example", 200), ("or-3.hospital.example:4400", 200), ("127.0.0.1", 200),
                                 ("localhost:1", 200), ("evil.example", 421), ("or-3.hospital.example.evil.example", 421)):
                with self.subTest(name):
                    self.assertEqual(https_request(here, "GET", "/", name=name)[0], status)
            with self.assertRaisesRegex(ConnectionRefusedError, "421"):
                RawPeer(here, name="evil.example", headers=["Origin: https://evil.example"])
            with self.assertRaisesRegex(ConnectionRefusedError, "403"):
                RawPeer(here, name="or-3.hospital.example", headers=["Origin: https://evil.example"])
            with RawPeer(here, name=f"or-3.hospital.example:{here.port}",
                         headers=[f"Origin: https://or-3.hospital.example:{here.port}"]) as peer:
                peer.join()
                peer.receive_control("Welcome")

    def test_options_that_do_not_fit_together_are_refused_with_a_sentence(self):
        make_certificate(self.folder, "or")
        for options, part in ((["--behind-proxy", "127.0.0.1"], "needs --public-name"),
                              (["--proxy-certificate", self.folder / "or.pem"], "add --behind-proxy"),
                              (["--public-name", "or-3", "--link-host", "or-4"], "leave out --link-host"),
                              (["--public-name", "https://or-3"], "no public name"),
                              (["--behind-proxy", "nginx", "--public-name", "or-3", "--proxy-certificate",
                                self.folder / "or.pem"], "no address of a proxy")):
            with self.subTest(options):
                code, _, errors = run("host", "--listen", "127.0.0.1:0", "--state", self.state, "--seconds", "0.2", *options)
                self.assertEqual(code, 1)
                self.assertIn(part, errors)


if __name__ == "__main__":
    unittest.main()
