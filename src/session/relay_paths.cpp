// SPDX-License-Identifier: Apache-2.0
#include "session/relay_paths.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

RelayPaths::RelayPaths(MakeSecret make_secret, std::vector<Action>& actions)
    : make_secret_(std::move(make_secret)), actions_(actions) {
    if (make_secret_)
        key_ = key_before_ = {1, make_secret_()};
}

void RelayPaths::set_address(ParticipantId participant, std::string address) {
    addresses_[participant] = std::move(address);
}

void RelayPaths::join(ParticipantId id, TimePoint now) {
    has_changed_ = true;
    Receiver& receiver = receivers_[id];
    choose(id, receiver, now);
    // One that has come by the host's pictures already does not wait for those of a relay.
    receiver.is_first = receiver.relay.has_value();
}

void RelayPaths::leave(ParticipantId participant) {
    has_changed_ = true;
    addresses_.erase(participant);
    receivers_.erase(participant);
    told_relays_.erase(participant);
    told_receivers_.erase(participant);
    std::erase_if(covered_, [&](const auto& entry) { return entry.first == participant; });
    std::erase_if(needs_key_, [&](const auto& entry) { return entry.first == participant; });
    if (offers_.erase(participant) == 0)
        return;
    for (auto& [id, receiver] : receivers_) {
        receiver.avoided.erase(participant);
        if (receiver.relay == participant)
            receiver.relay.reset();
    }
}

void RelayPaths::allow(ParticipantId id, bool allowed) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    has_changed_ = true;
    found->second.is_held_back = !allowed;
}

void RelayPaths::offer(ParticipantId relay, wire::OfferRelay offer) {
    if (!is_possible())
        return;
    has_changed_ = true;
    // Another listener: no secret of the one before is shown to it.
    for (auto& [id, receiver] : receivers_)
        if (receiver.relay == relay)
            receiver.relay.reset();
    Offer taken;
    for (const std::string& text : offer.networks)
        if (const auto network = parse_ipv4_network(text))
            taken.networks.push_back(*network);
    // Networks that this host cannot read are not all networks.
    if (offer.port == 0 || offer.addresses.empty() ||
        taken.networks.size() != offer.networks.size()) {
        offers_.erase(relay);
        return;
    }
    taken.offer = std::move(offer);
    offers_[relay] = std::move(taken);
}

void RelayPaths::report(ParticipantId id, const std::vector<wire::StreamReport>& streams,
                        TimePoint now) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    std::set<SettingId> reported;
    for (const wire::StreamReport& stream : streams)
        if (stream.relayed != SettingId{})
            reported.insert(stream.relayed);
    Receiver& receiver = found->second;
    if (!reported.empty())
        receiver.reached = now;
    has_changed_ = has_changed_ || receiver.reported != reported;
    receiver.reported = std::move(reported);
}

void RelayPaths::renew_key() {
    has_changed_ = has_changed_ || !offers_.empty();
    needs_new_key_ = !offers_.empty();
}

// One that is told, and not yet used, is used first.
void RelayPaths::follow_key(TimePoint now) {
    if (!needs_new_key_ || now < key_since_)
        return;
    needs_new_key_ = false;
    key_before_ = std::exchange(key_, {key_.number + 1, make_secret_()});
    key_since_ = now + key_told_before;
}

bool RelayPaths::is_for(const Offer& relay, ParticipantId receiver) const {
    if (relay.networks.empty())
        return true;
    const auto found = addresses_.find(receiver);
    const auto address = found == addresses_.end() ? std::nullopt : parse_ipv4(found->second);
    return address &&
           std::any_of(relay.networks.begin(), relay.networks.end(),
                       [&](const Ipv4Network& network) { return network.contains(*address); });
}

