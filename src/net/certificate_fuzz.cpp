// SPDX-License-Identifier: Apache-2.0
// Any file of a certification authority: reading it stays inside the input, and what is found can
// be read again as the same certificate.
#include <cstdlib>

#include "base/bytes.h"
#include "base/error.h"
#include "net/certificate_chain.h"
#include "net/certificate_request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    static const std::string key = net::make_key();
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    try {
        const auto found = net::certificates_in(bytes);
        for (const std::string& pem : found) {
            if (net::certificates_in(pem) != std::vector<std::string>{pem})
                std::abort();
            (void)net::names_of_certificate(pem);
            (void)net::certificate_mistake(pem, 1'800'000'000, "or-3.example");
        }
        (void)net::chain_of_key(found, key);
    } catch (const Error&) {
        // Most bytes are no certificate.
    }
    return 0;
}
