// SPDX-License-Identifier: Apache-2.0
#include "net/content_digest.h"

#include <openssl/evp.h>

#include "base/error.h"

namespace theatron::net {
namespace {

struct FreeContext {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

class Sha256 final : public ContentDigest {
public:
    Sha256() : context_(EVP_MD_CTX_new()) {
        check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
    }

    void add(ByteView piece) override {
        check(EVP_DigestUpdate(context_.get(), piece.data(), piece.size()));
    }

    ContentHash finish() override {
        ContentHash hash;
        check(EVP_DigestFinal_ex(context_.get(),
                                 reinterpret_cast<unsigned char*>(hash.bytes.data()), nullptr));
        return hash;
    }

private:
    static void check(bool done) {
        if (!done)
            throw Error("OpenSSL cannot compute SHA-256 here.");
    }

    std::unique_ptr<EVP_MD_CTX, FreeContext> context_;
};

}  // namespace

std::unique_ptr<ContentDigest> make_content_digest() {
    return std::make_unique<Sha256>();
}

ContentHash content_hash(ByteView content) {
    Sha256 digest;
    digest.add(content);
    return digest.finish();
}

}  // namespace theatron::net
