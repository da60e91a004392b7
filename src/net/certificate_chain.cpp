// SPDX-License-Identifier: Apache-2.0
#include "net/certificate_chain.h"

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/x509_vfy.h>

#include <algorithm>

#include "base/error.h"
#include "base/outside_text.h"
#include "net/openssl_pointers.h"

namespace theatron::net {

using namespace openssl;

namespace {

constexpr std::size_t shown_of_subject = 120;
constexpr std::size_t shown_names = 5;

using X509List = std::vector<X509Ptr>;

std::string pem_of(X509* certificate) {
    const Bio out(BIO_new(BIO_s_mem()));
    if (!out || PEM_write_bio_X509(out.get(), certificate) != 1)
        throw Error("A certificate cannot be written as PEM.");
    return content_of(out.get());
}

void add_all_of(PKCS7* message, std::vector<std::string>& found) {
    const STACK_OF(X509)* held =
        PKCS7_type_is_signed(message) && message->d.sign ? message->d.sign->cert : nullptr;
    for (int i = 0; i < sk_X509_num(held) && found.size() <= max_certificates; ++i)
        found.push_back(pem_of(sk_X509_value(held, i)));
}

std::vector<std::string> in_pem(const std::string& text) {
    std::vector<std::string> found;
    const Bio in = reader_of(text);
    char *name = nullptr, *header = nullptr;
    unsigned char* data = nullptr;
    long size = 0;
    while (found.size() <= max_certificates &&
           PEM_read_bio(in.get(), &name, &header, &data, &size) == 1) {
        const std::string kind = name;
        const unsigned char* p = data;
        const X509Ptr certificate(kind == PEM_STRING_X509 || kind == PEM_STRING_X509_OLD
                                      ? d2i_X509(nullptr, &p, size)
                                      : nullptr);
        const Pkcs7 message(kind == PEM_STRING_PKCS7 ? d2i_PKCS7(nullptr, &p, size) : nullptr);
        const bool is_damaged =
            !certificate && !message && (kind == PEM_STRING_X509 || kind == PEM_STRING_PKCS7);
        OPENSSL_free(name);
        OPENSSL_free(header);
        OPENSSL_clear_free(data, std::size_t(size));
        if (is_damaged)
            throw Error("one of its certificates is damaged");
        if (certificate)
            found.push_back(pem_of(certificate.get()));
        if (message)
            add_all_of(message.get(), found);
    }
    return found;
}

std::vector<std::string> in_der(const std::string& bytes) {
    std::vector<std::string> found;
    const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
    const unsigned char* p = begin;
    if (const X509Ptr certificate{d2i_X509(nullptr, &p, long(bytes.size()))}) {
        found.push_back(pem_of(certificate.get()));
        return found;
    }
    p = begin;
    if (const Pkcs7 message{d2i_PKCS7(nullptr, &p, long(bytes.size()))})
        add_all_of(message.get(), found);
    return found;
}

X509Ptr parsed(const std::string& pem) {
    const Bio in = reader_of(pem);
    return X509Ptr(PEM_read_bio_X509(in.get(), nullptr, no_passphrase, nullptr));
}

X509List all_of(const std::string& pem) {
    X509List list;
    const Bio in = reader_of(pem);
    while (X509Ptr next{PEM_read_bio_X509(in.get(), nullptr, no_passphrase, nullptr)})
        list.push_back(std::move(next));
    ERR_clear_error();
    return list;
}

std::string text_of(const X509_NAME* name) {
    const Bio out(BIO_new(BIO_s_mem()));
    X509_NAME_print_ex(out.get(), name, 0, XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB);
    return clean_text(content_of(out.get()), shown_of_subject);
}

bool is_root(X509* certificate) {
    return X509_check_issued(certificate, certificate) == X509_V_OK;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), shown_names); ++i)
        text += (i ? ", '" : "'") + clean_text(names[i], shown_of_subject) + "'";
    return names.empty() ? "no name" : text + (names.size() > shown_names ? ", ..." : "");
}

// The one with which `certificate` is signed; nullptr if it is not there.
const X509Ptr* issuer_in(const X509List& all, X509* certificate) {
    for (const X509Ptr& other : all)
        if (other.get() != certificate &&
            X509_check_issued(other.get(), certificate) == X509_V_OK &&
            X509_verify(certificate, X509_get0_pubkey(other.get())) == 1)
            return &other;
    return nullptr;
}

}  // namespace

std::vector<std::string> certificates_in(const std::string& bytes) {
    std::vector<std::string> found = in_pem(bytes);
    if (found.empty())
        found = in_der(bytes);
    ERR_clear_error();
    if (found.empty())
        throw Error("it holds no certificate in PEM, DER or PKCS #7");
    if (found.size() > max_certificates)
        throw Error("it holds more than " + std::to_string(max_certificates) + " certificates");
    return found;
}

