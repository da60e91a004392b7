// SPDX-License-Identifier: Apache-2.0
// A browser's page cannot listen, and trusts no publisher's own certificate: all its pictures come
// through the host.
#include "client/direct_reception.h"
#include "client/direct_sender.h"

namespace theatron::client {

struct DirectSender::Impl {};

std::unique_ptr<DirectSender> DirectSender::open(Events) {
    return nullptr;
}
DirectSender::~DirectSender() = default;
wire::OfferDirect DirectSender::offer() const {
    return {};
}
void DirectSender::set_receivers(const std::vector<wire::DirectReceiver>&) {}
void DirectSender::send(const wire::MediaHeader&, const net::Media&) {}
std::size_t DirectSender::receivers() const {
    return 0;
}

struct DirectReception::Impl {};

bool DirectReception::is_possible() {
    return false;
}
DirectReception::DirectReception(Events) {}
DirectReception::~DirectReception() = default;
void DirectReception::set_grants(const std::vector<wire::DirectGrant>&) {}
void DirectReception::taken(std::uint64_t, std::size_t) {}

}  // namespace theatron::client