// Relays for certain networks come before those for all; among equals the one with the fewest
// receivers.
void RelayPaths::choose(ParticipantId id, Receiver& receiver, TimePoint now) {
    std::erase_if(receiver.avoided, [&](const auto& entry) { return entry.second <= now; });
    const bool keeps = receiver.relay && !receiver.is_held_back &&
                       offers_.contains(*receiver.relay) &&
                       !receiver.avoided.contains(*receiver.relay);
    if (keeps)
        return;
    receiver.is_first = receiver.is_first && receiver.secret.empty();
    receiver.relay.reset();
    receiver.reported.clear();
    receiver.secret.clear();
    for (auto& [setting, wanted] : receiver.settings)
        wanted.expected_until = {};
    if (receiver.is_held_back)
        return;
    std::map<ParticipantId, std::size_t> loads;
    for (const auto& [other, known] : receivers_)
        if (known.relay)
            ++loads[*known.relay];
    std::optional<std::pair<bool, std::size_t>> best;
    for (const auto& [relay, offer] : offers_) {
        if (receiver.avoided.contains(relay) || !is_for(offer, id) ||
            loads[relay] >= wire::max_relay_receivers)
            continue;
        const std::pair rank{offer.networks.empty(), loads[relay]};
        if (best && *best <= rank)
            continue;
        best = rank;
        receiver.relay = relay;
    }
    if (!receiver.relay)
        return;
    receiver.secret = make_secret_();
    receiver.chosen = now;
}

// Notes the settings that each receiver is to get from its relay.
void RelayPaths::want(const std::vector<StreamUse>& uses, TimePoint now) {
    std::map<ParticipantId, std::map<SettingId, Setting>> wanted;
    for (const StreamUse& use : uses)
        for (const StreamUse::Receiver& use_by : use.receivers) {
            const auto found = receivers_.find(use_by.id);
            if (found == receivers_.end() || !found->second.relay)
                continue;
            Receiver& receiver = found->second;
            receiver.max_kbit_per_s = use_by.max_kbit_per_s;
            std::map<SettingId, Setting>& settings = wanted[use_by.id];
            if (settings.size() >= wire::max_relay_settings)
                continue;
            const auto before = receiver.settings.find(use.setting);
            Setting setting{use_by.highest_layer, {}};
            if (before != receiver.settings.end())
                setting.expected_until = before->second.expected_until;
            else if (receiver.is_first || !receiver.reported.empty())
                setting.expected_until = now + arrival_patience;
            settings[use.setting] = setting;
        }
    for (auto& [id, receiver] : receivers_)
        receiver.settings = std::move(wanted[id]);
}

bool RelayPaths::is_covered(const Receiver& receiver, SettingId setting) const {
    const auto wanted = receiver.settings.find(setting);
    return receiver.relay && wanted != receiver.settings.end() &&
           (receiver.reported.contains(setting) || now_ < wanted->second.expected_until);
}

std::vector<KeyRequests::Key> RelayPaths::follow(const std::vector<StreamUse>& uses,
                                                 TimePoint now) {
    now_ = now;
    follow_key(now);
    for (auto& [id, receiver] : receivers_)
        choose(id, receiver, now);
    want(uses, now);
    feeds_.clear();
    const auto before = std::exchange(covered_, {});
    for (const auto& [id, receiver] : receivers_)
        for (const auto& [setting, wanted] : receiver.settings) {
            int& layer = feeds_[setting].try_emplace(*receiver.relay, wanted.layer).first->second;
            layer = std::max(layer, wanted.layer);
            if (is_covered(receiver, setting))
                covered_.insert({id, setting});
        }
    std::erase_if(fed_, [&](const auto& entry) { return !feeds_.contains(entry.first); });
    std::vector<KeyRequests::Key> keys;
    std::set<std::pair<ParticipantId, SettingId>> received;
    for (const StreamUse& use : uses)
        for (const StreamUse::Receiver& receiver : use.receivers) {
            const std::pair entry{receiver.id, use.setting};
            received.insert(entry);
            if (!before.contains(entry) || covered_.contains(entry))
                continue;
            needs_key_.insert(entry);
            keys.push_back({use.stream, use.setting});
        }
    std::erase_if(needs_key_, [&](const auto& entry) {
        return !received.contains(entry) || covered_.contains(entry);
    });
    tell(told_relays_, to_relays());
    tell(told_receivers_, to_receivers());
    return keys;
}

