// SPDX-License-Identifier: Apache-2.0
// A UDP socket on which packets of a face tracker arrive, or from which they are sent.
#pragma once

#include <string>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::visit {

class FaceSocket {
public:
    // For receiving. Throws Error.
    static FaceSocket bound(const std::string& address, int port);
    // For sending. Throws Error.
    static FaceSocket to(const std::string& address, int port);
    ~FaceSocket();
    FaceSocket(FaceSocket&& other) noexcept;
    FaceSocket(const FaceSocket&) = delete;
    FaceSocket& operator=(const FaceSocket&) = delete;
    FaceSocket& operator=(FaceSocket&&) = delete;

    // The next packet, valid until the next call; empty if none came within `patience`.
    ByteView receive(Duration patience);
    // A packet that nobody takes is lost, as with every UDP sender.
    void send(ByteView packet);

private:
    explicit FaceSocket(int socket);

    int socket_;
    Bytes buffer_;
};

}  // namespace theatron::visit
