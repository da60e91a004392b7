// SPDX-License-Identifier: Apache-2.0
// The participants of a session: admission by tokens, which have a role and may expire; their
// names, roles, features and request budgets.
//
// A pure state machine; time is passed in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/admission_memory.h"
#include "session/permissions.h"
#include "session/request_budget.h"
#include "wire/control.h"

namespace theatron::session {

bool asks_for(const wire::Join& hello, wire::Feature feature);

class Admission {
public:
    // Admits its bearer in this role, until it expires.
    struct Token {
        std::string secret;
        Role role = Role::expert;
        std::optional<TimePoint> expires;
        std::string link;  // a name for it that is not secret
        // The same as seconds since 1970 in UTC, by a clock that may be corrected meanwhile.
        std::optional<std::int64_t> expires_utc;
        bool has_expired(TimePoint now, std::int64_t utc) const {
            return (expires && now >= *expires) || (expires_utc && utc >= *expires_utc);
        }
        bool operator==(const Token&) const = default;
    };
    struct Config {
        std::vector<Token> tokens;
        // Experts and observers wait until an operator admits them.
        bool asks = false;
        // Compares secrets in constant time; given, because this module has no crypto.
        std::function<bool(std::string_view, std::string_view)> equal_secrets;
        // Seconds since 1970, asked at each use of a token with an end in UTC.
        std::function<std::int64_t()> utc_now;
    };

    // Connections that have not joined within this time are closed.
    static constexpr Duration join_deadline = std::chrono::seconds(5);
    // Recorders at once; one more is refused. Each may use net::Outbox::max_kept_bytes. Those that
    // come back find places of their own, should others have taken theirs; of those, too, the ones
    // that recorded for the shortest time make way.
    static constexpr int max_recorders = 4, kept_for_returned_recorders = 4;
    // Participants at once, with those who wait to be let in. The last places are for operators,
    // and one link admits no more than half of all, so that a link in foreign hands shuts out
    // nobody who has another one. Somebody who comes back takes the place of the one who was in for
    // the shortest time, if that is shorter than its own: a short visit earns no place.
    static constexpr int max_participants = 128, kept_for_operators = 8, max_by_one_link = 64;
    // Connections of one person. One more ends the oldest that neither records nor sends cameras.
    static constexpr int max_of_one_person = 4;
    // A program that takes part says something many times in this time.
    static constexpr Duration silent_after = std::chrono::seconds(3);
    // Half of those who wait may have come by one link.
    static constexpr int max_visitors_by_one_link = wire::max_visitors / 2;

    struct Participant {
        // `streams`: number of streams in the session.
        explicit Participant(std::size_t streams) : budget(streams) {}

        bool joined = false;
        bool closing = false;
        bool takes_part() const { return joined && !closing; }
        bool waits() const { return asked && !closing; }
        bool may(Right right) const {
            return takes_part() && session::may(role, right) &&
                   !(muted && (right == Right::speak || right == Right::write));
        }
        bool has(wire::Feature feature) const;
        bool is_there() const { return takes_part() || waits(); }
        TimePoint connected;
        // `now` less the time for which it has taken part or waited, over all of its connections.
        TimePoint since;
        TimePoint heard;                    // its newest message
        std::optional<TimePoint> admitted;  // by an operator, perhaps on an earlier connection
        std::uint16_t protocol = 0;
        std::string name;                     // as shown, told apart from others
        std::string given_name;               // as the person gave it
        Bytes person;                         // as in wire::Join
        std::uint64_t run = 0;                // as in wire::Join
        std::vector<wire::Feature> features;  // those of Join that hold here
        Role of_link = Role::expert, role = Role::expert;
        bool muted = false;
        bool voice_recorded = false;  // it agrees that others record its voice
        bool hand_raised = false;
        std::string link, token;             // by which it came
        std::optional<wire::Join> asked;     // while it waits for admission
        bool asks_to_publish = false;        // as in wire::Join
        std::uint64_t denied = 0;            // messages that its role does not allow
        std::uint64_t refused_pictures = 0;  // beyond own_pictures.h
        bool records = false;                // as in wire::Join
        bool sends_only = false;             // as wire::Feature::sends_only
        bool refused_for_good = false;       // see wire::is_for_good()
        // The newest message about the patient; nullopt: it may be lost.
        std::optional<wire::Patient> patient = wire::Patient{};
        // The newest message about cases, see OfferedCases; nullopt: it may be lost.
        static constexpr std::pair<bool, std::uint64_t> no_cases{};
        std::optional<std::pair<bool, std::uint64_t>> cases = no_cases;
        std::size_t max_media = 0;               // bytes of its largest media message so far
        std::vector<wire::StreamReport> report;  // the newest
        std::string renderer;                    // as it reports it; may be empty
        TimePoint renderer_noted;                // time of the last accepted report
        RequestBudget budget;
        // The newest requests that came too often; each is carried out as soon as the budget
        // allows. Codecs: one request for each camera, and one for all.
        std::map<std::optional<CameraId>, wire::ChooseCodecs> late_codecs;
        std::optional<wire::ChooseDelivery> late_goal;
    };

