// SPDX-License-Identifier: Apache-2.0
// Server and client over a real loopback connection.
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/steady_clock.h"
#include "net/client.h"
#include "net/server.h"
#include "wire/media_header.h"

namespace theatron::net {
namespace {

struct TestServer {
    explicit TestServer(Server::Handler handler)
        : server({"127.0.0.1", 0}, certificate, filled(std::move(handler))) {
        thread = std::thread([this] { server.run(); });
    }
    ~TestServer() {
        server.stop();
        thread.join();
    }
    static Server::Handler filled(Server::Handler h) {
        h.now = steady_now;
        if (!h.connected)
            h.connected = [](PeerId, const std::string&, bool) {};
        if (!h.control)
            h.control = [](PeerId, ByteView) {};
        if (!h.closed)
            h.closed = [](PeerId, const std::string&) {};
        return h;
    }
    Link link() const { return {"127.0.0.1", server.port(), "t", certificate.fingerprint}; }

    Certificate certificate = make_certificate();
    Server server;
    std::thread thread;
};

Client::Handler client_handler() {
    Client::Handler h;
    h.connected = [] {};
    h.control = [](ByteView) {};
    h.media = [](Bytes&) { return true; };
    h.now = steady_now;
    return h;
}

TEST(Connection, CarriesControlBothWaysAndMediaWhole) {
    TestServer* host = nullptr;
    Server::Handler handler;
    handler.control = [&](PeerId peer, ByteView bytes) {
        host->server.send_control(peer, Bytes(bytes.begin(), bytes.end()));
        Media media;
        auto message = std::make_shared<Bytes>(wire::media_header_size + 200'000);
        wire::MediaHeader header;
        header.key = true;
        header.payload_size = 200'000;
        wire::write_media_header(header, message->data());
        message->back() = std::byte{42};
        media.bytes = message;
        media.key = true;
        host->server.send_media(peer, media);
    };
    TestServer server(handler);
    host = &server;

    Client* self = nullptr;
    Bytes echoed;
    std::size_t media_size = 0;
    Client::Handler h = client_handler();
    h.connected = [&] { self->send_control(Bytes{std::byte{1}, std::byte{2}}); };
    h.control = [&](ByteView bytes) { echoed.assign(bytes.begin(), bytes.end()); };
    h.media = [&](Bytes& bytes) {
        media_size = bytes.size();
        EXPECT_EQ(bytes.back(), std::byte{42});
        EXPECT_TRUE(wire::parse_media_header(bytes));
        self->stop();
        return true;
    };
    Client client(server.link(), h);
    self = &client;
    EXPECT_EQ(client.run().why, "");
    EXPECT_EQ(echoed.size(), 2u);
    EXPECT_EQ(media_size, wire::media_header_size + 200'000);
}

TEST(Connection, RefusesAnotherCertificate) {
    Server::Handler handler;
    handler.connected = [&](PeerId, const std::string&, bool) {
        ADD_FAILURE() << "must not get this far";
    };
    TestServer server(handler);
    Link link = server.link();
    link.fingerprint = std::string(64, '0');
    const Client::End end = Client(link, client_handler()).run();
    EXPECT_TRUE(end.final);
    EXPECT_NE(end.why.find("another certificate"), std::string::npos);
}

TEST(Connection, AnotherCertificateIsShownFromNowOnAndWhoIsInStaysIn) {
    TestServer server({});
    const Certificate other = make_certificate();
    const Link old_link = server.link();
    Link new_link = old_link;
    new_link.fingerprint = other.fingerprint;
    const auto end_of = [](const Link& link, const std::function<void(Client&)>& connected) {
        Client::Handler h = client_handler();
        Client* self = nullptr;
        h.connected = [&] { connected(*self); };
        Client client(link, h);
        self = &client;
        return client.run();
    };
    const Client::End kept = end_of(old_link, [&](Client& first) {
        server.server.set_certificate(other);
        EXPECT_EQ(end_of(new_link, [](Client& second) { second.stop(); }).why, "");
        EXPECT_TRUE(end_of(old_link, [](Client&) { ADD_FAILURE(); }).final);
        first.stop();
    });
    EXPECT_EQ(kept.why, "");
    EXPECT_THROW(server.server.set_certificate({"no PEM", "no PEM", ""}), Error);
}

TEST(Connection, SaysWhenNobodyAnswers) {
    Link link{"127.0.0.1", 1, "t", std::string(64, '0')};
    const Client::End end = Client(link, client_handler()).run();
    EXPECT_FALSE(end.final);
    EXPECT_NE(end.why.find("No host answers at 127.0.0.1:1"), std::string::npos);
}

TEST(Connection, BothSidesLearnOfTheEnd) {
    std::promise<std::string> closed;
    TestServer* host = nullptr;
    Server::Handler handler;
    handler.control = [&](PeerId peer, ByteView) {
        host->server.send_control(peer, Bytes{std::byte{9}});
        host->server.close(peer, "refused");
    };
    handler.closed = [&](PeerId, const std::string& why) { closed.set_value(why); };
    TestServer server(handler);
    host = &server;

    Client* self = nullptr;
    bool last_word = false;
    Client::Handler h = client_handler();
    h.connected = [&] { self->send_control(Bytes{std::byte{1}}); };
    h.control = [&](ByteView) { last_word = true; };
    Client client(server.link(), h);
    self = &client;
    EXPECT_NE(client.run().why.find("The connection ended"), std::string::npos);
    EXPECT_TRUE(last_word);
    EXPECT_EQ(closed.get_future().get(), "refused");
}

TEST(Connection, WhoIsSentAwayGetsTheReasonAndNothingThatWaitedOutADelay) {
    TestServer* host = nullptr;
    Server::Handler handler;
    const Bytes sound(20, std::byte{3});
    handler.control = [&](PeerId peer, ByteView) {
        host->server.set_delay(peer, 300ms);
        host->server.send_voice(peer, {ParticipantId{7}, sound});
        host->server.send_control(peer, Bytes{std::byte{9}});
        host->server.close(peer, "refused");
    };
    TestServer server(handler);
    host = &server;

    Client* self = nullptr;
    bool last_word = false;
    int voices = 0;
    Client::Handler h = client_handler();
    h.connected = [&] { self->send_control(Bytes{std::byte{1}}); };
    h.control = [&](ByteView) { last_word = true; };
    h.voice = [&](const wire::Voice&) { ++voices; };
    Client client(server.link(), h);
    self = &client;
    EXPECT_NE(client.run().why.find("The connection ended"), std::string::npos);
    EXPECT_TRUE(last_word);
    EXPECT_EQ(voices, 0);
}

TEST(Connection, WhoLeavesIsHeardToTheEnd) {
    // The second one waits for the first, and none for a third turn of a loop that may be late.
    constexpr std::size_t messages = 2, size = 1000;
    std::vector<Bytes> heard;
    std::promise<void> closed;
    Server::Handler handler;
    handler.control = [&](PeerId, ByteView bytes) {
        heard.emplace_back(bytes.begin(), bytes.end());
    };
    handler.closed = [&](PeerId, const std::string&) { closed.set_value(); };
    TestServer server(handler);

    Client* self = nullptr;
    Client::Handler h = client_handler();
    h.connected = [&] {
        for (std::size_t n = 0; n < messages; ++n)
            self->send_control(Bytes(size, std::byte(n)));
        self->leave();
    };
    Client client(server.link(), h);
    self = &client;
    EXPECT_EQ(client.run().why, "");
    closed.get_future().get();
    ASSERT_EQ(heard.size(), messages);
    EXPECT_EQ(heard.back(), Bytes(size, std::byte(messages - 1)));
}

TEST(Connection, WhoLeavesBeforeItIsConnectedEndsAtOnce) {
    Link link{"192.0.2.1", 1, "t", std::string(64, '0')};
    Client client(link, client_handler());
    client.leave();
    EXPECT_EQ(client.run().why, "");
}

// Answers each message with itself; a message that begins with 66 meets a fault of the host.
Server::Handler echo_that_can_throw(std::unique_ptr<TestServer>& host) {
    Server::Handler handler;
    handler.control = [&host](PeerId peer, ByteView bytes) {
        if (bytes[0] == std::byte{66})
            throw std::bad_alloc();
        host->server.send_control(peer, Bytes(bytes.begin(), bytes.end()));
    };
    return handler;
}

// The end of a client that sends `content`, waits until it comes back and stops.
Client::End echo(const Link& link, std::byte content) {
    Client* self = nullptr;
    Client::Handler h = client_handler();
    h.connected = [&] { self->send_control(Bytes{content}); };
    h.control = [&](ByteView) { self->stop(); };
    Client client(link, h);
    self = &client;
    return client.run();
}

TEST(Connection, AMessageWhoseHandlingThrowsCostsItsConnectionOnly) {
    std::unique_ptr<TestServer> server;
    server = std::make_unique<TestServer>(echo_that_can_throw(server));
    const std::uint64_t before = fault_count();
    std::promise<void> in, over;
    std::thread other([&] {
        Client* self = nullptr;
        bool first = true;
        Client::Handler h = client_handler();
        h.connected = [&] { self->send_control(Bytes{std::byte{1}}); };
        h.control = [&](ByteView) {
            if (!std::exchange(first, false))
                return self->stop();
            in.set_value();
            over.get_future().wait();
            self->send_control(Bytes{std::byte{2}});
        };
        Client client(server->link(), h);
        self = &client;
        EXPECT_EQ(client.run().why, "");
    });
    in.get_future().wait();
    EXPECT_NE(echo(server->link(), std::byte{66}).why, "");
    EXPECT_EQ(fault_count(), before + 1);
    over.set_value();
    other.join();
}

TEST(Connection, NothingThatAHandlerThrowsEndsTheServer) {
    std::unique_ptr<TestServer> server;
    Server::Handler handler = echo_that_can_throw(server);
    handler.tick = [] { throw std::runtime_error("a tick"); };
    handler.closed = [](PeerId, const std::string&) { throw 1; };
    handler.connected = [first = true](PeerId, const std::string&, bool) mutable {
        if (std::exchange(first, false))
            throw std::runtime_error("the first to come");
    };
    server = std::make_unique<TestServer>(std::move(handler));
    server->server.post([] { throw std::runtime_error("posted"); });
    EXPECT_NE(echo(server->link(), std::byte{1}).why, "");
    EXPECT_NE(echo(server->link(), std::byte{66}).why, "");
    EXPECT_EQ(echo(server->link(), std::byte{2}).why, "");
}

TEST(Connection, AHandlerOfAClientThatThrowsEndsTheConnection) {
    std::unique_ptr<TestServer> server;
    server = std::make_unique<TestServer>(echo_that_can_throw(server));
    Client* self = nullptr;
    Client::Handler h = client_handler();
    h.connected = [&] { self->send_control(Bytes{std::byte{1}}); };
    h.control = [&](ByteView) { throw std::bad_alloc(); };
    Client client(server->link(), h);
    self = &client;
    EXPECT_NE(client.run().why.find("fault"), std::string::npos);
}

TEST(Connection, TellsWhoShowsTheToken) {
    std::promise<bool> invited[2];
    Server::Handler handler;
    handler.invited = [](ByteView first) { return first[0] == std::byte{7}; };
    handler.connected = [&, n = 0](PeerId, const std::string&, bool is) mutable {
        invited[n++].set_value(is);
    };
    TestServer* host = nullptr;
    handler.control = [&](PeerId peer, ByteView bytes) {
        host->server.send_control(peer, Bytes(bytes.begin(), bytes.end()));
    };
    TestServer server(std::move(handler));
    host = &server;
    EXPECT_EQ(echo(server.link(), std::byte{7}).why, "");
    EXPECT_EQ(echo(server.link(), std::byte{8}).why, "");
    EXPECT_TRUE(invited[0].get_future().get());
    EXPECT_FALSE(invited[1].get_future().get());
}

TEST(Connection, APortInUseIsNamed) {
    TestServer server({});
    try {
        Server second({"127.0.0.1", server.server.port()}, server.certificate,
                      TestServer::filled({}));
        FAIL() << "the port was given twice";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("is in use"), std::string::npos);
    }
}

}  // namespace
}  // namespace theatron::net
