// SPDX-License-Identifier: Apache-2.0
// HTTPS requests to a host. Its certificate must be the one that the link names.
#pragma once

#include <string>

#include "base/time.h"
#include "net/link.h"

namespace theatron::net {

inline constexpr Duration https_patience = std::chrono::seconds(10);

struct HttpsAnswer {
    int status = 0;
    std::string body;
};

// GET `target` with the link's token as bearer. Throws Error with one sentence if
// no answer comes in time, or not from this host.
HttpsAnswer https_get(const Link& link, const std::string& target,
                      Duration timeout = https_patience);

}  // namespace theatron::net
