// SPDX-License-Identifier: Apache-2.0
#include "net/way_to_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using ::testing::AllOf;
using ::testing::HasSubstr;
using What = Unreached::What;

// The end of an attempt whose proxy answers the request with these bytes and closes.
class Attempt {
public:
    explicit Attempt(const std::string& answer) {
        asio::io_context io{1};
        tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
        tcp::socket peer(io);
        std::string request;
        acceptor.async_accept(peer, [&](beast::error_code) {
            asio::async_read_until(peer, asio::dynamic_buffer(request), "\r\n\r\n",
                                   [&](beast::error_code, std::size_t) {
                                       asio::write(peer, asio::buffer(answer));
                                       peer.shutdown(tcp::socket::shutdown_send);
                                   });
        });
        proxy_ = {"127.0.0.1", acceptor.local_endpoint().port(), ""};
        beast::tcp_stream stream(io);
        WayToHost way(stream, "2001:db8::7", 4400, proxy_);
        way.open(std::chrono::hours(1), [&](std::optional<Unreached> unreached) {
            ++ends;
            unreached_ = std::move(unreached);
            stream.expires_never();
        });
        io.run();
        EXPECT_TRUE(request.starts_with("CONNECT [2001:db8::7]:4400 HTTP/1.1\r\n")) << request;
    }

    bool is_open() const { return !unreached_; }
    What what() const { return unreached_.value().what; }
    bool is_final() const { return unreached_.value().is_final(); }
    std::string text() const { return text_of(unreached_.value(), proxy_); }
    std::string where() const { return proxy_->where(); }
    int ends = 0;

private:
    std::optional<OutgoingProxy> proxy_;
    std::optional<Unreached> unreached_;
};

TEST(WayToHost, IsOpenBehindTheConsentOfAProxy) {
    for (const char* consent :
         {"HTTP/1.1 200 Connection established\r\n\r\n",
          "HTTP/1.0 200 OK\r\nContent-Length: 7\r\n\r\n", "HTTP/1.1 204 x\r\n\r\n"}) {
        const Attempt attempt(consent);
        EXPECT_TRUE(attempt.is_open()) << consent;
        EXPECT_EQ(attempt.ends, 1);
    }
}

TEST(WayToHost, InterimAnswersOfAProxyAreSkipped) {
    const std::string interim =
        "HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 103 Early Hints\r\nLink: </x>\r\n\r\n";
    EXPECT_TRUE(Attempt(interim + "HTTP/1.1 200 OK\r\n\r\n").is_open());
    EXPECT_THAT(Attempt(interim + "HTTP/1.1 403 No\r\n\r\n").text(),
                HasSubstr("does not connect to it (403 Forbidden)"));
    EXPECT_EQ(Attempt(interim).what(), What::proxy_silent);
    EXPECT_EQ(Attempt("HTTP/1.1 101 Switching Protocols\r\n\r\n").what(), What::proxy_refuses);
}

TEST(WayToHost, AProxyThatWantsANameIsToldFromOneThatTakesNone) {
    const std::string refusal = "HTTP/1.1 407 x\r\n";
    for (const char* offer :
         {"", "Proxy-Authenticate: Basic realm=\"x\"\r\n",
          "Proxy-Authenticate: Negotiate, basic realm=x\r\n",
          "Proxy-Authenticate: NTLM\r\nProxy-Authenticate: Basic realm=x\r\n"}) {
        const Attempt attempt(refusal + offer + "\r\n");
        EXPECT_EQ(attempt.what(), What::proxy_wants_name) << offer;
        EXPECT_TRUE(attempt.is_final());
    }
    for (const char* offer : {"Proxy-Authenticate: Negotiate, NTLM\r\n",
                              "Proxy-Authenticate: Negotiate\r\nProxy-Authenticate: NTLM\r\n"}) {
        const Attempt attempt(refusal + offer + "\r\n");
        EXPECT_EQ(attempt.what(), What::proxy_wants_other_scheme) << offer;
        EXPECT_TRUE(attempt.is_final());
        EXPECT_THAT(attempt.text(),
                    AllOf(HasSubstr("the proxy " + attempt.where() + " wants"),
                          HasSubstr("does not support (Negotiate, NTLM)"), HasSubstr("NO_PROXY")));
    }
}

// The host cannot have spoken: in TLS it speaks second.
TEST(WayToHost, DataBehindTheConsentOfAProxyAreNoRefusal) {
    const Attempt attempt("HTTP/1.1 200 OK\r\n\r\nWelcome");
    EXPECT_EQ(attempt.what(), What::proxy_adds_data);
    EXPECT_FALSE(attempt.is_final());
    EXPECT_THAT(attempt.text(), HasSubstr("agrees (200) and then sends data of its own"));
}

}  // namespace
}  // namespace theatron::net
