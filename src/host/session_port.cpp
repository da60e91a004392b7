// SPDX-License-Identifier: Apache-2.0
#include "host/session_port.h"

#include <utility>

#include "base/error.h"
#include "base/log_scope.h"

namespace theatron::host {

namespace {

void name_in_log(net::Server::Handler& events, const std::string& session) {
    const auto name = [&](auto& event) { event = log::in_session(session, std::move(event)); };
    name(events.connected);
    name(events.control);
    name(events.state);
    name(events.voice);
    name(events.frame_left);
    name(events.control_lost);
    name(events.media);
    name(events.closed);
    name(events.tick);
    name(events.alarm);
}

}  // namespace

SessionPort::SessionPort(HostPort& port, PortSession session)
    : port_(port), name_in_log_(session.name_in_log), session_(std::move(session)) {
    name_in_log(session_.events, name_in_log_);
}

void SessionPort::begin() {
    const std::lock_guard changing(port_.changing_);
    if (port_.is_over_)
        throw Error("The host is ending, so this session cannot begin.");
    const auto enter = [this] { number_ = port_.sessions_.add(std::move(session_)); };
    if (port_.present_ == 0)
        enter();
    else
        port_.run_there(enter);
    {
        const std::lock_guard lock(share_->mutex);
        for (auto& work : std::exchange(share_->waiting, {}))
            send_there(std::move(work));
        share_->has_begun = true;
    }
    if (port_.present_++ == 0)
        port_.serve();
}

bool SessionPort::has_begun() const {
    const std::lock_guard lock(share_->mutex);
    return share_->has_begun;
}

void SessionPort::leave() {
    const std::lock_guard changing(port_.changing_);
    if (!has_begun())
        return;
    if (--port_.present_ == 0) {
        port_.is_over_ = true;
        port_.server_->stop();
        port_.thread_.join();
        (void)port_.sessions_.remove(number_);
        return;
    }
    port_.run_there([this] {
        for (const net::PeerId peer : port_.sessions_.remove(number_))
            port_.server_->close(peer, "the session has ended");
        share_->has_left = true;
    });
}

void SessionPort::post(std::function<void()> work) {
    const std::lock_guard lock(share_->mutex);
    if (share_->has_begun)
        send_there(std::move(work));
    else
        share_->waiting.push_back(std::move(work));
}

void SessionPort::send_there(std::function<void()> work) {
    port_.server_->post([share = share_, work = log::in_session(name_in_log_, std::move(work))] {
        if (!share->has_left)
            work();
    });
}

}  // namespace theatron::host
