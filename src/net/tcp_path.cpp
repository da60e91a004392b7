// SPDX-License-Identifier: Apache-2.0
#include "net/tcp_path.h"

// The kernel's own header: the C library's tcp_info ends before the rates.
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstddef>

namespace theatron::net {

std::optional<TcpPath> tcp_path(int descriptor) {
    tcp_info info{};
    socklen_t size = sizeof(info);
    if (getsockopt(descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0 ||
        size < offsetof(tcp_info, tcpi_delivery_rate) + sizeof(info.tcpi_delivery_rate))
        return std::nullopt;
    TcpPath path;
    path.sent_again = info.tcpi_total_retrans;
    path.behind_gap = std::uint64_t(info.tcpi_sacked) * info.tcpi_snd_mss;
    path.queue =
        std::chrono::microseconds(info.tcpi_rtt - std::min(info.tcpi_min_rtt, info.tcpi_rtt));
    path.bytes_per_second = double(info.tcpi_delivery_rate);
    path.window = info.tcpi_snd_cwnd;
    return path;
}

}  // namespace theatron::net
