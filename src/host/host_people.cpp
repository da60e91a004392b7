// SPDX-License-Identifier: Apache-2.0
// A host's links, the decisions on people, and the audit log.
#include <algorithm>

#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "host/host_identity.h"
#include "host/host_impl.h"
#include "net/certificate.h"
#include "wire/manage_text.h"

namespace theatron::host {

using What = session::AuditEvent::What;

namespace {

constexpr Duration problem_repeated_after = std::chrono::seconds(60);

}  // namespace

std::string Host::Impl::token_of(wire::Role role) const {
    for (const auto& token : links->tokens())
        if (token.link == wire::text_of(role))
            return token.secret;
    return "";
}

bool Host::Impl::must_ask(wire::Role role) const {
    return asks && (role == wire::Role::expert || role == wire::Role::observer);
}

bool Host::Impl::is_held_back(const std::string& secret) const {
    bool found = false;
    const std::lock_guard lock(figures_mutex);
    for (const std::string& token : tokens_held_back)
        found = net::equal_secrets(secret, token) || found;
    return found;
}

// On the door's thread. Those who must ask to come in see nothing before.
std::vector<std::string> Host::Impl::http_tokens() const {
    std::vector<std::string> secrets{metrics_token};
    const TimePoint now = steady_now();
    const files::UtcSeconds utc = files::utc_now();
    for (const auto& token : links->tokens()) {
        if (!must_ask(token.role) && !token.has_expired(now, utc))
            secrets.push_back(token.secret);
    }
    return secrets;
}

void Host::follow_links() {
    const TimePoint now = steady_now();
    if (impl_->links->follow(now)) {
        // The links of the moment at which the session takes them: an operator may revoke one
        // meanwhile.
        impl_->server->post([impl = impl_.get(), number = ++impl_->links_read] {
            impl->take_links();
            impl->links_applied = number;
        });
        log::info("host", "links changed");
    } else if (impl_->links_applied == impl_->links_read) {
        impl_->links->tell_followed(now);
    }
}

void Host::manage(wire::ManageAction action, ParticipantId person, wire::Role role) {
    impl_->server->post([impl = impl_.get(), action, person, role] {
        impl->decide({0, action, person, role});
    });
}

void Host::Impl::decide(const wire::Manage& decision, const std::string& by) {
    const auto refusal = session->manage(decision, steady_now(), by);
    if (refusal != wire::ManageRefusal::none)
        log::say(wire::text_of(refusal));
    carry_out();
}

void Host::Impl::audit_beginning() {
    if (!audit)
        return;
    audit->add(session::event_of_session(What::began, "", name), "");
    for (const wire::Camera& camera : session->streams().cameras().descriptions())
        audit->add(session::event_of_session(What::shared, "", camera.name), "");
}

void Host::Impl::take_links() {
    session->set_tokens(links->tokens(), links->makers());
    carry_out();
}

std::optional<std::string> Host::Impl::ended_recording() {
    const auto ended = recording->take_end(steady_now());
    if (!ended)
        return std::nullopt;
    if (audit)
        audit->add(
            session::event_of_session(What::recording_ended, session::at_the_host, ended->told),
            "");
    return ended->link;
}

void Host::Impl::follow_recording() {
    const auto link = ended_recording();
    if (!link)
        return;
    session->revoke_link(*link, session::at_the_host);
    carry_out();
}

HostFigures::Problems Host::Impl::problems() const {
    HostFigures::Problems problems;
    if (const std::string why = audit ? audit->problem() : ""; !why.empty())
        problems.audit_log = "The audit log cannot be written: " + why +
                             ". Its entries wait until it can, and those too many are counted.";
    if (!room_file->problem().empty())
        problems.room =
            "The room cannot be saved and would be lost with the host; its log says why.";
    problems.links = links->problem();
    return problems;
}

// An operator is told when it begins, when it lasts, and when it comes into a session that has one.
void Host::Impl::tell_problems() {
    const HostFigures::Problems now = problems();
    const TimePoint time = steady_now();
    for (const std::string& problem : {now.audit_log, now.room, now.links})
        for (const auto& [id, participant] : session->participants()) {
            if (problem.empty() || !participant.may(session::Right::manage))
                continue;
            const auto [told, is_new] = told_problems.try_emplace({id, problem}, time);
            if (!is_new && time - told->second < problem_repeated_after)
                continue;
            told->second = time;
            server->send_control(net::PeerId(std::uint32_t(id)),
                                 wire::encode(wire::Settings{{}, wire::as_written(problem)}));
        }
    std::erase_if(told_problems, [&](const auto& entry) {
        const auto& [id, problem] = entry.first;
        return (problem != now.audit_log && problem != now.room && problem != now.links) ||
               !session->participants().contains(id);
    });
}

// A guest that comes and goes all the time must not push everything else out of the log, nor hide
// who knocks.
void Host::Impl::carry_out(const session::action::Audit& a) {
    const session::AuditEvent& event = a.event;
    const auto found = addresses.find(net::PeerId(std::uint32_t(event.participant)));
    const std::string address = found == addresses.end() ? "" : found->second;
    const bool is_decision = !event.by.empty();
    const bool knocks = event.what == What::waits;
    const TimePoint now = steady_now();
    const bool is_stranger = event.what == What::refused && event.link.empty();
    if (audit && (is_decision || (is_stranger ? audited.take_of_stranger(now)
                                              : audited.take(event.link, event.person, now))))
        audit->add(event, address);
    else if (audit)
        audit->leave_out(event.what);
    if (!is_decision && !knocks)
        return;
    if (const auto left_out = joins.take(session::text_of(event.what) + address, now))
        log::info("host", session::text_of(event.what),
                  {{"id", int(event.participant)},
                   log::outside("name", event.name),
                   {"role", wire::text_of(event.role)},
                   log::outside("by", event.by),
                   {"left_out", *left_out}});
}

std::optional<session::Admission::Token> Host::Impl::find_token(const std::string& secret) const {
    std::optional<session::Admission::Token> found;
    for (auto& token : links->tokens())
        if (net::equal_secrets(secret, token.secret))
            found = std::move(token);
    return found;
}

// The session has already removed those who came by it.
void Host::Impl::carry_out(const session::action::RevokeLink& a) {
    links->revoke(a.link, steady_now());
}

// The speaker's number is that of the connection, whatever the packet says.
void Host::Impl::forward_voice(net::PeerId peer, const wire::Voice& voice) {
    const ParticipantId speaker{std::uint32_t(peer)};
    const auto forward = voices.on_voice(speaker, *session, steady_now());
    if (forward.is_flood)
        end_flood(peer, "there was far more voice than a person speaks");
    for (const ParticipantId receiver : forward.receivers)
        server->send_voice(net::PeerId{std::uint32_t(receiver)}, {speaker, voice.packet});
}

}  // namespace theatron::host
