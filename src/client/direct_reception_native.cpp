// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "base/fault.h"
#include "base/hex_text.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "client/direct_reception.h"
#include "net/client.h"
#include "session/direct_pace.h"
#include "wire/direct_greeting.h"

namespace theatron::client {
namespace {

// A publisher that obeys flow control never reaches this.
constexpr std::size_t max_bytes_waiting = std::size_t(64) << 20;
// A frame is acknowledged on arrival while fewer frames than this wait to be decoded: those are on
// their way between threads, and the publisher need not wait for them.
constexpr std::size_t frames_on_the_way = 4;

// All links to one publisher share it.
struct Pace {
    std::mutex mutex;
    // Guarded by mutex.
    session::DirectPace pace{DirectReception::first_pause, DirectReception::longest_pause};
};

}  // namespace

// One publisher, on a thread of its own.
class DirectReception::Link {
public:
    Link(std::uint64_t number, wire::DirectGrant grant, std::shared_ptr<Pace> pace,
         const Events& events)
        : number_(number),
          grant_(std::move(grant)),
          pace_(std::move(pace)),
          events_(events),
          addresses_(grant_.addresses),
          thread_([this] {
              name_this_thread("direct");
              (void)contain("direct", [this] { run(); });
          }) {}
    ~Link() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
            if (client_)
                client_->stop();
        }
        changed_.notify_all();
        thread_.join();
    }
    const wire::DirectGrant& grant() const { return grant_; }

    void taken(std::size_t bytes) {
        --waiting_;
        bytes_ -= bytes;
        const std::lock_guard lock(mutex_);
        const std::size_t told = std::min(untold_, bytes);
        untold_ -= told;
        if (client_ && told > 0)
            client_->post([this, told, connection = connection_] {
                if (running_ && connection == connection_)
                    running_->taken(told);
            });
    }

private:
    void run() {
        while (wait_for_turn()) {
            Duration lasted{};
            for (auto address = addresses_.begin(); address != addresses_.end(); ++address) {
                lasted = connect(*address);
                if (stops())
                    break;
                if (lasted == Duration(0))
                    continue;
                // The next attempt begins with the address that has answered.
                std::rotate(addresses_.begin(), address, address + 1);
                break;
            }
            const std::lock_guard lock(pace_->mutex);
            pace_->pace.on_end(steady_now(), lasted > proven);
        }
    }

    // False when the link is to end.
    bool wait_for_turn() {
        std::unique_lock lock(mutex_);
        while (!stopping_) {
            Duration wait;
            {
                const std::lock_guard pace_lock(pace_->mutex);
                wait = pace_->pace.wait(steady_now());
                if (wait == Duration(0)) {
                    pace_->pace.on_attempt(steady_now());
                    return true;
                }
            }
            changed_.wait_for(lock, wait, [&] { return stopping_; });
        }
        return false;
    }

    bool stops() {
        const std::lock_guard lock(mutex_);
        return stopping_;
    }

    // Returns how long frames have come.
    Duration connect(const std::string& address) {
        std::optional<TimePoint> first, newest;
        std::string why;
        TimePoint begun = steady_now();
        net::Client::Handler h;
        h.connected = [&] {
            begun = steady_now();
            running_->send_control(wire::encode_direct_greeting(grant_.secret));
        };
        h.control = [](ByteView) {};
        h.media = [&](Bytes& message) {
            newest = steady_now();
            first = first.value_or(*newest);
            if (waiting_ >= max_frames_waiting || bytes_ + message.size() > max_bytes_waiting)
                return true;
            const bool is_taken = waiting_++ < frames_on_the_way;
            bytes_ += message.size();
            if (!is_taken) {
                const std::lock_guard lock(mutex_);
                untold_ += message.size();
            }
            events_.media(number_, grant_.publisher, message);
            message = {};
            return is_taken;
        };
        h.now = steady_now;
        h.tick = [&] {
            if (steady_now() - newest.value_or(begun) > silence) {
                why = "no picture came any more";
                running_->stop();
            }
        };
        net::Client client({address, grant_.port, "", hex_text(grant_.fingerprint)}, std::move(h));
        client.go_directly();
        client.set_patience(connect_patience);
        if (!begin(client))
            return Duration(0);
        const net::Client::End end = client.run();
        const bool stops = !finish();
        if (stops)
            why = "the host no longer allows it, or the session is over";
        else if (why.empty())
            why = end.why;
        events_.ended(grant_.publisher);
        if (first)
            log::info("direct", "direct pictures have ended",
                      {{"publisher", int(grant_.publisher)}, log::outside("why", why)});
        return first ? *newest - *first + std::chrono::microseconds(1) : Duration(0);
    }

    bool begin(net::Client& client) {
        const std::lock_guard lock(mutex_);
        if (stopping_)
            return false;
        client_ = running_ = &client;
        ++connection_;
        untold_ = 0;
        return true;
    }
    // False when the link is to end.
    bool finish() {
        const std::lock_guard lock(mutex_);
        client_ = running_ = nullptr;
        return !stopping_;
    }

    const std::uint64_t number_;
    const wire::DirectGrant grant_;
    const std::shared_ptr<Pace> pace_;
    const Events& events_;
    std::vector<std::string> addresses_;                // the thread of the link only
    std::atomic<std::size_t> waiting_ = 0, bytes_ = 0;  // frames, and their sizes
    std::mutex mutex_;
    std::condition_variable changed_;
    bool stopping_ = false;          // guarded by mutex_, as are the next
    net::Client* client_ = nullptr;  // while one runs
    std::size_t untold_ = 0;         // bytes of frames that were not acknowledged on arrival
    // The thread of the link only.
    net::Client* running_ = nullptr;
    std::uint64_t connection_ = 0;
    std::thread thread_;
};