    explicit Admission(Config config)
        : tokens_(std::move(config.tokens)),
          equal_secrets_(std::move(config.equal_secrets)),
          utc_now_(std::move(config.utc_now)) {}

    // Other tokens are valid from now on.
    void set_tokens(std::vector<Token> tokens) { tokens_ = std::move(tokens); }
    const std::vector<Token>& tokens() const { return tokens_; }
    void revoke(const std::string& link) {
        std::erase_if(tokens_, [&](const Token& token) { return token.link == link; });
    }
    // False if the participant's token is no longer valid.
    bool knows(const Participant& participant) const;

    void on_connected(ParticipantId id, std::size_t streams, TimePoint now);
    // Null if there is none of this number.
    Participant* find(ParticipantId id);
    const std::map<ParticipantId, Participant>& participants() const { return participants_; }
    std::map<ParticipantId, Participant>& participants() { return participants_; }
    void remove(ParticipantId id) { participants_.erase(id); }

    // A connection that ends for one that comes. `told`: why; empty: it has lost its host without
    // noticing, and may come back.
    struct Replaced {
        ParticipantId id{};
        wire::Text told;
    };
    // The answer to Join: the role, or why the connection is refused.
    struct Verdict {
        Role role = Role::expert;
        std::string link;
        wire::Text refusal;  // empty: the token is valid
        std::vector<Replaced> replaced = {};
        std::optional<TimePoint> since = {};  // it comes back: as Participant::since
    };
    // A new connection of the same run of a program replaces the old one. That of another run of
    // its person for the same purpose is replaced if it is silent. Decisions at joining (expiry,
    // places) hold for somebody while it is there, and for AdmissionMemory::kept_for.
    Verdict judge(const wire::Join& hello, TimePoint now) const;
    // Adds to the verdict for somebody who has to wait: nobody more can, or nobody more by this
    // link.
    void find_door_place(const wire::Join& hello, Verdict& verdict) const;
    // True for somebody who is there, or was there a short while ago, by the same link and for the
    // same purpose.
    bool knows_again(const wire::Join& hello, TimePoint now) const;
    // The participant's connection has ended, and it may come back.
    void remember(const Participant& participant);
    void forget_those_who_left() { memory_.forget_all(); }
    // Notes what the participant says of itself.
    void note(Participant& participant, const wire::Join& hello, const Verdict& verdict) const;
    // Marks the participant as joined, in its role.
    static void admit(Participant& participant, const wire::Join& hello);
    // The features of Join that hold for a role.
    static std::vector<wire::Feature> features_of(const wire::Join& hello, Role role);

    // Keeps a request that came too often: the last one of its kind. Requests that participants
    // repeat by themselves are dropped.
    static void keep_for_later(Participant& participant, wire::ToHost message);

private:
    // The names of those whom the others see beside this participant: not of the same person, whose
    // earlier connection may still be there.
    std::vector<std::string> names_beside(const Participant& participant) const;
    // The connections of this person that are there, the oldest first.
    std::vector<ParticipantId> connections_of(const Bytes& person) const;
    // Each finds those who make way, or the reason why there is no place.
    void replace_own(const wire::Join& hello, TimePoint now, Verdict& verdict) const;
    void find_recorder_place(const wire::Join& hello, TimePoint now, Verdict& verdict) const;
    void find_place(const wire::Join& hello, Verdict& verdict) const;
    // The participant that `may_go`, manages nothing and was in for the shortest time makes way for
    // somebody who comes back and was in for longer. Otherwise the refusal is `full`.
    void give_place(const std::function<bool(const Participant&)>& may_go, wire::Text full,
                    Verdict& verdict) const;

    std::vector<Token> tokens_;
    const std::function<bool(std::string_view, std::string_view)> equal_secrets_;
    const std::function<std::int64_t()> utc_now_;
    std::map<ParticipantId, Participant> participants_;
    AdmissionMemory memory_;
};

}  // namespace theatron::session
