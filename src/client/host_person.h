// SPDX-License-Identifier: Apache-2.0
// The id by which one host knows a person again (docs/decisions/people-and-links.md). It is made of
// the secret that the person's program keeps (client/person_id.h), which no host gets: what one
// host learns is of no use at another.
#pragma once

#include <string>

#include "base/bytes.h"
#include "net/link.h"

namespace theatron::client {

// The identity of the host to which a link leads: "name:" and its name, if that is one of the
// internet, which stays when its certificate is renewed; else "certificate:" and its fingerprint.
std::string host_identity(const net::Link& link);

// The id for that host, as in wire::Join; empty without a secret.
Bytes person_for_host(ByteView secret, const net::Link& link);

}  // namespace theatron::client
