// SPDX-License-Identifier: Apache-2.0
// Objects of OpenSSL that free themselves, for the sources of certificates alone.
#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <memory>
#include <optional>
#include <string>

#include "files/utc_text.h"

namespace theatron::net::openssl {

template <auto free_function>
struct Deleter {
    template <class T>
    void operator()(T* p) const {
        free_function(p);
    }
};
using Key = std::unique_ptr<EVP_PKEY, Deleter<EVP_PKEY_free>>;
using X509Ptr = std::unique_ptr<X509, Deleter<X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Deleter<X509_EXTENSION_free>>;
using RequestPtr = std::unique_ptr<X509_REQ, Deleter<X509_REQ_free>>;
using Pkcs7 = std::unique_ptr<PKCS7, Deleter<PKCS7_free>>;
using Bio = std::unique_ptr<BIO, Deleter<BIO_free_all>>;

// A text that outlives what is returned.
inline Bio reader_of(const std::string& text) {
    return Bio(BIO_new_mem_buf(text.data(), int(text.size())));
}

inline std::string content_of(BIO* bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio, &data);
    return std::string(data, std::size_t(size));
}

// A key with a passphrase is not asked for it.
inline int no_passphrase(char*, int, int, void*) {
    return -1;
}

// nullptr: it is no key without a passphrase.
inline Key key_of(const std::string& pem) {
    const Bio in = reader_of(pem);
    return Key(PEM_read_bio_PrivateKey(in.get(), nullptr, no_passphrase, nullptr));
}

// OpenSSL writes every time of a certificate in UTC. nullopt: it is none.
inline std::optional<files::UtcSeconds> time_of(const ASN1_TIME* time) {
    std::tm parts{};
    if (!time || ASN1_TIME_to_tm(time, &parts) != 1)
        return std::nullopt;
    return timegm(&parts);
}

}  // namespace theatron::net::openssl
