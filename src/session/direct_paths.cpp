// SPDX-License-Identifier: Apache-2.0
#include "session/direct_paths.h"

#include <algorithm>
#include <utility>

#include "session/direct_addresses.h"

namespace theatron::session {

void DirectPaths::set_address(ParticipantId participant, std::string address) {
    addresses_[participant] = std::move(address);
}

void DirectPaths::join(ParticipantId participant) {
    members_.insert(participant);
    has_changed_ = true;
}

void DirectPaths::leave(ParticipantId participant) {
    has_changed_ = true;
    addresses_.erase(participant);
    members_.erase(participant);
    held_back_.erase(participant);
    offers_.erase(participant);
    reports_.erase(participant);
    told_publishers_.erase(participant);
    told_receivers_.erase(participant);
    std::erase_if(paths_, [&](const auto& entry) {
        return entry.first.publisher == participant || entry.first.receiver == participant;
    });
    const auto is_theirs = [&](const auto& entry) { return entry.first == participant; };
    std::erase_if(direct_, is_theirs);
    std::erase_if(needs_key_, is_theirs);
}

void DirectPaths::allow(ParticipantId participant, bool allowed) {
    has_changed_ = true;
    if (allowed)
        held_back_.erase(participant);
    else
        held_back_.insert(participant);
}

void DirectPaths::offer(ParticipantId publisher, wire::OfferDirect offer) {
    if (!is_possible() || !members_.contains(publisher))
        return;
    has_changed_ = true;
    std::erase_if(offer.addresses, [](const std::string& text) { return !parse_ipv4(text); });
    // The listener may be another one: no secret of the one before is shown to it.
    std::erase_if(paths_, [&](const auto& entry) { return entry.first.publisher == publisher; });
    if (offer.port < least_direct_port)
        offers_.erase(publisher);
    else
        offers_[publisher] = std::move(offer);
}

void DirectPaths::report(ParticipantId receiver, const std::vector<wire::StreamReport>& streams) {
    if (!members_.contains(receiver))
        return;
    std::set<SettingId> reported;
    for (const wire::StreamReport& stream : streams)
        if (stream.direct != SettingId{})
            reported.insert(stream.direct);
    std::set<SettingId>& before = reports_[receiver];
    has_changed_ = has_changed_ || before != reported;
    before = std::move(reported);
}

bool DirectPaths::may_use(ParticipantId publisher, const StreamUse::Receiver& receiver) const {
    return receiver.may_be_direct && members_.contains(receiver.id) &&
           offers_.contains(publisher) && receiver.id != publisher &&
           !held_back_.contains(publisher) && !held_back_.contains(receiver.id);
}

// The first receivers of a publisher, and the first publishers of a receiver, as far as the limits
// of the messages allow. Paths that there are come first, so that none is lost to a newcomer.
DirectPaths::Wanted DirectPaths::wanted_paths(const std::vector<StreamUse>& uses) const {
    Wanted wanted;
    std::map<ParticipantId, std::size_t> of_publisher, of_receiver;
    for (const bool is_known : {true, false})
        for (const StreamUse& use : uses)
            for (const StreamUse::Receiver& receiver : use.receivers) {
                const PathId id{use.publisher, receiver.id};
                if (!may_use(use.publisher, receiver) || paths_.contains(id) != is_known)
                    continue;
                if (!wanted.contains(id)) {
                    if (of_publisher[id.publisher] == wire::max_direct_receivers ||
                        of_receiver[id.receiver] == wire::max_direct_grants)
                        continue;
                    ++of_publisher[id.publisher];
                    ++of_receiver[id.receiver];
                }
                if (wanted[id].size() < wire::max_encodings)
                    wanted[id].insert(use.setting);
            }
    return wanted;
}

void DirectPaths::follow(const Wanted& wanted) {
    std::erase_if(paths_, [&](const auto& entry) { return !wanted.contains(entry.first); });
    for (const auto& [id, settings] : wanted) {
        Path& path = paths_[id];
        if (path.secret.empty())
            path.secret = make_secret_();
        path.settings = settings;
        path.reported.clear();
        if (const auto report = reports_.find(id.receiver); report != reports_.end())
            std::set_intersection(settings.begin(), settings.end(), report->second.begin(),
                                  report->second.end(),
                                  std::inserter(path.reported, path.reported.end()));
    }
}

std::vector<KeyRequests::Key> DirectPaths::follow(const std::vector<StreamUse>& uses) {
    follow(wanted_paths(uses));
    const auto before = std::exchange(direct_, {});
    for (const auto& [id, path] : paths_)
        for (const SettingId setting : path.reported)
            direct_.insert({id.receiver, setting});
    std::vector<KeyRequests::Key> keys;
    std::set<std::pair<ParticipantId, SettingId>> received;
    for (const StreamUse& use : uses)
        for (const StreamUse::Receiver& receiver : use.receivers) {
            const std::pair entry{receiver.id, use.setting};
            received.insert(entry);
            if (!before.contains(entry) || direct_.contains(entry))
                continue;
            needs_key_.insert(entry);
            keys.push_back({use.stream, use.setting});
        }
    std::erase_if(needs_key_, [&](const auto& entry) {
        return !received.contains(entry) || direct_.contains(entry);
    });
    tell(told_publishers_, to_publishers(uses));
    tell(told_receivers_, to_receivers());
    return keys;
}

std::map<ParticipantId, wire::DirectReceivers> DirectPaths::to_publishers(
    const std::vector<StreamUse>& uses) const {
    std::map<ParticipantId, wire::DirectReceivers> messages;
    for (const auto& [publisher, offer] : offers_)
        messages[publisher];
    for (const auto& [id, path] : paths_)
        messages[id.publisher].receivers.push_back(
            {path.secret, {path.settings.begin(), path.settings.end()}});
    for (const StreamUse& use : uses) {
        const bool needs_host =
            use.is_kept || use.receivers.empty() || !offers_.contains(use.publisher) ||
            std::any_of(use.receivers.begin(), use.receivers.end(), [&](const auto& receiver) {
                return !direct_.contains({receiver.id, use.setting});
            });
        if (!needs_host && messages[use.publisher].not_to_host.size() < wire::max_encodings)
            messages[use.publisher].not_to_host.push_back(use.setting);
    }
    return messages;
}

std::map<ParticipantId, wire::DirectGrants> DirectPaths::to_receivers() const {
    std::map<ParticipantId, wire::DirectGrants> messages;
    for (const auto& [id, path] : paths_) {
        const wire::OfferDirect& offer = offers_.at(id.publisher);
        messages[id.receiver].grants.push_back(
            {id.publisher, addresses_for(id), offer.port, offer.fingerprint, path.secret});
    }
    return messages;
}

std::vector<std::string> DirectPaths::addresses_for(const PathId& path) const {
    const auto seen_at = [&](ParticipantId participant) {
        const auto found = addresses_.find(participant);
        return found == addresses_.end() ? std::string() : found->second;
    };
    return direct_addresses(seen_at(path.publisher), offers_.at(path.publisher).addresses,
                            seen_at(path.receiver));
}

// Sends what has changed. A participant without a message is told that there is nothing.
template <class Message>
void DirectPaths::tell(std::map<ParticipantId, Message>& told,
                       std::map<ParticipantId, Message> now) {
    for (const auto& [participant, before] : told)
        if (before != Message{})
            now.try_emplace(participant);
    for (const auto& [participant, message] : now) {
        const auto before = told.find(participant);
        if (before == told.end() ? message != Message{} : before->second != message)
            actions_.push_back(action::Send{participant, message});
    }
    told = std::move(now);
}

void DirectPaths::tell_again(ParticipantId participant) {
    if (const auto told = told_publishers_.find(participant); told != told_publishers_.end())
        actions_.push_back(action::Send{participant, told->second});
    if (const auto told = told_receivers_.find(participant); told != told_receivers_.end())
        actions_.push_back(action::Send{participant, told->second});
}

bool DirectPaths::is_relayed(ParticipantId receiver, const wire::MediaHeader& header) {
    const std::pair entry{receiver, header.setting};
    if (direct_.contains(entry))
        return false;
    if (!header.key && needs_key_.contains(entry))
        return false;
    needs_key_.erase(entry);
    return true;
}

bool DirectPaths::is_direct(ParticipantId receiver, SettingId setting) const {
    return direct_.contains({receiver, setting});
}

}  // namespace theatron::session
