// SPDX-License-Identifier: Apache-2.0
// Connects a stream to a host by TCP: directly, or through the tunnel of an outgoing proxy.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "net/outgoing_proxy.h"

namespace theatron::net {

// The reason why a host was not reached.
struct Unreached {
    enum class What {
        host_unknown,  // its name has no address
        host_silent,
        proxy_silent,
        proxy_wants_name,          // and a password, or others
        proxy_wants_other_scheme,  // than names and passwords, which alone are supported
        proxy_refuses,
        proxy_adds_data  // behind its consent, where the host's bytes would come
    };
    What what{};
    std::string because;  // the system's or the proxy's words

    // Another attempt with the same settings has the same end.
    bool is_final() const {
        return what == What::proxy_wants_name || what == What::proxy_wants_other_scheme;
    }
};

// A sentence without a full stop and without the host's name, in the person's language.
std::string text_of(const Unreached& unreached, const std::optional<OutgoingProxy>& proxy);

// One attempt. Used on the stream's thread; the stream must outlive it.
class WayToHost {
public:
    WayToHost(boost::beast::tcp_stream& stream, std::string host, std::uint16_t port,
              std::optional<OutgoingProxy> proxy);
    ~WayToHost();

    // Calls `done` once, unless this and the stream are destroyed before, which must be when the
    // loop no longer runs: with nullopt when bytes
    // that are written to the stream reach the host. The stream's time runs out after `patience`,
    // which the caller may then set anew.
    void open(Duration patience, std::function<void(std::optional<Unreached>)> done);

private:
    // The longest answer of a proxy, bytes.
    static constexpr unsigned max_answer = 16 << 10;

    struct Answer;
    void connect(const boost::asio::ip::tcp::resolver::results_type& found);
    void ask_for_tunnel();
    void read_answer();
    void take_answer();

    boost::beast::tcp_stream& stream_;
    std::string host_;
    std::uint16_t port_;
    std::optional<OutgoingProxy> proxy_;
    boost::asio::ip::tcp::resolver resolver_;
    Duration patience_{};
    std::function<void(std::optional<Unreached>)> done_;
    std::string request_;
    std::unique_ptr<Answer> answer_;
};

}  // namespace theatron::net
