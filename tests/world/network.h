// SPDX-License-Identifier: Apache-2.0
// The network of a World: ports that somebody listens on, and connections over links that delay,
// lose and break. As on a TCP connection nothing is lost and nothing is overtaken: a lost packet
// holds back what was sent after it, and a broken link ends the connection.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "simulation/simulated_link.h"

namespace theatron::world {

enum class Fault { none, closed, refused, reset, timeout, aborted };

class Plug;

// The link of one machine to all others.
class Path {
public:
    explicit Path(unsigned seed) : seed_(seed) {}

    // For connections that begin from now on.
    Duration delay = std::chrono::milliseconds(20);  // one way
    double bytes_per_second = 10e6;
    double loss = 0;  // chance of an envelope to hold back all for some round trips

    // Nothing passes until mend(). Both ends notice it after Plug::longest_silence.
    void cut();
    void mend();
    bool is_cut() const { return is_cut_; }
    // Its connections end, as with a router that forgets them.
    void reset();
    std::size_t connections() const;

private:
    friend class Plug;
    friend class Network;
    unsigned next_seed() { return ++seed_; }

    unsigned seed_;
    bool is_cut_ = false;
    std::uint64_t cuts_ = 0;
    std::vector<std::weak_ptr<Plug>> plugs_;
    std::deque<std::function<void()>> at_mend_;
};

// One end of a connection. Calls come as events of the Schedule.
class Plug : public std::enable_shared_from_this<Plug> {
public:
    // As that of net/silence.h, which a WebSocket keeps by pings.
    static constexpr Duration longest_silence = std::chrono::seconds(30);
    // Bytes that the system takes although they cannot leave.
    static constexpr std::size_t most_unsent = 64 * 1024;

    Plug(std::shared_ptr<Path> path, unsigned seed);
    static std::pair<std::shared_ptr<Plug>, std::shared_ptr<Plug>> connect(
        std::shared_ptr<Path> path);

    // One at a time of each. `bytes` are valid during the call.
    void read(std::function<void(Fault, ByteView)> done);
    void write(Bytes envelope, std::function<void(Fault)> done);
    void say_end();  // the other side reads `closed` behind what was written
    void close();    // the same; nothing more is read or written here
    void fail(Fault fault);

private:
    friend class Path;
    void send(Bytes envelope);
    void deliver();
    void arrive(Bytes envelope);
    void try_to_read();
    void finish_write();

    const std::shared_ptr<Path> path_;
    std::weak_ptr<Plug> other_;
    testing::SimulatedLink out_;
    std::size_t under_way_ = 0;  // bytes
    std::deque<Bytes> arrived_;  // an empty one is the end
    std::function<void(Fault, ByteView)> reading_;
    std::function<void(Fault)> writing_;
    Fault fault_ = Fault::none;
    bool has_ended_ = false, is_closed_ = false;
};

class Network {
public:
    // One for the process.
    static Network& instance();
    void begin(unsigned seed);

    using Accept = std::function<void(std::shared_ptr<Plug>, const std::string& address)>;
    struct Listener {
        Accept accept;
        std::function<std::string()> fingerprint;
    };
    bool is_free(std::uint16_t port) const { return !listeners_.contains(port); }
    // Port 0 gives a free one.
    std::uint16_t listen(std::uint16_t port, Listener listener);
    void stop_listening(std::uint16_t port) { listeners_.erase(port); }

    // The link of the machine that uses this name for the host.
    std::shared_ptr<Path> path(const std::string& name);
    // `done` gets the connection and the fingerprint of the host's certificate.
    using Connected = std::function<void(Fault, std::shared_ptr<Plug>, const std::string&)>;
    void connect(const std::string& name, std::uint16_t port, Duration patience, Connected done);

private:
    unsigned seed_ = 1;
    std::map<std::uint16_t, Listener> listeners_;
    std::map<std::string, std::shared_ptr<Path>> paths_;
};

}  // namespace theatron::world
