# SPDX-License-Identifier: Apache-2.0
"""From a request to the certificate that a running host shows, and what is said of certificates that cannot be used."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import tempfile
import unittest

from authority import Authority
from raw_peer import Link, RawPeer, https_request
from theatron_process import Process, host, run

HOOK = pathlib.Path(__file__).resolve().parents[2] / "packaging/theatron-acme-hook"


@unittest.skipUnless(shutil.which("openssl"), "openssl is not installed")
class Certificates(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="theatron_e2e_")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.state = self.folder / "state"
        self.config = self.folder / "or-3.conf"
        self.key, self.certificate = self.folder / "or-3.key", self.folder / "or-3.pem"
        self.config.write_text(f"session = OR 3\nlisten = 127.0.0.1:0\npublic-name = localhost\nstate = {self.state}\n"
                               f"certificate = {self.certificate}\nkey = {self.key}\njson = yes\n")
        self.authority = Authority(self.folder / "authority")

    def certificate_command(self, *words):
        return run("certificate", *words, "--config", self.config)

    def request(self, *words):
        code, out, errors = self.certificate_command("request", *words, "--json")
        self.assertEqual((code, errors), (0, ""))
        return json.loads(out)

    def install(self, *files):
        code, out, errors = self.certificate_command("install", *files, "--json")
        self.assertEqual(code, 0, errors)
        return json.loads(out)

    def refused(self, *files):
        """The one sentence; the installed files stay as they are."""
        before = [file.read_bytes() for file in (self.key, self.certificate) if file.exists()]
        code, out, errors = self.certificate_command("install", *files)
        self.assertEqual((code, out), (1, ""))
        self.assertEqual(len(errors.splitlines()), 1, errors)
        self.assertEqual([file.read_bytes() for file in (self.key, self.certificate) if file.exists()], before)
        return errors

    def shown_to_a_browser(self, port, name="localhost"):
        """As a browser does: roots alone are known, and the name must be right."""
        context = ssl.create_default_context(cafile=self.authority.root)
        with socket.create_connection(("127.0.0.1", port), timeout=30) as stream, \
                context.wrap_socket(stream, server_hostname=name) as tls:
            return tls.getpeercert(binary_form=True)

    def test_two_commands_lead_to_a_certificate_without_a_warning_and_a_renewal_drops_nobody(self):
        asked = self.request()
        self.assertEqual((asked["names"], asked["key_is_new"], asked["key"]), (["localhost"], True, str(self.key)))
        self.assertEqual(self.key.stat().st_mode & 0o777, 0o600)
        text = subprocess.run(["openssl", "req", "-verify", "-noout", "-text", "-in", asked["request"]], capture_output=True, text=True,
                              check=True).stdout
        self.assertIn("DNS:localhost", text)
        self.assertIn("TLS Web Server Authentication", text)

        self.assertFalse(self.install(self.authority.answer(asked["request"]), self.authority.issuer)["shown"])
        with Process("host", "--config", self.config) as h:
            link = Link.parse(h.read_json()["link"])
            first = self.shown_to_a_browser(link.port)
            with RawPeer(link) as peer:
                peer.join()
                peer.receive_control("Welcome")
                # Another key, whose certificate comes later: until then nothing changes.
                other = self.request("--new-key")
                self.assertTrue(other["key_is_new"])
                self.assertEqual(self.shown_to_a_browser(link.port), first)
                bundle = self.authority.pkcs7(self.authority.root, self.authority.issuer, self.authority.answer(other["request"]))
                self.assertTrue(self.install(bundle)["shown"])
                self.assertNotEqual(self.shown_to_a_browser(link.port), first)
                peer.send_control("Ping", sent_us=1)
                peer.receive_control("Pong")
        self.assertFalse(pathlib.Path(other["key"]).exists())
        blocks = re.findall("BEGIN CERTIFICATE", self.certificate.read_text())
        self.assertEqual(len(blocks), 2)  # without the root

    def test_a_key_that_is_there_is_not_replaced(self):
        first = self.request()
        key = self.key.read_bytes()
        self.assertFalse(self.request()["key_is_new"])
        self.request("--new-key")
        self.assertEqual(self.key.read_bytes(), key)
        code, _, errors = self.certificate_command("request", "--new-key")
        self.assertEqual(code, 1)
        self.assertIn("already waits for its certificate", errors)
        # The certificate of the first key may still come.
        self.install(self.authority.answer(first["request"]), self.authority.issuer)

    def test_each_mistake_is_one_sentence_and_nothing_is_changed(self):
        self.assertRegex(self.refused(self.authority.issuer), "There is no key .*certificate request")
        request = self.request()["request"]
        self.install(self.authority.answer(request), self.authority.issuer)

        self.assertIn("belongs to the key", self.refused(self.authority.issuer))
        self.assertRegex(self.refused(self.authority.answer(request, begins=-48, ends=-1)), "was valid until .*clock says .*Nothing was changed")
        # The clock of the authority, or this machine's, is an hour wrong.
        self.assertRegex(self.refused(self.authority.answer(request, begins=1)), "only from .*clock says .*set the clock")
        self.assertIn("not one for servers", self.refused(self.authority.answer(self.other_request(), kind="client")))
        wrong = self.request("--name", "or-4.example")["request"]
        self.assertRegex(self.refused(self.authority.answer(wrong)), "for 'or-4.example' and not for 'localhost'")
        self.assertIn("holds no certificate", self.refused(self.config))
        self.assertIn("There is no file", self.refused(self.folder / "nothing"))
        self.assertIn("holds no certificate", self.refused(request))
        # Without an issuer it can be used, and what browsers may lack is told.
        code, _, errors = self.certificate_command("install", self.authority.answer(self.request()["request"]))
        self.assertEqual(code, 0)
        self.assertIn("does not know 'CN=Issuer'", errors)

    def test_the_answer_may_belong_to_anybody(self):
        answer = pathlib.Path(self.authority.answer(self.request()["request"]))
        answer.chmod(0o666)
        if os.geteuid() == 0:
            os.chown(answer, 65534, 65534)
        self.install(answer, self.authority.issuer)

    def test_a_host_whose_certificate_has_wrong_dates_starts_and_says_so(self):
        # The clock of the authority or of this machine is wrong, or nobody renewed it.
        request = self.request()["request"]
        for begins, ends, told in ((1, 100, "valid only from .*browsers warn"), (-48, -1, "expired at .*browsers warn")):
            shutil.copy(self.authority.answer(request, begins=begins, ends=ends), self.certificate)
            code, out, errors = run("host", "--config", self.config, "--check-config")
            self.assertEqual((code, errors), (0, ""))
            self.assertRegex(out, f"can be used\\.\nThe certificate .*{told}")
            with Process("host", "--config", self.config) as h:
                h.wait_for_error("browsers warn")
                self.assertEqual(https_request(h.read_json()["link"], "GET", "/health")[0], 200)
        # One that runs keeps a certificate that is valid.
        shutil.copy(self.authority.answer(request), self.certificate)
        with Process("host", "--config", self.config) as h:
            shown = self.fingerprint(link := h.read_json()["link"])
            shutil.copy(self.authority.answer(request, begins=1), self.certificate)
            h.wait_for_error("stays in use")
            self.assertEqual(self.fingerprint(link), shown)

    def fingerprint(self, link):
        return hashlib.sha256(ssl.PEM_cert_to_DER_cert(ssl.get_server_certificate(("127.0.0.1", Link.parse(link).port)))).digest()

    def other_request(self):
        """One that names no purpose, so that the authority chooses it."""
        request = self.folder / "other.csr"
        subprocess.run(["openssl", "req", "-new", "-key", self.key, "-subj", "/CN=localhost", "-addext",
                        "subjectAltName=DNS:localhost", "-out", request], check=True, capture_output=True)
        return request

    def test_names_that_are_none_and_keys_of_others_are_refused(self):
        for name in ("or 3", "or-3,DNS:evil", "", "https://or-3", "a" * 64):
            code, _, errors = self.certificate_command("request", f"--name={name}")
            self.assertEqual(code, 1)
            self.assertTrue(errors)
        self.assertFalse(self.key.exists())
        self.request()
        self.key.chmod(0o644)
        code, _, errors = self.certificate_command("request")
        self.assertEqual(code, 1)
        self.assertIn("chmod 600", errors)

    def test_a_configuration_that_names_no_files_gets_the_lines_to_add(self):
        self.config.write_text("session = OR 3\npublic-name = localhost\n")
        request = self.request()["request"]
        code, out, errors = self.certificate_command("install", self.authority.answer(request), self.authority.issuer)
        self.assertEqual(code, 0, errors)
        self.assertIn(f"  certificate = {self.certificate}\n  key = {self.key}\n", out)

    @unittest.skipUnless(shutil.which("pebble") and shutil.which("lego"), "pebble and lego are not installed")
    def test_lego_and_certbot_hand_over_their_certificates_with_the_hook(self):
        serving = self.serve_acme()
        environment = os.environ | {"LEGO_CA_CERTIFICATES": str(serving), "THEATRON_CONFIG": str(self.config),
                                    "PATH": f"{self.folder}:{os.environ['PATH']}"}
        # The hook finds the program by its name.
        (self.folder / "theatron").symlink_to(pathlib.Path(os.environ.get("THEATRON", "build/release/apps/theatron/theatron")).resolve())
        words = ["lego", "--server", f"https://localhost:{self.acme_port}/dir", "--accept-tos", "--email", "it@hospital.example",
                 "--domains", "localhost", "--path", self.folder / "lego", "--http", "--http.port", "127.0.0.1:0"]
        self.run_tool([*words, "run", "--run-hook", str(HOOK)], environment)
        with Process("host", "--config", self.config) as h:
            link = Link.parse(h.read_json()["link"])
            with RawPeer(link) as peer:
                peer.join()
                peer.receive_control("Welcome")
                before = self.certificate.read_bytes()
                self.run_tool([*words, "renew", "--days", "10000", "--no-random-sleep", "--renew-hook", str(HOOK)], environment)
                self.assertNotEqual(self.certificate.read_bytes(), before)
                peer.send_control("Ping", sent_us=1)
                peer.receive_control("Pong")
        # certbot names a folder to its hooks.
        lineage = self.folder / "live"
        lineage.mkdir()
        made = self.folder / "lego/certificates"
        (lineage / "fullchain.pem").write_bytes((made / "localhost.crt").read_bytes())
        (lineage / "privkey.pem").write_bytes((made / "localhost.key").read_bytes())
        for file in lineage.iterdir():
            file.chmod(0o600)
        self.certificate.unlink()
        self.run_tool([HOOK], environment | {"RENEWED_LINEAGE": str(lineage)})
        self.assertTrue(self.certificate.exists())

    def run_tool(self, words, environment):
        done = subprocess.run(words, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def serve_acme(self):
        """pebble, which believes every host; returns the certificate of its own port."""
        folder = self.folder / "pebble"
        folder.mkdir()
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj",
                        "/CN=localhost", "-addext", "subjectAltName=DNS:localhost", "-keyout", folder / "key", "-out",
                        folder / "certificate"], check=True, capture_output=True)
        ports = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
        self.acme_port, management = [port.getsockname()[1] for port in ports]
        for port in ports:
            port.close()
        (folder / "settings.json").write_text(json.dumps({"pebble": {
            "listenAddress": f"127.0.0.1:{self.acme_port}", "managementListenAddress": f"127.0.0.1:{management}",
            "certificate": str(folder / "certificate"), "privateKey": str(folder / "key"), "httpPort": 5002, "tlsPort": 5001,
            "ocspResponderURL": "", "externalAccountBindingRequired": False}}))
        pebble = subprocess.Popen(["pebble", "-config", folder / "settings.json"], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True,
                                  env=os.environ | {"PEBBLE_VA_ALWAYS_VALID": "1", "PEBBLE_VA_NOSLEEP": "1",
                                                    "PEBBLE_WFE_NONCEREJECT": "0"})
        self.addCleanup(pebble.stdout.close)
        self.addCleanup(pebble.wait)
        self.addCleanup(pebble.kill)
        for line in pebble.stdout:
            if "Listening on" in line or "ACME directory" in line:
                break
        return folder / "certificate"


if __name__ == "__main__":
    unittest.main()
