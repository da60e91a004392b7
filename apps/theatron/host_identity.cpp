// SPDX-License-Identifier: Apache-2.0
#include "host_identity.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "net/certificate.h"

namespace theatron::app {

std::filesystem::path default_state_folder() {
    if (const char* set = std::getenv("XDG_STATE_HOME"); set && *set)
        return std::filesystem::path(set) / "theatron";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home ? home : "/tmp") / ".local/state/theatron";
}

std::string load_or_make_token(const std::filesystem::path& folder, const char* name) {
    const auto path = folder / name;
    std::string token;
    std::ifstream(path) >> token;
    if (!token.empty())
        return token;
    token = net::random_token();
    std::ofstream out(path);
    out << token << "\n";
    out.close();
    if (!out)
        throw Error("Cannot write " + path.string() +
                    "; make its folder writable or name another with --state.");
    std::filesystem::permissions(
        path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return token;
}

std::string outside_address() {
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0)
        return "127.0.0.1";
    std::string found = "127.0.0.1";
    for (const ifaddrs* i = all; i; i = i->ifa_next) {
        if (!i->ifa_addr || i->ifa_addr->sa_family != AF_INET || (i->ifa_flags & IFF_LOOPBACK) ||
            !(i->ifa_flags & IFF_UP))
            continue;
        char text[INET_ADDRSTRLEN];
        const auto* address = reinterpret_cast<const sockaddr_in*>(i->ifa_addr);
        if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text)))
            found = text;
        break;
    }
    freeifaddrs(all);
    return found;
}

}  // namespace theatron::app
