// SPDX-License-Identifier: Apache-2.0
#include "net/congestion_control.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string_view>

namespace theatron::net {

void prefer_bbr(int descriptor) {
    constexpr std::string_view bbr = "bbr";
    // A kernel without it refuses, and the socket works as before: kernel_offers_bbr() tells it.
    (void)setsockopt(descriptor, IPPROTO_TCP, TCP_CONGESTION, bbr.data(), socklen_t(bbr.size()));
}

std::string congestion_control_of(int descriptor) {
    char name[16] = {};  // TCP_CA_NAME_MAX of the kernel
    socklen_t size = sizeof(name) - 1;
    if (getsockopt(descriptor, IPPROTO_TCP, TCP_CONGESTION, name, &size) != 0)
        return "";
    return name;
}

bool kernel_offers_bbr() {
    const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0)
        return false;
    prefer_bbr(descriptor);
    const bool offers = congestion_control_of(descriptor) == "bbr";
    close(descriptor);
    return offers;
}

}  // namespace theatron::net
