// SPDX-License-Identifier: Apache-2.0
#include "relay/upstream.h"

#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/outside_text.h"
#include "base/random_number.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "net/certificate.h"
#include "wire/envelope.h"
#include "wire/sentence.h"

namespace theatron::relay {
namespace {

constexpr std::size_t max_remark = 300;  // characters
// The host answers the first ones quickly, so that the clock is known; then it only drifts.
constexpr int quick_pings = 8, pongs_before_offer = 3;
constexpr Duration quick_ping = std::chrono::milliseconds(100), slow_ping = std::chrono::seconds(1);

session::ViewerSession::Wishes wishes_of(const net::Link& link, const std::string& name) {
    session::ViewerSession::Wishes wishes;
    wishes.token = link.token;
    wishes.name = name;
    wishes.features = {wire::Feature::sends_only, wire::Feature::relays};
    // By both the host knows an earlier connection of this relay, and ends it.
    wishes.person = net::random_bytes(wire::person_id_size);
    wishes.run = random_number();
    return wishes;
}

}  // namespace

Upstream::Upstream(net::Link link, const std::string& name, wire::OfferRelay offer, Events events)
    : link_(std::move(link)),
      offer_(std::move(offer)),
      events_(std::move(events)),
      session_(wishes_of(link_, name)) {
    if (session_.begin().size() + 1 > wire::max_first_envelope_size)
        throw Error("The relay's name is too long.");
    thread_ = std::thread([this] {
        name_this_thread("upstream");
        (void)contain("upstream", [this] { run(); });
    });
}

Upstream::~Upstream() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        if (client_)
            client_->leave();
    }
    changed_.notify_all();
    thread_.join();
}

Upstream::Status Upstream::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

TimePoint Upstream::now() const {
    return steady_now() + Duration(offset_us_);
}

void Upstream::report(wire::RelayReport report) {
    const std::lock_guard lock(mutex_);
    if (client_ && status_.phase == Phase::joined)
        client_->post([this, report = std::move(report)] {
            const std::lock_guard inner(mutex_);
            if (client_)
                client_->send_control(wire::encode(report));
        });
}

void Upstream::run() {
    while (true) {
        net::Client client(link_, handler());
        {
            const std::lock_guard lock(mutex_);
            if (stopping_)
                return;
            client_ = &client;
        }
        const net::Client::End ended = client.run();
        const auto wait = end(ended);
        std::unique_lock lock(mutex_);
        if (!wait || changed_.wait_for(lock, *wait, [this] { return stopping_; }))
            return;
    }
}

std::optional<Duration> Upstream::end(const net::Client::End& end) {
    events_.receivers({});
    std::unique_lock lock(mutex_);
    client_ = nullptr;
    if (stopping_)
        return std::nullopt;
    if (status_.phase == Phase::joined)
        attempts_.came_in();
    const auto judged =
        attempts_.after({session_.refusal(), session_.goodbye(), end.why, end.final});
    using Next = client::Attempts::Next;
    const bool is_news = status_.problem != judged.why || status_.phase == Phase::joined;
    status_.phase = judged.next == Next::again   ? Phase::lost
                    : judged.next == Next::ended ? Phase::ended
                                                 : Phase::refused;
    status_.problem = clean_text(judged.why, max_remark);
    lock.unlock();
    if (is_news)
        events_.remark(clean_text(judged.why, max_remark));
    return judged.next == Next::again ? std::optional(judged.wait) : std::nullopt;
}

net::Client::Handler Upstream::handler() {
    net::Client::Handler h;
    h.connected = [this] {
        pings_ = pongs_ = 0;
        next_ping_ = steady_now();
        clock_.forget();
        client_->send_control(session_.begin());
    };
    h.control = [this](ByteView message) { on_control(message); };
    h.media = [this](Bytes& message) {
        const auto header = wire::parse_media_header(message);
        if (header && session_.joined())
            events_.media(*header, std::make_shared<const Bytes>(std::move(message)));
        message = {};
        return true;
    };
    h.now = steady_now;
    h.tick = [this] { on_tick(); };
    return h;
}

void Upstream::on_control(ByteView message) {
    using Change = session::ViewerSession::Change;
    switch (session_.on_control(message)) {
        case Change::welcomed: {
            {
                const std::lock_guard lock(mutex_);
                status_.phase = Phase::joined;
                status_.problem.clear();
                status_.host_name = session_.welcome().host_name;
                ++status_.joins;
            }
            if (!session_.has(wire::Feature::relays))
                return client_->end("the host is of a version that knows no relays");
            break;
        }
        case Change::relay_receivers:
            events_.receivers(session_.relay_receivers().receivers);
            break;
        case Change::pong: {
            const wire::Pong& pong = session_.pong();
            clock_.add(pong.ping_sent, pong.received, pong.sent, steady_now());
            if (++pongs_ != pongs_before_offer)
                break;
            // Once for a connection: the time of those that are served never jumps.
            offset_us_ = clock_.offset().count();
            client_->send_control(wire::encode(offer_));
            break;
        }
        case Change::refused:
            client_->end("");
            break;
        default:
            break;
    }
}

void Upstream::on_tick() {
    const TimePoint now = steady_now();
    if (!session_.joined() || now < next_ping_)
        return;
    client_->send_control(wire::encode(wire::Ping{now}));
    next_ping_ = now + (++pings_ < quick_pings ? quick_ping : slow_ping);
}

const char* text_of(Upstream::Phase phase) {
    switch (phase) {
        case Upstream::Phase::connecting:
            return "connecting";
        case Upstream::Phase::joined:
            return "joined";
        case Upstream::Phase::lost:
            return "lost";
        case Upstream::Phase::refused:
            return "refused";
        case Upstream::Phase::ended:
            return "ended";
    }
    return "unknown";
}

}  // namespace theatron::relay
