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
#include "client/relay_reception.h"
#include "net/client.h"
#include "net/sealed_media.h"
#include "session/relay_pace.h"
#include "wire/relay_greeting.h"

namespace theatron::client {
namespace {

// A relay that obeys flow control never reaches this.
constexpr std::size_t max_bytes_waiting = std::size_t(64) << 20;
// A frame is acknowledged on arrival while fewer frames than this wait to be decoded: those are on
// their way between threads, and the relay need not wait for them.
constexpr std::size_t frames_on_the_way = 4;

// All links to one relay share it.
struct Pace {
    std::mutex mutex;
    // Guarded by mutex.
    session::RelayPace pace{RelayReception::first_pause, RelayReception::longest_pause};
};

}  // namespace

// One relay, on a thread of its own.
class RelayReception::Link {
public:
    Link(std::uint64_t number, wire::RelayGrant grant, std::shared_ptr<Pace> pace,
         const Events& events)
        : number_(number),
          grant_(std::move(grant)),
          pace_(std::move(pace)),
          events_(events),
          addresses_(grant_.addresses) {
        add_key(grant_);
        thread_ = std::thread([this] {
            name_this_thread("relayed");
            (void)contain("relayed", [this] { run(); });
        });
    }
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
    // The same connection; its key may be another one.
    bool is_for(const wire::RelayGrant& grant) const {
        return grant.relay == grant_.relay && grant.addresses == grant_.addresses &&
               grant.port == grant_.port && grant.fingerprint == grant_.fingerprint &&
               grant.secret == grant_.secret;
    }
    void add_key(const wire::RelayGrant& grant) {
        const std::lock_guard lock(opening_);
        opener_.add_key(grant.key_number, grant.key);
    }

    // `opened`: the size of an opened message.
    void taken(std::size_t opened) {
        const std::size_t bytes = opened + net::media_seal_size;
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
            running_->send_control(wire::encode_relay_greeting(grant_.secret));
        };
        h.control = [](ByteView) {};
        h.media = [&](Bytes& message) {
            newest = steady_now();
            first = first.value_or(*newest);
            if (waiting_ >= max_frames_waiting || bytes_ + message.size() > max_bytes_waiting)
                return true;
            auto opened = open(message, why);
            if (!opened)
                return true;
            const bool is_taken = waiting_++ < frames_on_the_way;
            bytes_ += message.size();
            if (!is_taken) {
                const std::lock_guard lock(mutex_);
                untold_ += message.size();
            }
            events_.media(number_, *opened);
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
        client.set_patience(connect_patience);
        if (!begin(client))
            return Duration(0);
        const net::Client::End end = client.run();
        const bool stops = !finish();
        if (stops)
            why = "the host no longer allows it, or the session is over";
        else if (why.empty())
            why = end.why;
        events_.ended();
        if (first)
            log::info("relay", "pictures of a relay have ended",
                      {{"relay", int(grant_.relay)}, log::outside("why", why)});
        return first ? *newest - *first + std::chrono::microseconds(1) : Duration(0);
    }

    // nullopt: the message is left out, and with a forged one the connection ends.
    std::optional<Bytes> open(ByteView message, std::string& why) {
        net::MediaOpener::Failure failure{};
        std::optional<Bytes> opened;
        {
            const std::lock_guard lock(opening_);
            opened = opener_.open(message, failure);
        }
        unopened_ = opened ? 0 : unopened_ + 1;
        const bool is_forged = !opened && failure == net::MediaOpener::Failure::forged;
        if (is_forged || unopened_ > max_unopened) {
            why = is_forged ? "a picture was not what the session had sealed"
                            : "nothing that came could be opened";
            log::warning("relay", "a relay is not believed",
                         {{"relay", int(grant_.relay)}, {"why", why}});
            running_->stop();
        }
        return opened;
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
    const wire::RelayGrant grant_;
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
    int unopened_ = 0;  // messages in a row
    std::mutex opening_;
    net::MediaOpener opener_;  // guarded by opening_
    std::thread thread_;
};

struct RelayReception::Impl {
    std::uint64_t next = 1;
    std::mutex mutex;
    std::map<std::uint64_t, std::shared_ptr<Link>> links;  // guarded by mutex
    std::map<ParticipantId, std::shared_ptr<Pace>> paces;  // guarded by mutex
};

bool RelayReception::is_possible() {
    return true;
}

RelayReception::RelayReception(Events events)
    : events_(std::move(events)), impl_(std::make_unique<Impl>()) {}

RelayReception::~RelayReception() {
    set_grants({});
}

void RelayReception::set_grants(const std::vector<wire::RelayGrant>& grants) {
    std::vector<std::shared_ptr<Link>> ended;  // their threads are waited for without the lock
    const std::lock_guard lock(impl_->mutex);
    std::erase_if(impl_->links, [&](const auto& entry) {
        if (std::any_of(grants.begin(), grants.end(),
                        [&](const auto& grant) { return entry.second->is_for(grant); }))
            return false;
        ended.push_back(entry.second);
        return true;
    });
    for (const wire::RelayGrant& grant : grants) {
        if (grant.key.size() != net::media_seal_key_size)
            continue;
        const auto linked =
            std::find_if(impl_->links.begin(), impl_->links.end(),
                         [&](const auto& entry) { return entry.second->is_for(grant); });
        if (linked != impl_->links.end()) {
            linked->second->add_key(grant);
            continue;
        }
        const std::uint64_t number = impl_->next++;
        std::shared_ptr<Pace>& pace = impl_->paces[grant.relay];
        if (!pace)
            pace = std::make_shared<Pace>();
        impl_->links[number] = std::make_shared<Link>(number, grant, pace, events_);
    }
    std::erase_if(impl_->paces, [&](const auto& entry) {
        const std::lock_guard pace_lock(entry.second->mutex);
        return entry.second.use_count() == 1 && entry.second->pace.is_over(steady_now());
    });
}

void RelayReception::taken(std::uint64_t link, std::size_t bytes) {
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
