// SPDX-License-Identifier: Apache-2.0
#include "visit/face_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "face/osc.h"

namespace theatron::visit {
namespace {

sockaddr_in socket_address(const std::string& address, int port) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(std::uint16_t(port));
    if (inet_pton(AF_INET, address.c_str(), &result.sin_addr) != 1)
        throw Error("'" + address + "' is no IPv4 address, such as 127.0.0.1.");
    return result;
}

int new_udp_socket() {
    const int opened = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (opened < 0)
        throw Error("Cannot open a socket: " + std::string(std::strerror(errno)) + ".");
    return opened;
}

}  // namespace

FaceSocket::FaceSocket(int socket) : socket_(socket), buffer_(face::max_osc_packet) {}

FaceSocket::FaceSocket(FaceSocket&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), buffer_(std::move(other.buffer_)) {}

FaceSocket::~FaceSocket() {
    if (socket_ >= 0)
        ::close(socket_);
}

FaceSocket FaceSocket::bound(const std::string& address, int port) {
    const sockaddr_in at = socket_address(address, port);
    FaceSocket result(new_udp_socket());
    if (::bind(result.socket_, reinterpret_cast<const sockaddr*>(&at), sizeof(at)) != 0)
        throw Error("Cannot listen on " + address + ", port " + std::to_string(port) + ": " +
                    std::strerror(errno) + ". Is another program listening there?");
    return result;
}

FaceSocket FaceSocket::to(const std::string& address, int port) {
    const sockaddr_in at = socket_address(address, port);
    FaceSocket result(new_udp_socket());
    if (::connect(result.socket_, reinterpret_cast<const sockaddr*>(&at), sizeof(at)) != 0)
        throw Error("Cannot send to " + address + ", port " + std::to_string(port) + ": " +
                    std::strerror(errno) + ".");
    return result;
}

ByteView FaceSocket::receive(Duration patience) {
    pollfd wait{socket_, POLLIN, 0};
    const int timeout_ms = int(std::max<std::int64_t>(0, (patience.count() + 999) / 1000));
    if (::poll(&wait, 1, timeout_ms) <= 0)
        return {};
    const ssize_t size = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    return size > 0 ? ByteView(buffer_).first(std::size_t(size)) : ByteView();
}

void FaceSocket::send(ByteView packet) {
    (void)::send(socket_, packet.data(), packet.size(), 0);
}

}  // namespace theatron::visit
