// SPDX-License-Identifier: Apache-2.0
#include "net/congestion_control.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace theatron::net {
namespace {

class TcpSocket {
public:
    TcpSocket() : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
    ~TcpSocket() { close(descriptor_); }
    TcpSocket(const TcpSocket&) = delete;
    TcpSocket& operator=(const TcpSocket&) = delete;
    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

std::string word_of(const char* file) {
    std::string word;
    std::ifstream(file) >> word;
    return word;
}

TEST(CongestionControl, IsBbrWhereTheKernelOffersItAndElseTheSystemsChoice) {
    const TcpSocket socket;
    const std::string usual = word_of("/proc/sys/net/ipv4/tcp_congestion_control");
    EXPECT_EQ(congestion_control_of(socket.descriptor()), usual);
    prefer_bbr(socket.descriptor());
    std::ifstream offered("/proc/sys/net/ipv4/tcp_available_congestion_control");
    const bool has_bbr = std::count(std::istream_iterator<std::string>(offered), {}, "bbr") > 0;
    EXPECT_EQ(kernel_offers_bbr(), has_bbr);
    EXPECT_EQ(congestion_control_of(socket.descriptor()), has_bbr ? "bbr" : usual);
}

TEST(CongestionControl, WhatIsNoSocketHasNone) {
    prefer_bbr(-1);
    EXPECT_EQ(congestion_control_of(-1), "");
}

}  // namespace
}  // namespace theatron::net
