// SPDX-License-Identifier: Apache-2.0
#include "host/session_switch.h"

#include <algorithm>

#include "base/fault.h"
#include "net/certificate.h"
#include "wire/control.h"

namespace theatron::host {
namespace {

// Nothing for another message.
std::optional<wire::Join> join_of(ByteView first) {
    auto message = wire::decode_to_host(first);
    auto* join = message ? std::get_if<wire::Join>(&*message) : nullptr;
    return join ? std::optional(std::move(*join)) : std::nullopt;
}

PortPlaces::Kind kind_of(const PortSession& session, wire::Role role, const wire::Join& join) {
    using Kind = PortPlaces::Kind;
    if (session::may(role, session::Right::manage))
        return Kind::operator_;
    if (!session.knows_again || !session.knows_again(join))
        return Kind::other;
    return join.records ? Kind::recorder_again : Kind::viewer_again;
}

}  // namespace

SessionNumber SessionSwitch::add(PortSession session) {
    const std::lock_guard lock(mutex_);
    const SessionNumber number{next_++};
    sessions_.emplace_back(number, std::move(session));
    places_.add(number);
    return number;
}

std::vector<net::PeerId> SessionSwitch::remove(SessionNumber number) {
    std::vector<net::PeerId> peers;
    std::erase_if(peers_, [&](const auto& entry) {
        if (entry.second == number)
            peers.push_back(entry.first);
        return entry.second == number;
    });
    alarms_.erase(number);
    places_.remove(number);
    const std::lock_guard lock(mutex_);
    std::erase_if(sessions_, [&](const auto& entry) { return entry.first == number; });
    return peers;
}

const PortSession* SessionSwitch::find(SessionNumber number) const {
    const auto found = std::ranges::find(sessions_, number, &Sessions::value_type::first);
    return found == sessions_.end() ? nullptr : &found->second;
}

const PortSession* SessionSwitch::find(net::PeerId peer) const {
    const auto found = peers_.find(peer);
    return found == peers_.end() ? nullptr : find(found->second);
}

// Asks every session, so that the time tells nothing about tokens.
SessionSwitch::Claim SessionSwitch::claim_of(ByteView first) const {
    Claim claim;
    const wire::Join join = join_of(first).value_or(wire::Join{});
    for (const auto& [number, session] : sessions_)
        if (const auto token = session.find_token(join.token); token && !claim.session)
            claim = {number, kind_of(session, token->role, join)};
    return claim;
}

bool SessionSwitch::has_place(ByteView first) const {
    const Claim claim = claim_of(first);
    return places_.has_place(claim.session.value_or(SessionNumber{}), claim.kind);
}

void SessionSwitch::set_closed(std::vector<ClosedSession> closed) {
    const std::lock_guard lock(closed_mutex_);
    closed_ = std::move(closed);
}

std::vector<ClosedSession> SessionSwitch::closed() const {
    const std::lock_guard lock(closed_mutex_);
    return closed_;
}

bool SessionSwitch::is_closed(const std::string& secret) const {
    const std::lock_guard lock(closed_mutex_);
    bool found = false;
    for (const ClosedSession& session : closed_)
        for (const std::string& token : session.tokens)
            found = net::equal_secrets(secret, token) || found;
    return found;
}

bool SessionSwitch::is_invited(ByteView first) const {
    const std::string secret = join_of(first).value_or(wire::Join{}).token;
    const std::lock_guard lock(mutex_);
    bool found = false;
    for (const auto& [number, session] : sessions_)
        found = session.find_token(secret).has_value() || found;
    return found || is_closed(secret);
}

void SessionSwitch::connected(net::PeerId peer, const std::string& address, bool invited) {
    entering_[peer] = {address, invited};
}

void SessionSwitch::control(net::PeerId peer, ByteView message) {
    if (const auto entering = entering_.extract(peer)) {
        if (sessions_.empty())
            return;
        const Claim claim = claim_of(message);
        if (!claim.session && is_closed(join_of(message).value_or(wire::Join{}).token))
            return turn_back_(peer);
        const SessionNumber number = claim.session.value_or(sessions_.front().first);
        peers_[peer] = number;
        if (claim.session)
            places_.enter(peer, number, claim.kind);
        find(number)->events.connected(peer, entering.mapped().address, entering.mapped().invited);
    }
    if (const PortSession* session = find(peer))
        session->events.control(peer, message);
}

void SessionSwitch::state(net::PeerId peer, const wire::State& state) {
    if (const PortSession* session = find(peer))
        session->events.state(peer, state);
}

void SessionSwitch::voice(net::PeerId peer, const wire::Voice& voice) {
    if (const PortSession* session = find(peer))
        session->events.voice(peer, voice);
}

void SessionSwitch::frame_left(net::PeerId peer) {
    if (const PortSession* session = find(peer))
        session->events.frame_left(peer);
}

void SessionSwitch::control_lost(net::PeerId peer) {
    if (const PortSession* session = find(peer))
        session->events.control_lost(peer);
}

bool SessionSwitch::media(net::PeerId peer, Bytes& message) {
    const PortSession* session = find(peer);
    return !session || session->events.media(peer, message);
}

void SessionSwitch::closed(net::PeerId peer, const std::string& why) {
    entering_.erase(peer);
    const PortSession* session = find(peer);
    peers_.erase(peer);
    places_.leave(peer);
    if (session)
        session->events.closed(peer, why);
}

void SessionSwitch::tick() {
    for (const auto& [number, session] : sessions_)
        (void)contain("net", session.events.tick);
}

void SessionSwitch::set_alarm(SessionNumber number, TimePoint when) {
    alarms_[number] = when;
    arm();
}

void SessionSwitch::alarm(TimePoint now) {
    armed_.reset();
    std::vector<SessionNumber> due;
    std::erase_if(alarms_, [&](const auto& entry) {
        if (entry.second <= now)
            due.push_back(entry.first);
        return entry.second <= now;
    });
    for (const SessionNumber number : due)
        if (const PortSession* session = find(number))
            (void)contain("net", session->events.alarm);
    arm();
}

void SessionSwitch::arm() {
    const auto earliest =
        std::ranges::min_element(alarms_, {}, [](const auto& entry) { return entry.second; });
    if (earliest == alarms_.end() || armed_ == earliest->second)
        return;
    armed_ = earliest->second;
    set_server_alarm_(*armed_);
}

}  // namespace theatron::host
