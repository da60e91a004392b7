// SPDX-License-Identifier: Apache-2.0
// How people reach a host over the network, apart from its address and certificate.
#pragma once

#include <optional>

#include "net/http.h"
#include "net/proxies.h"

namespace theatron::net {

struct Access {
    // Requests for other names are answered with 421. nullopt: every name is right.
    std::optional<PublicName> name;
    Proxies proxies;
    // Answers carry Strict-Transport-Security.
    bool insists_on_https = false;
};

}  // namespace theatron::net
