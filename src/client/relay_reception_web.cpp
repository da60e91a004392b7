// SPDX-License-Identifier: Apache-2.0
// A browser's page trusts no relay's own certificate: all its pictures come from the host.
#include "client/relay_reception.h"

namespace theatron::client {

struct RelayReception::Impl {};

bool RelayReception::is_possible() {
    return false;
}
RelayReception::RelayReception(Events) {}
RelayReception::~RelayReception() = default;
void RelayReception::set_grants(const std::vector<wire::RelayGrant>&) {}
void RelayReception::taken(std::uint64_t, std::size_t) {}

}  // namespace theatron::client
