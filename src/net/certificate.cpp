// SPDX-License-Identifier: Apache-2.0
#include "net/certificate.h"

#include <openssl/bio.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <algorithm>

#include "base/error.h"
#include "files/private_file.h"
#include "net/openssl_pointers.h"

namespace theatron::net {

using namespace openssl;

namespace {

std::string hex(const unsigned char* bytes, std::size_t count) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += digits[bytes[i] >> 4];
        text += digits[bytes[i] & 15];
    }
    return text;
}

X509Ptr first_of(const std::string& certificate_pem) {
    const Bio in = reader_of(certificate_pem);
    return X509Ptr(PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr));
}

// Sets the fingerprint. False if the two parts do not belong together.
bool complete(Certificate& c) {
    const X509Ptr x509 = first_of(c.certificate_pem);
    const Key key = key_of(c.private_key_pem);
    if (!x509 || !key || X509_check_private_key(x509.get(), key.get()) != 1)
        return false;
    c.fingerprint = certificate_fingerprint(x509.get());
    return true;
}

// One of the certificates behind the first one was made for this key.
bool belongs_to_later(const std::string& certificates_pem, EVP_PKEY* key) {
    const Bio in = reader_of(certificates_pem);
    bool is_first = true, found = false;
    while (const X509Ptr x509{PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr)}) {
        found = found || (!is_first && X509_check_private_key(x509.get(), key) == 1);
        is_first = false;
    }
    ERR_clear_error();
    return found;
}

// The sentence about a pair that is not complete(), for the files that hold it.
std::string mistake_of_pair(const Certificate& pair, const std::filesystem::path& certificate_file,
                            const std::filesystem::path& key_file) {
    const std::string certificate = "'" + certificate_file.string() + "'";
    const std::string key = "'" + key_file.string() + "'";
    if (!first_of(pair.certificate_pem))
        return certificate +
               " holds no certificate in PEM, which begins with -----BEGIN CERTIFICATE-----; "
               "'theatron certificate install' also takes DER and PKCS #7.";
    const Key private_key = key_of(pair.private_key_pem);
    if (!private_key && pair.private_key_pem.find("ENCRYPTED") != std::string::npos)
        return "The key " + key + " has a passphrase; write it without one: openssl pkey -in " +
               key + " -out NEW_FILE.";
    if (!private_key)
        return key + " holds no key in PEM, which begins with -----BEGIN and ends with KEY-----.";
    if (belongs_to_later(pair.certificate_pem, private_key.get()))
        return certificate + " begins with another certificate than that of the key " + key +
               "; the host's own stands first, and those of its issuers follow ('theatron "
               "certificate install' puts them in order).";
    return "The certificate in " + certificate + " was made for another key than " + key +
           "; name the key of its request, or ask for a new certificate with 'theatron "
           "certificate request'.";
}

files::UtcSeconds utc_of(const ASN1_TIME* time) {
    if (const auto utc = time_of(time))
        return *utc;
    throw Error("The certificate names no time of its end.");
}

// A host has made links with the certificate of this folder.
bool has_tokens(const std::filesystem::path& folder) {
    return std::ranges::any_of(std::filesystem::directory_iterator(folder), [](const auto& entry) {
        return entry.path().extension() == ".token";
    });
}

}  // namespace

std::string certificate_fingerprint(X509* certificate) {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    if (!X509_digest(certificate, EVP_sha256(), digest, &size))
        throw Error("The certificate's fingerprint cannot be computed.");
    return hex(digest, size);
}

std::string fingerprint_of_peer(SSL* connection) {
    const X509Ptr shown(SSL_get1_peer_certificate(connection));
    return shown ? certificate_fingerprint(shown.get()) : "";
}

std::string fingerprint_of(const Certificate& certificate) {
    const X509Ptr x509 = first_of(certificate.certificate_pem);
    if (!x509)
        throw Error("The certificate is damaged.");
    return certificate_fingerprint(x509.get());
}

