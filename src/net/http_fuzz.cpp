// SPDX-License-Identifier: Apache-2.0
// Any HTTP target, Authorization, Accept-Encoding and Origin header, and any link: reading them
// stays inside the input, and a link that is accepted can be written and read again.
#include <cstdlib>

#include "base/bytes.h"
#include "base/error.h"
#include "net/http.h"
#include "net/link.h"

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
