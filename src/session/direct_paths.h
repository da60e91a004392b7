// SPDX-License-Identifier: Apache-2.0
// Direct sending: which pictures go from their publisher straight to a receiver, and not through
// the host (docs/decisions/direct-sending.md).
//
// A publisher that listens and a receiver that gets its cameras share a path: both are told the
// same random secret. The receiver reports the settings whose frames come on the path; the host
// sends it the frames of all others. A path and the frames on it follow the tables of the streams:
// whoever is no longer in them loses its path in the same step.
//
// A pure state machine; it appends its messages to the list given to the constructor.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "session/host_actions.h"
#include "session/key_requests.h"
#include "session/streams.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class DirectPaths {
public:
    // wire::direct_secret_size random bytes.
    using MakeSecret = std::function<Bytes()>;
    // An empty `make_secret`: nothing is sent directly. `actions` must outlive the paths.
    DirectPaths(MakeSecret make_secret, std::vector<Action>& actions)
        : make_secret_(std::move(make_secret)), actions_(actions) {}

    bool is_possible() const { return bool(make_secret_); }

    // The host sees this participant at this address. Called before join().
    void set_address(ParticipantId participant, std::string address);
    // The participant takes part, and its program knows direct sending.
    void join(ParticipantId participant);
    void leave(ParticipantId participant);
    // False: the participant neither sends nor gets anything directly.
    void allow(ParticipantId participant, bool allowed);
    // The participant listens; direct_addresses.h says which of its addresses are believed. A port
    // below least_direct_port withdraws the offer.
    void offer(ParticipantId publisher, wire::OfferDirect offer);
    // The settings whose frames come directly to this receiver.
    void report(ParticipantId receiver, const std::vector<wire::StreamReport>& streams);

    // Brings paths and messages in line with the streams and the reports. Returns the streams that
    // need a key frame, because the host sends them to somebody again.
    std::vector<KeyRequests::Key> follow(const std::vector<StreamUse>& uses);
    // False while nobody listens: follow() has nothing to do.
    bool is_used() const { return !offers_.empty() || !told_receivers_.empty(); }
    // True once after a change here, after which follow() is to be called.
    bool take_change() { return std::exchange(has_changed_, false); }
    // Messages to this participant were dropped: sends it the current state.
    void tell_again(ParticipantId participant);

    // The host is to send this frame to this receiver. After direct frames that is so from a key
    // frame on.
    bool is_relayed(ParticipantId receiver, const wire::MediaHeader& header);
    bool is_direct(ParticipantId receiver, SettingId setting) const;

private:
    struct PathId {
        ParticipantId publisher{}, receiver{};
        auto operator<=>(const PathId&) const = default;
    };
    struct Path {
        Bytes secret;
        std::set<SettingId> settings;  // that the receiver gets
        std::set<SettingId> reported;  // those of them that come directly
    };
    using Wanted = std::map<PathId, std::set<SettingId>>;

    bool may_use(ParticipantId publisher, const StreamUse::Receiver& receiver) const;
    Wanted wanted_paths(const std::vector<StreamUse>& uses) const;
    void follow(const Wanted& wanted);
    std::map<ParticipantId, wire::DirectReceivers> to_publishers(
        const std::vector<StreamUse>& uses) const;
    std::map<ParticipantId, wire::DirectGrants> to_receivers() const;
    std::vector<std::string> addresses_for(const PathId& path) const;
    template <class Message>
    void tell(std::map<ParticipantId, Message>& told, std::map<ParticipantId, Message> now);

    const MakeSecret make_secret_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, std::string> addresses_;
    std::set<ParticipantId> members_;
    std::set<ParticipantId> held_back_;
    std::map<ParticipantId, wire::OfferDirect> offers_;
    std::map<PathId, Path> paths_;
    std::map<ParticipantId, std::set<SettingId>> reports_;
    bool has_changed_ = false;
    std::set<std::pair<ParticipantId, SettingId>> direct_;     // at the last follow()
    std::set<std::pair<ParticipantId, SettingId>> needs_key_;  // before the host sends again
    std::map<ParticipantId, wire::DirectReceivers> told_publishers_;
    std::map<ParticipantId, wire::DirectGrants> told_receivers_;
};

}  // namespace theatron::session
