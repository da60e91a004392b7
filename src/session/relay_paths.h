// SPDX-License-Identifier: Apache-2.0
// Chooses the pictures that a receiver gets from a relay, and not from the host
// (docs/decisions/relays.md).
//
// A receiver gets the relay that is for its network and has the fewest receivers. Both are told the
// same random secret. The receiver reports the settings whose frames come from the relay; the host
// sends it the frames of all others. The frames that a relay sends follow the tables of the
// streams: whoever is no longer in them loses its relay in the same step.
//
// A pure state machine; it appends its messages to the list given to the constructor.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "session/host_actions.h"
#include "session/ipv4_network.h"
#include "session/key_requests.h"
#include "session/streams.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class RelayPaths {
public:
    // wire::relay_secret_size random bytes.
    using MakeSecret = std::function<Bytes()>;
    // With the key of this number the pictures for relays are sealed.
    struct Key {
        std::uint32_t number = 0;
        Bytes bytes;
    };

    // The host waits for the first frame that a receiver gets from its relay, before it sends its
    // own.
    static constexpr Duration arrival_patience = std::chrono::seconds(1);
    // A receiver to which nothing comes from its relay for this time, while the relay is sent
    // frames for it, gets another relay; and it does not get the same one again for some time.
    static constexpr Duration relay_patience = std::chrono::seconds(5),
                              avoided_for = std::chrono::seconds(60);
    // Between two key frames of a stream that relays and their receivers ask for.
    static constexpr Duration key_interval = std::chrono::seconds(2);
    // Receivers know a new key for this time before the first picture that is sealed with it.
    static constexpr Duration key_told_before = std::chrono::seconds(1);

    // An empty `make_secret`: there are no relays. `actions` must outlive the paths.
    RelayPaths(MakeSecret make_secret, std::vector<Action>& actions);

    bool is_possible() const { return bool(make_secret_); }

    // The host sees this participant at this address. Called before join().
    void set_address(ParticipantId participant, std::string address);
    // The participant takes part, its program takes pictures from relays, and it does not record.
    void join(ParticipantId receiver, TimePoint now);
    // A receiver or a relay.
    void leave(ParticipantId participant);
    // False: the receiver gets nothing from a relay.
    void allow(ParticipantId receiver, bool allowed);
    // The participant, a relay, listens. Port 0 withdraws the offer.
    void offer(ParticipantId relay, wire::OfferRelay offer);
    // The settings whose frames this receiver gets from its relay.
    void report(ParticipantId receiver, const std::vector<wire::StreamReport>& streams,
                TimePoint now);
    // Somebody who had the key may no longer see the session.
    void renew_key();

    // Brings paths and messages in line with the streams and the reports. Returns the streams that
    // need a key frame, because the host sends them to somebody again.
    std::vector<KeyRequests::Key> follow(const std::vector<StreamUse>& uses, TimePoint now);
    // False while there was no relay: follow() has nothing to do.
    bool is_used() const { return !offers_.empty() || !told_receivers_.empty(); }
    // True once after a change here, after which follow() is to be called.
    bool take_change() { return std::exchange(has_changed_, false); }
    void on_tick(TimePoint now);
    // Messages to this participant were dropped: sends it the current state.
    void tell_again(ParticipantId participant);

    // The host is to send this frame to this receiver itself. After frames from a relay that is so
    // from a key frame on.
    bool goes_by_host(ParticipantId receiver, const wire::MediaHeader& header);
    // The relays that are sent this frame, which is of this layer for their receivers.
    std::vector<ParticipantId> relays_of(const wire::MediaHeader& header, int layer, TimePoint now);
    const Key& key(TimePoint now) const { return now < key_since_ ? key_before_ : key_; }

    // Frames of this setting come to the receiver from its relay.
    bool is_by_relay(ParticipantId receiver, SettingId setting) const;
    // The receiver gets its frames from a relay, or is waited for to get the first ones.
    bool is_reached(ParticipantId receiver) const;
    // Empty: it has none.
    std::optional<ParticipantId> relay_of(ParticipantId receiver) const;
    bool is_relay(ParticipantId participant) const { return offers_.contains(participant); }
    // True if a key frame of this stream may be asked for in the name of a relay, which then counts
    // as asked for.
    bool may_request_key(StreamId stream, SettingId setting, TimePoint now);

private:
    struct Offer {
        wire::OfferRelay offer;
        std::vector<Ipv4Network> networks;
    };
    struct Setting {
        int layer = 0;  // the highest that the receiver gets
        TimePoint expected_until;
    };
    struct Receiver {
        std::optional<ParticipantId> relay;
        Bytes secret;
        TimePoint chosen, reached;  // the relay was chosen; it reported something
        bool is_first = true;       // relay of this receiver
        bool is_held_back = false;
        std::set<SettingId> reported;
        std::map<SettingId, Setting> settings;       // that it wants, of all cameras
        std::map<ParticipantId, TimePoint> avoided;  // relays, and until when
        std::uint32_t max_kbit_per_s = 0;
    };

    bool is_for(const Offer& relay, ParticipantId receiver) const;
    void choose(ParticipantId id, Receiver& receiver, TimePoint now);
    void want(const std::vector<StreamUse>& uses, TimePoint now);
    void follow_key(TimePoint now);
    bool is_covered(const Receiver& receiver, SettingId setting) const;
    std::map<ParticipantId, wire::RelayReceivers> to_relays() const;
    std::map<ParticipantId, wire::RelayGrants> to_receivers() const;
    template <class Message>
    void tell(std::map<ParticipantId, Message>& told, std::map<ParticipantId, Message> now);

    const MakeSecret make_secret_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, std::string> addresses_;
    std::map<ParticipantId, Offer> offers_;
    std::map<ParticipantId, Receiver> receivers_;
    bool has_changed_ = false;
    TimePoint now_;                                            // at the last follow() or on_tick()
    std::set<std::pair<ParticipantId, SettingId>> covered_;    // at the last follow()
    std::set<std::pair<ParticipantId, SettingId>> needs_key_;  // before the host sends again
    std::map<SettingId, std::map<ParticipantId, int>> feeds_;  // the highest layer of each relay
    std::map<SettingId, TimePoint> fed_;                       // the newest frame
    std::map<KeyRequests::Key, TimePoint> keys_asked_;
    Key key_, key_before_;
    TimePoint key_since_;  // of key_
    bool needs_new_key_ = false;
    std::map<ParticipantId, wire::RelayReceivers> told_relays_;
    std::map<ParticipantId, wire::RelayGrants> told_receivers_;
};

}  // namespace theatron::session
