# SPDX-License-Identifier: Apache-2.0
"""A hospital's certification authority: a root, an issuer below it, and certificates for the requests of hosts. Needs the
command openssl."""
import datetime
import subprocess

SETTINGS = """[ca]
default_ca = here
[here]
dir = {folder}
database = {folder}/index
serial = {folder}/serial
new_certs_dir = {folder}
default_md = sha256
policy = any
copy_extensions = copy
unique_subject = no
[any]
commonName = optional
[issuer]
basicConstraints = critical,CA:true
keyUsage = critical,keyCertSign
[server]
basicConstraints = CA:false
[client]
basicConstraints = CA:false
extendedKeyUsage = clientAuth
[req]
distinguished_name = names
[names]
"""


def _openssl(*arguments):
    subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True)


def _time(hours):
    return (datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(hours=hours)).strftime("%y%m%d%H%M%SZ")


class Authority:
    def __init__(self, folder):
        self.folder = folder
        folder.mkdir()
        self.root, self.issuer = folder / "root.pem", folder / "issuer.pem"
        (folder / "index").touch()
        (folder / "serial").write_text("01\n")
        self.settings = folder / "settings"
        self.settings.write_text(SETTINGS.format(folder=folder))
        curve = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-config", self.settings]
        _openssl("req", "-x509", *curve, "-subj", "/CN=Root", "-extensions", "issuer", "-days", 90, "-keyout", folder / "root.key",
                 "-out", self.root)
        _openssl("req", "-new", *curve, "-subj", "/CN=Issuer", "-keyout", folder / "issuer.key", "-out", folder / "issuer.csr")
        self._sign(folder / "issuer.csr", self.issuer, self.root, folder / "root.key", "issuer", -2, 2000)

    def _sign(self, request, certificate, issuer, key, kind, begins, ends):
        _openssl("ca", "-batch", "-notext", "-config", self.settings, "-cert", issuer, "-keyfile", key, "-extensions", kind,
                 "-startdate", _time(begins), "-enddate", _time(ends), "-in", request, "-out", certificate)

    def answer(self, request, kind="server", begins=-1, ends=1000):
        """The certificate of this request, valid from `begins` to `ends`, in hours from now."""
        certificate = self.folder / f"answer{len(list(self.folder.iterdir()))}.pem"
        self._sign(request, certificate, self.issuer, self.folder / "issuer.key", kind, begins, ends)
        return certificate

    def pkcs7(self, *certificates):
        """All of them in one file, as authorities of Windows give them."""
        bundle = self.folder / "bundle.p7b"
        _openssl("crl2pkcs7", "-nocrl", "-outform", "DER", "-out", bundle,
                 *[word for one in certificates for word in ("-certfile", one)])
        return bundle
