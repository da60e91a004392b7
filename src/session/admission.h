// SPDX-License-Identifier: Apache-2.0
// The participants of a session: admission by tokens, which have a role and may expire; their
// names, features and request budgets.
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
#include "session/request_budget.h"
#include "wire/control.h"

namespace theatron::session {

enum class Role : std::uint8_t {
    viewer,     // receives
    publisher,  // may send cameras, too
};

class Admission {
public:
    // Admits its bearer in this role, until it expires.
    struct Token {
        std::string secret;
        Role role = Role::viewer;
        std::optional<TimePoint> expires;
    };
    struct Config {
        std::vector<Token> tokens;
        // Compares secrets in constant time; given, because this module has no crypto.
        std::function<bool(std::string_view, std::string_view)> equal_secrets;
    };

    // Connections that have not joined within this time are closed.
    static constexpr Duration join_deadline = std::chrono::seconds(5);
    // Recorders at once; one more is refused. Each may use net::Outbox::max_kept_bytes.
    static constexpr int max_recorders = 4;

    struct Participant {
        // `streams`: number of streams in the session.
        explicit Participant(std::size_t streams) : budget(streams) {}

        bool joined = false;
        bool closing = false;
        bool takes_part() const { return joined && !closing; }
        bool has(wire::Feature feature) const;
        TimePoint connected;
        std::uint16_t protocol = 0;
        std::string name;
        Bytes person;                         // as in wire::Join
        std::vector<wire::Feature> features;  // those of Join that hold here
        Role role = Role::viewer;
        bool records = false;                    // as in wire::Join
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

    explicit Admission(Config config) : config_(std::move(config)) {}

    void on_connected(ParticipantId id, std::size_t streams, TimePoint now);
    // Null if there is none of this number.
    Participant* find(ParticipantId id);
    const std::map<ParticipantId, Participant>& participants() const { return participants_; }
    std::map<ParticipantId, Participant>& participants() { return participants_; }
    void remove(ParticipantId id) { participants_.erase(id); }

    // The answer to Join: the role, or why the connection is refused.
    struct Verdict {
        Role role = Role::viewer;
        wire::Text refusal;  // empty: welcome
    };
    Verdict judge(const wire::Join& hello, TimePoint now) const;
    // Marks the participant as joined, in this role.
    void admit(Participant& participant, const wire::Join& hello, Role role);

    // Keeps a request that came too often: the last one of its kind. Requests that participants
    // repeat by themselves are dropped.
    static void keep_for_later(Participant& participant, wire::ToHost message);

private:
    const Config config_;
    std::map<ParticipantId, Participant> participants_;
};

}  // namespace theatron::session
