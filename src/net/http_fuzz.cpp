// SPDX-License-Identifier: Apache-2.0
// Any HTTP target, Authorization, Accept-Encoding, Origin, Host and X-Forwarded-For header, and any
// link: reading them stays inside the input, a link that is accepted can be written and read again,
// and the client of a proxy is one address.
#include <cstdlib>

#include "base/bytes.h"
#include "base/error.h"
#include "net/http.h"
#include "net/link.h"
#include "net/proxies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const std::size_t half = text.find('\n');
    const std::string first = text.substr(0, half),
                      second = half == std::string::npos ? "" : text.substr(half + 1);
    const std::string shown = net::shown_token({first, second});
    if (shown.size() > text.size() || !first.starts_with(net::path_of(first)))
        std::abort();
    (void)net::is_own_origin(first, second);
    (void)net::accepts_encoding(first, second);
    (void)net::is_named(first, "or-3.example");
    static const net::Proxies proxies({"10.0.0.0/8", "::1"});
    if (const auto client = proxies.client_of(first))
        if (proxies.client_of(*client) != client)
            std::abort();
    try {
        const net::Link link = net::parse_link(text);
        const net::Link again = net::parse_link(net::format_link(link));
        if (again.host != link.host || again.port != link.port || again.token != link.token)
            std::abort();
    } catch (const Error&) {
        // Most texts are no link.
    }
    return 0;
}
