# SPDX-License-Identifier: Apache-2.0
"""A host behind nginx, with the configuration in examples/proxy."""
import contextlib
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import unittest

from https_test import make_certificate
import patience
from raw_peer import Link, RawPeer, https_request
from theatron_process import Process, host, wait_until

NGINX = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin")
EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/proxy/nginx.conf"
# Its master process, too, is an ordinary user's.
USER = {"user": "nobody", "group": "nogroup", "extra_groups": []} if os.geteuid() == 0 else {}

MAIN = """daemon off;
error_log stderr;
pid {folder}/pid;
worker_processes 1;
events {{ }}
http {{
    access_log off;
    client_body_temp_path {folder}; proxy_temp_path {folder}; fastcgi_temp_path {folder};
    uwsgi_temp_path {folder}; scgi_temp_path {folder};
    include {folder}/site.conf;
}}
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def nginx(folder, site, port):
    """The server while it answers at this port. It may read only `folder`."""
    (folder / "site.conf").write_text(site)
    (folder / "nginx.conf").write_text(MAIN.format(folder=folder))
    if USER:
        for path in (folder, *folder.iterdir()):
            shutil.chown(path, USER["user"], USER["group"])
    process = subprocess.Popen([NGINX, "-e", "stderr", "-p", folder, "-c", folder / "nginx.conf"],
                               stderr=subprocess.PIPE, text=True, **USER)

    def answers():
        if process.poll() is not None:
            raise AssertionError("nginx ended: " + process.stderr.read())
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
            return True

    try:
        wait_until(answers)
        yield process
    finally:
        process.terminate()
        patience.end_of(process)
        process.stderr.close()


@unittest.skipUnless(NGINX, "nginx is not installed: apt-get install nginx-light")
class BehindNginx(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.addClassCleanup(cls.stack.close)
        folder = pathlib.Path(cls.stack.enter_context(tempfile.TemporaryDirectory(prefix="theatron_e2e_")))
        folder.chmod(0o755)  # nginx goes through it
        proxy = folder / "proxy"
        proxy.mkdir()
        fingerprint = make_certificate(proxy, "proxy")
        port = free_port()
        shutil.copy(proxy / "proxy.pem", folder / "proxy.pem")
        cls.host = cls.stack.enter_context(host(folder / "host", options=[
            "--behind-proxy", "127.0.0.1", "--public-name", f"localhost:{port}", "--proxy-certificate", folder / "proxy.pem"]))
        cls.link = Link.parse(cls.host.greeting["link"])
        assert (cls.link.port, cls.link.fingerprint) == (port, fingerprint), cls.link
        shutil.copy(folder / "host/host.crt", proxy)

        site = EXAMPLE.read_text()
        for ours, theirs in (("listen 443 ssl", f"listen 127.0.0.1:{port} ssl"),
                             ("server_name or-3.hospital.example", "server_name localhost"),
                             ("https://127.0.0.1:4400", f"https://127.0.0.1:{cls.host.greeting['port']}"),
                             ("/etc/ssl/or-3/fullchain.pem", str(proxy / "proxy.pem")),
                             ("/etc/ssl/or-3/privkey.pem", str(proxy / "proxy.key")),
                             ("/etc/ssl/or-3/host.crt", str(proxy / "host.crt"))):
            assert ours in site, ours
            site = site.replace(ours, theirs)
        cls.stack.enter_context(nginx(proxy, site, port))

    def lines(self, *words):
        """The lines of the host's log with all of these words."""
        return [line for line in self.host.errors if all(word in line for word in words)]

    def test_a_native_participant_joins_by_the_printed_link(self):
        with Process("join", self.host.greeting["link"], "--no-window", "--every", "0.1", "--name", "through nginx") as viewer:
            viewer.wait_for(lambda f: f["joins"] == 1)
        wait_until(lambda: self.lines("joined", "through nginx", "address=127.0.0.1"))

    def test_a_page_connects_from_the_public_name_only(self):
        here = self.link._replace(host="127.0.0.1")
        with RawPeer(here, name=f"localhost:{here.port}", headers=[f"Origin: https://localhost:{here.port}"]) as peer:
            peer.join(name="page")
            peer.receive_control("Welcome")
        with self.assertRaisesRegex(ConnectionRefusedError, "403"):
            RawPeer(here, name=f"localhost:{here.port}", headers=["Origin: https://evil.example"])
        with self.assertRaisesRegex(ConnectionRefusedError, "421"):
            RawPeer(here, name="evil.example", headers=["Origin: https://evil.example"])
        status, headers, body = https_request(here, "HEAD", "/")
        self.assertEqual((status, body), (200, b""))
        self.assertIn("content-length", headers)

    def test_the_address_is_that_of_the_client_whatever_it_says_itself(self):
        here = self.link._replace(host="127.0.0.1")
        invented = ["X-Forwarded-For: 203.0.113.5"]
        direct = here._replace(port=self.host.greeting["port"])
        for name, link, address in (("through the proxy", here, "127.0.0.9"), ("beside it", direct, "127.0.0.8")):
            with self.subTest(name), RawPeer(link, address=address, headers=invented) as peer:
                peer.join(name=name)
                peer.receive_control("Welcome")
                wait_until(lambda: self.lines("joined", name, f"address={address}"))
        self.assertEqual(self.lines("203.0.113.5"), [])
        self.assertEqual(self.lines("names no client"), [])


if __name__ == "__main__":
    unittest.main()
