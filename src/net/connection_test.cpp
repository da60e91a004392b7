// SPDX-License-Identifier: Apache-2.0
// Server and client over a real loopback connection.
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "base/error.h"
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
    h.media = [](ByteView) {};
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
    h.media = [&](ByteView bytes) {
        media_size = bytes.size();
        EXPECT_EQ(bytes.back(), std::byte{42});
        EXPECT_TRUE(wire::parse_media_header(bytes));
        self->stop();
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
