// SPDX-License-Identifier: Apache-2.0
#include "net/certificate_request.h"

#include <arpa/inet.h>

#include <algorithm>

#include "base/error.h"
#include "base/outside_text.h"
#include "net/openssl_pointers.h"

namespace theatron::net {

using namespace openssl;

namespace {

constexpr std::size_t max_name = 253, max_label = 63;
constexpr std::size_t max_common_name = 64;  // X.520
constexpr std::size_t shown_of_name = 80;

bool is_address(const std::string& name) {
    unsigned char bytes[sizeof(in6_addr)];
    return inet_pton(AF_INET, name.c_str(), bytes) == 1 ||
           inet_pton(AF_INET6, name.c_str(), bytes) == 1;
}

// Letters, digits and hyphens between dots, so that none can end an entry of the list of names.
bool is_dns_name(const std::string& name) {
    std::size_t label = 0;
    for (const char c : name) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool is_digit = c >= '0' && c <= '9';
        if (c == '.' ? label == 0 : !(is_letter || is_digit || c == '-'))
            return false;
        label = c == '.' ? 0 : label + 1;
        if (label > max_label)
            return false;
    }
    return label > 0 && name.size() <= max_name;
}

std::string names_text(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        const bool is_ip = is_address(name);
        if (!is_ip && !is_dns_name(name))
            throw Error("'" + clean_text(name, shown_of_name) +
                        "' is no name for a certificate; write one like or-3.hospital.example, or "
                        "an IP address.");
        text += (text.empty() ? "" : ",") + std::string(is_ip ? "IP:" : "DNS:") + name;
    }
    return text;
}

void add_extensions(X509_REQ* request, const std::string& names) {
    STACK_OF(X509_EXTENSION)* extensions = sk_X509_EXTENSION_new_null();
    bool is_made = extensions != nullptr;
    const std::pair<int, const char*> parts[] = {{NID_subject_alt_name, names.c_str()},
                                                 {NID_key_usage, "critical,digitalSignature"},
                                                 {NID_ext_key_usage, "serverAuth"}};
    for (const auto& [kind, value] : parts) {
        X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value);
        is_made = is_made && extension && sk_X509_EXTENSION_push(extensions, extension) > 0;
        if (!is_made)
            X509_EXTENSION_free(extension);
    }
    is_made = is_made && X509_REQ_add_extensions(request, extensions) == 1;
    sk_X509_EXTENSION_pop_free(extensions, X509_EXTENSION_free);
    if (!is_made)
        throw Error("The names of the certificate cannot be written into its request.");
}

}  // namespace

std::string make_key() {
    const Key key(EVP_EC_gen("P-256"));
    const Bio out(BIO_new(BIO_s_mem()));
    if (!key || !out ||
        PEM_write_bio_PrivateKey(out.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
        throw Error("Cannot make a key for TLS.");
    return content_of(out.get());
}

std::string certificate_request(const std::string& key_pem, const std::vector<std::string>& names) {
    if (names.empty() || names.size() > max_request_names)
        throw Error("A certificate is for 1 to " + std::to_string(max_request_names) + " names.");
    const std::string list = names_text(names);
    const Key key = key_of(key_pem);
    if (!key)
        throw Error("This is no key in PEM without a passphrase.");
    const RequestPtr request(X509_REQ_new());
    const Bio out(BIO_new(BIO_s_mem()));
    if (!request || !out)
        throw Error("There is no memory for the request.");
    // A longer name stands in the list alone, which is the one that browsers read.
    if (names.front().size() <= max_common_name)
        X509_NAME_add_entry_by_txt(X509_REQ_get_subject_name(request.get()), "CN", MBSTRING_ASC,
                                   reinterpret_cast<const unsigned char*>(names.front().c_str()),
                                   -1, -1, 0);
    add_extensions(request.get(), list);
    // Keys of Edwards curves bring their own digest.
    const int kind = EVP_PKEY_get_base_id(key.get());
    const EVP_MD* digest =
        kind == EVP_PKEY_ED25519 || kind == EVP_PKEY_ED448 ? nullptr : EVP_sha256();
    if (X509_REQ_set_version(request.get(), 0) != 1 ||
        X509_REQ_set_pubkey(request.get(), key.get()) != 1 ||
        X509_REQ_sign(request.get(), key.get(), digest) <= 0 ||
        PEM_write_bio_X509_REQ(out.get(), request.get()) != 1)
        throw Error("The request for a certificate cannot be signed with this key.");
    return content_of(out.get());
}

}  // namespace theatron::net