struct DirectReception::Impl {
    std::uint64_t next = 1;
    std::mutex mutex;
    std::map<std::uint64_t, std::shared_ptr<Link>> links;  // guarded by mutex
    std::map<ParticipantId, std::shared_ptr<Pace>> paces;  // guarded by mutex
};

bool DirectReception::is_possible() {
    return true;
}

DirectReception::DirectReception(Events events)
    : events_(std::move(events)), impl_(std::make_unique<Impl>()) {}

DirectReception::~DirectReception() {
    set_grants({});
}

void DirectReception::set_grants(const std::vector<wire::DirectGrant>& grants) {
    std::vector<std::shared_ptr<Link>> ended;  // their threads are waited for without the lock
    const auto is_linked = [&](const wire::DirectGrant& grant) {
        return std::any_of(impl_->links.begin(), impl_->links.end(),
                           [&](const auto& entry) { return entry.second->grant() == grant; });
    };
    const std::lock_guard lock(impl_->mutex);
    std::erase_if(impl_->links, [&](const auto& entry) {
        if (std::find(grants.begin(), grants.end(), entry.second->grant()) != grants.end())
            return false;
        ended.push_back(entry.second);
        return true;
    });
    for (const wire::DirectGrant& grant : grants) {
        if (is_linked(grant))
            continue;
        const std::uint64_t number = impl_->next++;
        std::shared_ptr<Pace>& pace = impl_->paces[grant.publisher];
        if (!pace)
            pace = std::make_shared<Pace>();
        impl_->links[number] = std::make_shared<Link>(number, grant, pace, events_);
    }
    std::erase_if(impl_->paces, [&](const auto& entry) {
        const std::lock_guard pace_lock(entry.second->mutex);
        return entry.second.use_count() == 1 && entry.second->pace.is_over(steady_now());
    });
}

void DirectReception::taken(std::uint64_t link, std::size_t bytes) {
    std::shared_ptr<Link> found;
    {
        const std::lock_guard lock(impl_->mutex);
        if (const auto known = impl_->links.find(link); known != impl_->links.end())
            found = known->second;
    }
    if (found)
        found->taken(bytes);
}

}  // namespace theatron::client
