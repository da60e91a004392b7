// SPDX-License-Identifier: Apache-2.0
// As much of Boost.Asio and Boost.Beast as net/connection.cpp and net/server.cpp use, over the
// network and the time of a World. They are compiled with these names in place of Boost's, so what
// the World tests is the product's own sending, flow control and winding up of connections.
//
// Names have a namespace of their own: Boost itself may be in the same program.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "base/bytes.h"
#include "world/network.h"
#include "world/schedule.h"

namespace theatron::world {

struct ErrorCode {
    Fault fault = Fault::none;
    explicit operator bool() const { return fault != Fault::none; }
    bool operator==(const ErrorCode&) const = default;
    std::string message() const;
};

// The work of one io_context. Handlers run as events of the Schedule, until stop().
class Loop : public std::enable_shared_from_this<Loop> {
public:
    void post(std::function<void()> work);  // from any thread
    void stop();                            // from any thread
    void restart();
    std::size_t poll();
    // Waits for stop().
    void run();
    bool is_stopped() const;

    // Waits until this number of threads is in run().
    static void wait_for_running(int count);
    static int running();

private:
    bool run_one();

    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::deque<std::function<void()>> ready_;
    bool is_stopped_ = false;
};

}  // namespace theatron::world

namespace boost::asio {
inline namespace theatron_world {

namespace world = theatron::world;
using error_code = world::ErrorCode;

class io_context {
public:
    using executor_type = std::shared_ptr<world::Loop>;
    explicit io_context(int = 1) : loop_(std::make_shared<world::Loop>()) {}
    // Handlers that wait are destroyed, and none runs any more.
    ~io_context() { loop_->stop(); }
    io_context(const io_context&) = delete;
    void run() { loop_->run(); }
    void stop() { loop_->stop(); }
    void restart() { loop_->restart(); }
    std::size_t poll() { return loop_->poll(); }
    executor_type get_executor() const { return loop_; }

private:
    const executor_type loop_;
};

inline void post(io_context& io, std::function<void()> work) {
    io.get_executor()->post(std::move(work));
}

class steady_timer {
public:
    explicit steady_timer(io_context& io) : loop_(io.get_executor()) {}
    explicit steady_timer(io_context::executor_type loop) : loop_(std::move(loop)) {}
    ~steady_timer() { cancel(); }
    steady_timer(const steady_timer&) = delete;

    void expires_after(theatron::Duration wait) {
        cancel();
        when_ = world::Schedule::instance().now() + wait;
    }
    void async_wait(std::function<void(error_code)> done) {
        const auto wait = std::make_shared<Wait>(Wait{std::move(done)});
        wait_ = wait;
        const auto loop = loop_;
        key_ = world::Schedule::instance().at(when_, [wait, loop] {
            if (const auto now = std::exchange(wait->done, nullptr); now && !loop->is_stopped())
                now({});
        });
    }
    void cancel() {
        const auto wait = wait_.lock();
        if (!wait || !wait->done)
            return;
        loop_->post([done = std::exchange(wait->done, nullptr)] { done({world::Fault::aborted}); });
        world::Schedule::instance().cancel(key_);
    }

private:
    struct Wait {
        std::function<void(error_code)> done;
    };
    const io_context::executor_type loop_;
    theatron::TimePoint when_;
    world::Schedule::Key key_;
    std::weak_ptr<Wait> wait_;
};

struct buffer_view {
    const std::byte* bytes = nullptr;
    std::size_t count = 0;
    const void* data() const { return bytes; }
    std::size_t size() const { return count; }
};
inline buffer_view buffer(const theatron::Bytes& bytes) {
    return {bytes.data(), bytes.size()};
}

struct socket_base {
    struct receive_buffer_size {
        explicit receive_buffer_size(int) {}
    };
};

namespace error {
inline constexpr error_code eof{world::Fault::closed};
inline constexpr error_code connection_reset{world::Fault::reset};
inline constexpr error_code operation_aborted{world::Fault::aborted};
}  // namespace error

namespace ssl {
class context {};
namespace error {
inline constexpr error_code stream_truncated{world::Fault::closed};
}
}  // namespace ssl

namespace ip {
struct tcp {
    struct no_delay {
        explicit no_delay(bool) {}
    };
    class socket {
    public:
        enum shutdown_type { shutdown_send, shutdown_both };
        void set_option(const auto&, error_code&) {}
        void shutdown(shutdown_type, error_code&) {
            if (plug)
                plug->say_end();
        }
        int native_handle() const { return -1; }

        std::shared_ptr<world::Plug> plug;
    };
};
}  // namespace ip

}  // namespace theatron_world
}  // namespace boost::asio

namespace boost::beast {
inline namespace theatron_world {

namespace world = theatron::world;
using error_code = asio::error_code;
namespace error {
inline constexpr error_code timeout{world::Fault::timeout};
}

class flat_buffer {
public:
    void assign(theatron::ByteView bytes) { bytes_.assign(bytes.begin(), bytes.end()); }
    asio::buffer_view cdata() const { return {bytes_.data(), bytes_.size()}; }
    std::size_t size() const { return bytes_.size(); }
    void consume(std::size_t count) {
        bytes_.erase(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(count));
    }

private:
    theatron::Bytes bytes_;
};

class tcp_stream {
public:
    asio::ip::tcp::socket& socket() { return socket_; }
    void expires_never() {}
    void close() {
        if (socket_.plug)
            socket_.plug->close();
    }

private:
    asio::ip::tcp::socket socket_;
};

template <class Next>
class ssl_stream {};

namespace websocket {

namespace error {
inline constexpr error_code closed{world::Fault::closed};
}

struct stream_base {
    struct timeout {
        theatron::Duration handshake_timeout{}, idle_timeout{};
        bool keep_alive_pings = false;
    };
};

// The layers below are one: envelopes come whole.
template <class Next>
class stream {
public:
    stream(asio::io_context& io, std::shared_ptr<world::Plug> plug) : loop_(io.get_executor()) {
        lowest_.socket().plug = std::move(plug);
    }
    tcp_stream& lowest_layer() { return lowest_; }
    asio::io_context::executor_type get_executor() { return loop_; }
    void binary(bool) {}
    void auto_fragment(bool) {}
    void read_message_max(std::size_t) {}
    void set_option(const stream_base::timeout&) {}

    void async_read(flat_buffer& into, std::function<void(error_code, std::size_t)> done) {
        plug().read([&into, done = std::move(done), loop = loop_](world::Fault fault,
                                                                  theatron::ByteView bytes) {
            if (loop->is_stopped())
                return;
            if (fault == world::Fault::none)
                into.assign(bytes);
            done({fault}, bytes.size());
        });
    }
    void async_write(const asio::buffer_view& bytes,
                     std::function<void(error_code, std::size_t)> done) {
        plug().write(
            theatron::Bytes(bytes.bytes, bytes.bytes + bytes.count),
            [done = std::move(done), loop = loop_, count = bytes.count](world::Fault fault) {
                if (!loop->is_stopped())
                    done({fault}, count);
            });
    }

private:
    world::Plug& plug() { return *lowest_.socket().plug; }
    asio::io_context::executor_type loop_;
    tcp_stream lowest_;
};

}  // namespace websocket

template <class Next>
tcp_stream& get_lowest_layer(websocket::stream<Next>& stream) {
    return stream.lowest_layer();
}

}  // namespace theatron_world
}  // namespace boost::beast