void RelayPaths::on_tick(TimePoint now) {
    has_changed_ = has_changed_ || needs_new_key_;
    for (auto& [id, receiver] : receivers_) {
        for (const auto& [relay, until] : receiver.avoided)
            has_changed_ = has_changed_ || (now_ < until && until <= now);
        if (!receiver.relay)
            continue;
        bool is_fed = false;
        for (const auto& [setting, wanted] : receiver.settings) {
            has_changed_ =
                has_changed_ || (now_ < wanted.expected_until && wanted.expected_until <= now);
            const auto fed = fed_.find(setting);
            is_fed = is_fed || (fed != fed_.end() && now - fed->second < arrival_patience);
        }
        if (!is_fed || now - std::max(receiver.chosen, receiver.reached) < relay_patience)
            continue;
        receiver.avoided[*receiver.relay] = now + avoided_for;
        has_changed_ = true;
    }
    now_ = now;
}

std::map<ParticipantId, wire::RelayReceivers> RelayPaths::to_relays() const {
    std::map<ParticipantId, wire::RelayReceivers> messages;
    for (const auto& [relay, offer] : offers_)
        messages[relay];
    for (const auto& [id, receiver] : receivers_) {
        if (!receiver.relay)
            continue;
        wire::RelayReceiver named{receiver.secret, {}, id, {}, receiver.max_kbit_per_s};
        for (const auto& [setting, wanted] : receiver.settings) {
            named.settings.push_back(setting);
            named.layers.push_back(std::byte(wanted.layer));
        }
        messages[*receiver.relay].receivers.push_back(std::move(named));
    }
    return messages;
}

std::map<ParticipantId, wire::RelayGrants> RelayPaths::to_receivers() const {
    std::map<ParticipantId, wire::RelayGrants> messages;
    for (const auto& [id, receiver] : receivers_) {
        if (!receiver.relay)
            continue;
        const wire::OfferRelay& offer = offers_.at(*receiver.relay).offer;
        messages[id].grants.push_back({*receiver.relay, offer.addresses, offer.port,
                                       offer.fingerprint, receiver.secret, key_.number,
                                       key_.bytes});
    }
    return messages;
}

// Sends what has changed. A participant without a message is told that there is nothing.
template <class Message>
void RelayPaths::tell(std::map<ParticipantId, Message>& told,
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

void RelayPaths::tell_again(ParticipantId participant) {
    if (const auto told = told_relays_.find(participant); told != told_relays_.end())
        actions_.push_back(action::Send{participant, told->second});
    if (const auto told = told_receivers_.find(participant); told != told_receivers_.end())
        actions_.push_back(action::Send{participant, told->second});
}

bool RelayPaths::goes_by_host(ParticipantId receiver, const wire::MediaHeader& header) {
    const std::pair entry{receiver, header.setting};
    if (covered_.contains(entry))
        return false;
    if (!header.key && needs_key_.contains(entry))
        return false;
    needs_key_.erase(entry);
    return true;
}

std::vector<ParticipantId> RelayPaths::relays_of(const wire::MediaHeader& header, int layer,
                                                 TimePoint now) {
    std::vector<ParticipantId> relays;
    const auto found = feeds_.find(header.setting);
    if (found == feeds_.end())
        return relays;
    fed_[header.setting] = now;
    for (const auto& [relay, highest] : found->second)
        if (layer <= highest)
            relays.push_back(relay);
    return relays;
}

bool RelayPaths::is_by_relay(ParticipantId id, SettingId setting) const {
    const auto found = receivers_.find(id);
    return found != receivers_.end() && found->second.relay &&
           found->second.reported.contains(setting) && found->second.settings.contains(setting);
}

bool RelayPaths::is_reached(ParticipantId id) const {
    const auto found = receivers_.find(id);
    if (found == receivers_.end() || !found->second.relay)
        return false;
    const Receiver& receiver = found->second;
    return !receiver.reported.empty() ||
           (receiver.is_first && now_ < receiver.chosen + arrival_patience);
}

std::optional<ParticipantId> RelayPaths::relay_of(ParticipantId id) const {
    const auto found = receivers_.find(id);
    return found == receivers_.end() ? std::nullopt : found->second.relay;
}

bool RelayPaths::may_request_key(StreamId stream, SettingId setting, TimePoint now) {
    std::erase_if(keys_asked_,
                  [&](const auto& entry) { return now - entry.second >= key_interval; });
    return keys_asked_.try_emplace({stream, setting}, now).second;
}

}  // namespace theatron::session