Certificate make_certificate() {
    const Key key(EVP_EC_gen("P-256"));
    const X509Ptr x509(X509_new());
    unsigned char serial[8];
    if (!key || !x509 || RAND_bytes(serial, sizeof(serial)) != 1)
        throw Error("Cannot make a key for TLS.");
    serial[0] &= 0x7f;
    ASN1_INTEGER* number = X509_get_serialNumber(x509.get());
    std::uint64_t value = 0;
    for (const unsigned char byte : serial)
        value = value << 8 | byte;
    ASN1_INTEGER_set_uint64(number, value);
    X509_set_version(x509.get(), 2);
    X509_gmtime_adj(X509_getm_notBefore(x509.get()), -24 * 3600);
    X509_gmtime_adj(X509_getm_notAfter(x509.get()), 10L * 365 * 24 * 3600);
    X509_set_pubkey(x509.get(), key.get());
    X509_NAME* name = X509_get_subject_name(x509.get());
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>("theatron"), -1, -1, 0);
    X509_set_issuer_name(x509.get(), name);
    // Proxies that compare names look for them only here.
    const Extension names(
        X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "DNS:theatron"));
    if (!names || X509_add_ext(x509.get(), names.get(), -1) != 1)
        throw Error("Cannot name the certificate for TLS.");
    if (!X509_sign(x509.get(), key.get(), EVP_sha256()))
        throw Error("Cannot sign the certificate for TLS.");

    const Bio certificate_out(BIO_new(BIO_s_mem())), key_out(BIO_new(BIO_s_mem()));
    PEM_write_bio_X509(certificate_out.get(), x509.get());
    PEM_write_bio_PrivateKey(key_out.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    return {content_of(certificate_out.get()), content_of(key_out.get()),
            certificate_fingerprint(x509.get())};
}

Certificate load_or_make_certificate(const std::filesystem::path& folder) {
    using files::Privacy;
    files::open_private_folder(folder);
    const auto certificate_path = folder / "host.crt", key_path = folder / "host.key";
    const auto certificate = files::read_private_file(certificate_path, Privacy::readable);
    if (!certificate) {
        if (std::filesystem::exists(key_path) && has_tokens(folder))
            throw Error("'" + certificate_path.string() +
                        "' is missing, and links that were made name it. Put it back; or delete "
                        "host.key, too, after which the host has a new identity and old links no "
                        "longer work.");
        // The certificate is written last. A key without one is left by a crash during the first
        // start; no link has ever named it, so both are made again.
        const Certificate made = make_certificate();
        files::write_private_file(key_path, made.private_key_pem);
        files::write_private_file(certificate_path, made.certificate_pem);
        return made;
    }

    Certificate c{*certificate,
                  files::read_private_file(key_path, Privacy::secret).value_or(std::string()), ""};
    if (!complete(c))
        throw Error("The host's identity in " + folder.string() +
                    " is damaged (host.crt and host.key must belong together); delete both to make "
                    "a new one, after which old links no longer work.");
    return c;
}

Certificate read_certificate(const std::filesystem::path& certificate,
                             const std::filesystem::path& key) {
    using files::Privacy;
    const auto read = [](const std::filesystem::path& file, Privacy privacy) {
        if (auto text = files::read_named_file(file, privacy))
            return *std::move(text);
        throw Error("There is no file '" + file.string() + "'; name one with PEM blocks.");
    };
    Certificate c{read(certificate, Privacy::readable), "", ""};
    if (key.empty()) {
        const X509Ptr x509 = first_of(c.certificate_pem);
        if (!x509)
            throw Error("'" + certificate.string() +
                        "' holds no certificate in PEM, which begins with -----BEGIN "
                        "CERTIFICATE-----.");
        c.fingerprint = certificate_fingerprint(x509.get());
    } else {
        c.private_key_pem = read(key, Privacy::secret);
        if (!complete(c))
            throw Error(mistake_of_pair(c, certificate, key));
    }
    return c;
}

Validity validity_of(const Certificate& certificate) {
    const X509Ptr x509 = first_of(certificate.certificate_pem);
    if (!x509)
        throw Error("The certificate is damaged.");
    return {utc_of(X509_get0_notBefore(x509.get())), utc_of(X509_get0_notAfter(x509.get()))};
}

bool is_for(const Certificate& certificate, const std::string& name) {
    const X509Ptr x509 = first_of(certificate.certificate_pem);
    return x509 && (X509_check_ip_asc(x509.get(), name.c_str(), 0) == 1 ||
                    X509_check_host(x509.get(), name.data(), name.size(), 0, nullptr) == 1);
}

std::string random_token() {
    unsigned char bytes[16];
    if (RAND_bytes(bytes, sizeof(bytes)) != 1)
        throw Error("The system has no random numbers for a join token.");
    return hex(bytes, sizeof(bytes));
}

Bytes random_bytes(std::size_t count) {
    Bytes bytes(count);
    if (RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), int(count)) != 1)
        throw Error("The system has no random numbers.");
    return bytes;
}

bool equal_secrets(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace theatron::net
