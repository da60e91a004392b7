# SPDX-License-Identifier: Apache-2.0
"""A participant, a recorder and a person who asks, behind a proxy that alone reaches the host."""
import base64
import contextlib
import os
import pathlib
import shutil
import socket
import ssl
import subprocess
import tempfile
import threading
import unittest

from theatron_process import Process, host, make_recording, run

# Only the proxy knows this name.
NAME = "or-3.example"
CREDENTIALS = "ada:open sesame"


def without_proxy():
    """The environment of a person who has none."""
    return {name: value for name, value in os.environ.items() if name.lower() not in ("https_proxy", "no_proxy")}


class Proxy:
    """Tunnels to ports of this computer, whatever the name, for those who know the password."""

    def __init__(self, answer=None, opens_tls=None):
        self.answer, self.opens_tls = answer, opens_tls
        self.asked = []
        self.listener = socket.create_server(("127.0.0.1", 0))
        threading.Thread(target=self._serve, daemon=True).start()

    def environment(self, credentials="ada:open%20sesame@"):
        return {**without_proxy(), "HTTPS_PROXY": f"http://{credentials}127.0.0.1:{self.listener.getsockname()[1]}"}

    def _serve(self):
        with contextlib.suppress(OSError):
            while True:
                threading.Thread(target=self._tunnel, args=self.listener.accept()[:1], daemon=True).start()

    def _tunnel(self, peer):
        with contextlib.suppress(OSError, ssl.SSLError), peer:
            head = b""
            while not head.endswith(b"\r\n\r\n") and (more := peer.recv(1)):
                head += more
            lines = head.decode().split("\r\n")
            self.asked.append(lines[0])
            if self.answer is not None:
                peer.sendall(self.answer)
                return
            if "Proxy-Authorization: Basic " + base64.b64encode(CREDENTIALS.encode()).decode() not in lines:
                peer.sendall(b"HTTP/1.1 407 Proxy Authentication Required\r\nProxy-Authenticate: Basic realm=x\r\n\r\n")
                return
            name, port = lines[0].split()[1].rsplit(":", 1)
            if name != NAME:
                peer.sendall(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n")
                return
            with socket.create_connection(("127.0.0.1", int(port))) as there:
                peer.sendall(b"HTTP/1.1 200 Connection established\r\n\r\n")
                if self.opens_tls:
                    peer = self.opens_tls.wrap_socket(peer, server_side=True)
                back = threading.Thread(target=self._copy, args=(there, peer), daemon=True)
                back.start()
                self._copy(peer, there)
                back.join()

    @staticmethod
    def _copy(source, target):
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                target.sendall(data)
        with contextlib.suppress(OSError):
            target.shutdown(socket.SHUT_WR)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()


class OutgoingProxy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_proxy_"))
        camera = f"folder:{make_recording(cls.folder / 'box')},loop=1,preload=1"
        cls.host = host(cls.folder / "state", camera, options=("--public-name", NAME))
        cls.link = cls.host.greeting["links"]["operator"]

    @classmethod
    def tearDownClass(cls):
        cls.host.__exit__()
        shutil.rmtree(cls.folder)

    def test_one_joins_records_and_asks_through_it(self):
        self.assertIn(f"//{NAME}:", self.link)
        file = self.folder / "room.mkv"
        with Proxy() as proxy:
            with Process("join", self.link, "--no-window", "--every", "0.2", env=proxy.environment()) as ben:
                ben.wait_for(lambda figures: figures["fps"] > 0)
            recorded, _, errors = run("record", self.link, file, "--seconds", 1, "--json", env=proxy.environment())
            self.assertIn(recorded, (0, 3), errors)  # 3: a busy machine passes over pictures
            code, said, errors = run("status", self.link, env=proxy.environment())
            self.assertEqual(code, 0, errors)
            port = self.link.split("//")[1].split("/")[0].rsplit(":", 1)[1]
            self.assertEqual(set(proxy.asked), {f"CONNECT {NAME}:{port} HTTP/1.1"})
        self.assertEqual(run("inspect", file, "--verify")[0], recorded)

    def refusal(self, proxy, command=("join", "--no-window"), credentials="ada:open%20sesame@"):
        code, _, errors = run(command[0], self.link, *command[1:], env=proxy.environment(credentials))
        self.assertNotEqual(code, 0)
        self.assertNotIn("sesame", errors)
        return errors

    def test_a_wrong_password_is_told(self):
        with Proxy() as proxy:
            for credentials in ("", "ada:closed@"):
                self.assertIn("wants a name and a password", self.refusal(proxy, credentials=credentials))

    def test_what_a_proxy_refuses_is_told(self):
        with Proxy(answer=b"HTTP/1.1 503 x\r\n\r\n") as proxy:
            self.assertIn("does not connect to it (503 Service Unavailable)", self.refusal(proxy, ["status"]))
        for answer in (b"", b"nonsense\r\n\r\n", b"HTTP/1.1 200 " + b"x" * 100000, b"HTTP/1.1 200 ok\r\n" + b"a: b\r\n" * 20000):
            with Proxy(answer=answer) as proxy:
                self.assertIn("does not answer", self.refusal(proxy, ["status"]))

    def test_a_proxy_that_opens_tls_is_named(self):
        certificate = self.folder / "other.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={NAME}", "-days", "1",
                        "-keyout", certificate, "-out", self.folder / "other.crt"], check=True, capture_output=True)
        tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        tls.load_cert_chain(self.folder / "other.crt", certificate)
        with Proxy(opens_tls=tls) as proxy:
            self.assertIn("the proxy opens encrypted connections", self.refusal(proxy))

    def test_a_setting_that_is_none_is_told(self):
        code, _, errors = run("join", self.link, "--no-window",
                              env={**without_proxy(), "https_proxy": "socks5://ada:sesame@127.0.0.1:1"})
        self.assertEqual(code, 1)
        self.assertIn("HTTPS_PROXY names a proxy of a kind that is not supported; it is written http://", errors)
        self.assertNotIn("sesame", errors)


if __name__ == "__main__":
    unittest.main()