std::optional<CertificateChain> chain_of_key(const std::vector<std::string>& certificates,
                                             const std::string& key_pem) {
    const Key key = key_of(key_pem);
    if (!key)
        throw Error("it is no key in PEM without a passphrase");
    X509List all;
    for (const std::string& pem : certificates)
        if (X509Ptr certificate = parsed(pem))
            all.push_back(std::move(certificate));
    X509* own = nullptr;
    for (const X509Ptr& one : all)
        if (X509_check_private_key(one.get(), key.get()) == 1 &&
            (!own || ASN1_TIME_compare(X509_get0_notAfter(one.get()), X509_get0_notAfter(own)) > 0))
            own = one.get();
    ERR_clear_error();
    if (!own)
        return std::nullopt;

    CertificateChain chain;
    std::vector<const X509*> used;
    for (X509* next = own; next && used.size() <= all.size();) {
        used.push_back(next);
        // One that signed itself, and nothing else, is all that there is to show.
        if (!is_root(next) || next == own)
            chain.pem += pem_of(next);
        chain.issuer = text_of(X509_get_issuer_name(next));
        chain.has_root = is_root(next);
        const X509Ptr* issuer = chain.has_root ? nullptr : issuer_in(all, next);
        next = issuer ? issuer->get() : nullptr;
        if (std::ranges::find(used, next) != used.end())
            break;
    }
    for (const X509Ptr& one : all)
        if (std::ranges::find(used, one.get()) == used.end())
            chain.left_out.push_back(text_of(X509_get_subject_name(one.get())));
    ERR_clear_error();
    return chain;
}

std::vector<std::string> names_of_certificate(const std::string& pem) {
    std::vector<std::string> names;
    const X509Ptr certificate = parsed(pem);
    if (!certificate)
        return names;
    auto* list = static_cast<GENERAL_NAMES*>(
        X509_get_ext_d2i(certificate.get(), NID_subject_alt_name, nullptr, nullptr));
    for (int i = 0; i < sk_GENERAL_NAME_num(list); ++i) {
        const GENERAL_NAME* name = sk_GENERAL_NAME_value(list, i);
        char shown[INET6_ADDRSTRLEN] = "";
        if (name->type == GEN_DNS) {
            const auto* text = ASN1_STRING_get0_data(name->d.dNSName);
            names.emplace_back(reinterpret_cast<const char*>(text),
                               std::size_t(ASN1_STRING_length(name->d.dNSName)));
        } else if (name->type == GEN_IPADD) {
            const int size = ASN1_STRING_length(name->d.iPAddress);
            const bool is_v4 = size == int(sizeof(in_addr)), is_v6 = size == int(sizeof(in6_addr));
            if ((is_v4 || is_v6) &&
                inet_ntop(is_v4 ? AF_INET : AF_INET6, ASN1_STRING_get0_data(name->d.iPAddress),
                          shown, sizeof(shown)))
                names.emplace_back(shown);
        }
    }
    GENERAL_NAMES_free(list);
    return names;
}

std::string certificate_mistake(const std::string& pem, files::UtcSeconds now,
                                const std::string& name) {
    const X509Ptr certificate = parsed(pem);
    if (!certificate)
        return "it is damaged";
    const auto begins = time_of(X509_get0_notBefore(certificate.get()));
    const auto ends = time_of(X509_get0_notAfter(certificate.get()));
    if (!begins || !ends)
        return "it does not say from when to when it is valid";
    const std::string clock = " and this machine's clock says " + files::utc_text(now);
    if (now > *ends)
        return "it was valid until " + files::utc_text(*ends) + clock +
               "; ask for a new one, or set the clock if it is wrong";
    if (now < *begins)
        return "it is valid only from " + files::utc_text(*begins) + " on" + clock +
               "; set the clock if it is wrong, else wait";
    if (X509_check_purpose(certificate.get(), X509_PURPOSE_SSL_SERVER, 0) != 1)
        return "it is not one for servers; ask for one whose purpose is serverAuth";
    const std::vector<std::string> names = names_of_certificate(pem);
    const bool is_for_name = X509_check_ip_asc(certificate.get(), name.c_str(), 0) == 1 ||
                             X509_check_host(certificate.get(), name.data(), name.size(),
                                             X509_CHECK_FLAG_NEVER_CHECK_SUBJECT, nullptr) == 1;
    if (name.empty() ? names.empty() : !is_for_name)
        return "it is for " + joined(names) +
               (name.empty() ? "; ask for one with a name that participants use"
                             : " and not for '" + name +
                                   "', the name in the links; ask for one with that name, or "
                                   "change 'public-name'");
    return "";
}

bool is_known_here(const std::string& pem) {
    const X509List chain = all_of(pem);
    if (chain.empty())
        return false;
    X509_STORE* store = X509_STORE_new();
    X509_STORE_CTX* context = X509_STORE_CTX_new();
    STACK_OF(X509)* others = sk_X509_new_null();
    for (std::size_t i = 1; i < chain.size(); ++i)
        sk_X509_push(others, chain[i].get());
    const bool is_known = X509_STORE_set_default_paths(store) == 1 &&
                          X509_STORE_CTX_init(context, store, chain.front().get(), others) == 1 &&
                          X509_verify_cert(context) == 1;
    sk_X509_free(others);
    X509_STORE_CTX_free(context);
    X509_STORE_free(store);
    ERR_clear_error();
    return is_known;
}

}  // namespace theatron::net
