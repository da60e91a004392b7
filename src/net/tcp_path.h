// SPDX-License-Identifier: Apache-2.0
// The kernel's knowledge of the way of the bytes of a TCP socket.
//
// A packet that is lost holds back all that came behind it, so a peer's program takes nothing until
// it has been sent again, and then much at once. Its acknowledgements alone make that a queue
// of a slow link. The kernel tells the two apart: the peer's kernel has reported the bytes that it
// has (RFC 2018).
#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"

namespace theatron::net {

struct TcpPath {
    std::uint32_t sent_again = 0;  // packets, since the connection began
    std::uint64_t behind_gap = 0;  // bytes that have arrived and wait there for a missing one
    Duration queue{};              // the round trip of late, less the shortest one
    double bytes_per_second = 0;   // that arrived of late; 0: not known
    std::uint32_t window = 0;      // packets that the kernel lets be in flight; 0: not known
};

// Empty: the system does not tell it. Never blocks.
std::optional<TcpPath> tcp_path(int descriptor);

}  // namespace theatron::net
