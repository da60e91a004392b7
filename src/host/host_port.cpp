// SPDX-License-Identifier: Apache-2.0
#include "host/host_port.h"

#include <condition_variable>
#include <utility>

#include "base/clock_wait.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "host/operators_page.h"
#include "host/port_pages.h"
#include "net/congestion_control.h"

namespace theatron::host {

HostPort::HostPort(PortOptions options)
    : options_(std::move(options)),
      sessions_([this](TimePoint when) { server_->set_alarm(when); },
                [this](net::PeerId peer) { server_->close(peer, "its session is not open yet"); }) {
    sessions_.set_closed(options_.closed);
}

HostPort::~HostPort() = default;

void HostPort::require_free() const {
    if (!server_)
        net::require_free(options_.listen);
}

AuditLog* HostPort::open_audit() {
    if (options_.is_audited && !audit_)
        audit_ = std::make_unique<AuditLog>(options_.audit.empty() ? usual_audit_log(state_folder_)
                                                                   : options_.audit);
    return audit_.get();
}

void HostPort::open_page() {
    if (!page_)
        page_.emplace(options_.page);
}

void HostPort::open() {
    if (server_)
        return;
    server_ =
        std::make_unique<net::Server>(options_.listen, certificate_->current(), handler(), access_);
    if (!net::kernel_offers_bbr())
        log::info("host",
                  "this kernel offers no BBR, so people whose links lose packets get few pictures: "
                  "load the module tcp_bbr (docs/adaptive_sending.md)");
    note_link();
}

net::Server::Handler HostPort::handler() {
    net::Server::Handler h;
    h.invited = [this](ByteView first) { return sessions_.is_invited(first); };
    h.has_place = [this](ByteView first) { return sessions_.has_place(first); };
    h.turned_away = [this](const std::string& address, const std::string& why) {
        ++turned_away_;
        if (const auto left_out = strangers_.take(address, steady_now()))
            log::info("host", "stranger turned away",
                      {{"address", address}, {"why", why}, {"left_out", *left_out}});
    };
    h.http = [this](const net::HttpRequest& request) { return answer(request); };
    h.posted = [this](const net::HttpRequest& request, std::uint64_t bytes) {
        return take_body(request, bytes);
    };
    h.now = steady_now;
    h.tick = [this] { sessions_.tick(); };
    h.alarm = [this] { sessions_.alarm(steady_now()); };
    using net::PeerId;
    h.connected = [this](PeerId peer, const std::string& address, bool invited) {
        sessions_.connected(peer, address, invited);
    };
    h.control = [this](PeerId peer, ByteView message) { sessions_.control(peer, message); };
    h.state = [this](PeerId peer, const wire::State& state) { sessions_.state(peer, state); };
    h.voice = [this](PeerId peer, const wire::Voice& voice) { sessions_.voice(peer, voice); };
    h.frame_left = [this](PeerId peer) { sessions_.frame_left(peer); };
    h.control_lost = [this](PeerId peer) { sessions_.control_lost(peer); };
    h.media = [this](PeerId peer, Bytes& message) { return sessions_.media(peer, message); };
    h.closed = [this](PeerId peer, const std::string& why) { sessions_.closed(peer, why); };
    return h;
}

// On the door's thread.
net::HttpAnswer HostPort::answer(const net::HttpRequest& request) {
    if (sessions_.is_closed(net::shown_token(request)))
        return {.status = 503, .body = "This session is not open at the moment.\n"};
    if (LineProbe::is_line(request)) {
        auto refusal = refuse_line(request);
        return refusal ? std::move(*refusal) : line_.answer(request, steady_now());
    }
    const std::vector<ClosedSession> closed = sessions_.closed();
    const std::shared_ptr<const Page> page = page_->current();
    return sessions_.look([&](const SessionSwitch::Sessions& sessions) {
        return answer_page(request, *page, sessions, closed);
    });
}

// On the door's thread.
std::optional<net::HttpAnswer> HostPort::take_body(const net::HttpRequest& request,
                                                   std::uint64_t bytes) {
    if (is_of_operators(request)) {
        if (bytes > 0)
            return net::HttpAnswer{.status = 413, .body = "There is no body here.\n"};
        return sessions_.look([&](const SessionSwitch::Sessions& sessions) {
            return act_for_operator(request, sessions, {link(), own_link(), state_folder_});
        });
    }
    if (!LineProbe::is_line(request))
        return std::nullopt;
    auto refusal = refuse_line(request);
    return refusal ? std::move(refusal) : line_.take_body(bytes, steady_now());
}

std::optional<net::HttpAnswer> HostPort::refuse_line(const net::HttpRequest& request) const {
    return sessions_.look([&](const SessionSwitch::Sessions& sessions) {
        return host::refuse_line(request, sessions);
    });
}

void HostPort::serve() {
    thread_ = std::thread([this] {
        name_this_thread("net");
        (void)contain("net", [this] { server_->run(); });
    });
}

void HostPort::run_there(const std::function<void()>& work) {
    struct Done {
        std::mutex mutex;
        std::condition_variable changed;
        bool is_done = false;
    };
    const auto done = std::make_shared<Done>();
    server_->post([work, done] {
        (void)contain("net", work);
        const std::lock_guard lock(done->mutex);
        done->is_done = true;
        done->changed.notify_all();
    });
    std::unique_lock lock(done->mutex);
    wait(done->changed, lock, [&] { return done->is_done; });
}

net::Link HostPort::link() const {
    const std::lock_guard lock(mutex_);
    return link_;
}

net::Link HostPort::own_link() const {
    net::Link own;
    own.host = options_.listen.address == "0.0.0.0" ? "127.0.0.1"
               : options_.listen.address == "::"    ? "::1"
                                                    : options_.listen.address;
    own.port = number();
    const std::lock_guard lock(mutex_);
    own.fingerprint = certificates_.front().fingerprint;
    return own;
}

std::vector<HostFigures::Certificate> HostPort::certificates() const {
    const std::lock_guard lock(mutex_);
    return certificates_;
}

}  // namespace theatron::host
