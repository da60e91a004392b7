// SPDX-License-Identifier: Apache-2.0
// The expression of a person's face, sent into a session: from a tracker's packets, or from the
// scripted actor where there is no tracker.
//
// Only the emotions that the network tells, the jaw and the lids are sent, unless the person chose
// all channels. Values of a face are neither printed nor logged.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <thread>

#include "client/participant.h"
#include "face/emotion_reader.h"
#include "visit/tracked_face.h"

namespace theatron::visit {

// The part of a face that the others get, without its time. Anger that is not told (face::decide)
// counts as neutral.
wire::FaceExpression expression_of(const face::FaceNow& face, const face::EmotionNow& told,
                                   bool all_channels);

class FaceLine {
public:
    // At 15 a second an expression takes at most 4 kbit/s.
    static constexpr Duration period = std::chrono::microseconds(66'667);

    struct Options {
        std::string source;  // "actor", or the UDP port of this machine where packets arrive
        std::string model;   // a file of `theatron face train`; empty: a network learns at first
        bool all_channels = false;
        // This person's own face (shown_face()), which the others see in place of the usual one;
        // null: none.
        std::shared_ptr<const Bytes> own_face;
    };

    // Opens port and file. Throws Error.
    explicit FaceLine(const Options& options);

    // Sends until this object is destroyed, which must be before the participant is. In a thread of
    // its own, which learns first where no model is given: some seconds.
    class Sending {
    public:
        Sending(FaceLine& line, client::Participant& participant);

    private:
        std::jthread thread_;
    };

    // From any thread. Shown at first; where it is not, nothing is sent.
    void show(bool shown) { shown_ = shown; }

    // {"state": "off", "learning", "waiting", "tracked", "relaxing" or "lost", "emotion": as told};
    // where there is an own face also {"own": "off", "sending", "there", "refused" or
    // "unanswered"}.
    nlohmann::json json() const;

private:
    // False: stopped before the network had learned.
    bool learn(const std::stop_token& stop);
    void send(client::Participant& participant, const std::stop_token& stop);
    face::FaceNow next(TimePoint end);
    void note(const std::string& state, const std::string& emotion);

    void follow_own_face(client::Participant& participant, bool shown);

    const bool all_channels_;
    const std::shared_ptr<const Bytes> own_face_;
    session::FaceUpload::State told_ = session::FaceUpload::State::none;  // of own_face_
    std::string said_;  // of it, the last sentence
    std::optional<face::Network> network_;
    std::unique_ptr<TrackedFace> tracked_;  // null: the actor
    TimePoint began_;                       // of the actor's script
    std::atomic<bool> shown_ = true;

    mutable std::mutex mutex_;
    std::string state_ = "off", emotion_, own_state_ = "off";  // for json()
};

}  // namespace theatron::visit
