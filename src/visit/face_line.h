// SPDX-License-Identifier: Apache-2.0
// The expression of a person's face, sent into a session: from a tracker's packets, from the
// scripted actor, or from the person's voice alone. A mouth that no tracker sees is guessed from
// the voice, and the others are told so.
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
#include "face/voice_mouth.h"
#include "visit/tracked_face.h"

namespace theatron::visit {

// The part of a face that the others get, without its time. Anger that is not told (face::decide)
// counts as neutral.
wire::FaceExpression expression_of(const face::FaceNow& face, const face::EmotionNow& told,
                                   bool all_channels, bool mouth_guessed = false);

class FaceLine {
public:
    // At 15 a second an expression takes at most 4 kbit/s.
    static constexpr Duration period = std::chrono::microseconds(66'667);

    struct Options {
        // "actor", "voice", or the UDP port of this machine where packets arrive
        std::string source;
        std::string model;  // a file of `theatron face train`; empty: a network learns at first
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
    // How loud the person's voice is for the others, decibels below full scale; nullopt: nobody
    // hears it. From any thread, many times a second.
    void hear(std::optional<int> level_db) { level_db_ = level_db.value_or(no_voice); }

    // {"state": "off", "learning", "waiting", "tracked", "relaxing" or "lost", "emotion": as told,
    // "mouth": "seen", "guessed" or "unseen"}; where there is an own face also {"own": "off",
    // "sending", "there", "refused" or "unanswered"}.
    nlohmann::json json() const;

private:
    enum class From { tracker, actor, voice };
    static constexpr int no_voice = -1000;

    // False: stopped before the network had learned.
    bool learn(const std::stop_token& stop);
    void send(client::Participant& participant, const std::stop_token& stop);
    face::FaceNow next(TimePoint end);
    // The jaw of a face whose mouth no tracker sees. True: it is guessed.
    bool guess_mouth(face::FaceNow& face, TimePoint now);
    void note(const std::string& state, const std::string& emotion, const std::string& mouth);

    void follow_own_face(client::Participant& participant, bool shown);

    const From from_;
    const bool all_channels_;
    const std::shared_ptr<const Bytes> own_face_;
    session::FaceUpload::State told_ = session::FaceUpload::State::none;  // of own_face_
    std::string said_;  // of it, the last sentence
    std::optional<face::Network> network_;
    std::unique_ptr<TrackedFace> tracked_;  // of a tracker
    TimePoint began_;                       // of the actor's script
    face::VoiceMouth mouth_;
    std::atomic<bool> shown_ = true;
    std::atomic<int> level_db_ = no_voice;

    mutable std::mutex mutex_;
    std::string state_ = "off", emotion_, mouth_state_ = "unseen",
                own_state_ = "off";  // for json()
};

}  // namespace theatron::visit
