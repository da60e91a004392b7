// SPDX-License-Identifier: Apache-2.0
#include "visit/face_line.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stop_token>

#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "face/synthetic_faces.h"
#include "face/training.h"
#include "session/expression_track.h"

namespace theatron::visit {
namespace {

FacePort port_of(const std::string& source) {
    FacePort at;
    const char* const end = source.data() + source.size();
    const auto [rest, problem] = std::from_chars(source.data(), end, at.port);
    if (problem != std::errc() || rest != end || at.port < 1 || at.port > 65535)
        throw Error("'" + source + "' is no UDP port (1 to 65535), and neither actor nor voice.");
    return at;
}

bool can_send(const client::Participant& participant) {
    const auto status = participant.status();
    return status.clock_known && status.phase == client::Participant::Phase::joined;
}

// Its role has not been changed to one whose face nobody sees.
bool may_be_seen(const client::Participant& participant) {
    const auto status = participant.status();
    return status.phase != client::Participant::Phase::joined ||
           session::may(status.standing.role, session::Right::be_seen);
}

// The sentence that tells a person of the change; empty: none.
std::string sentence_of(face::Tracking tracking) {
    switch (tracking) {
        case face::Tracking::tracked:
            return "Your face is tracked; the others see what it shows.";
        case face::Tracking::lost:
            return "The tracker of your face is silent; the others see it at rest.";
        case face::Tracking::waiting:
        case face::Tracking::relaxing:
            break;
    }
    return "";
}

face::EmotionNow at_rest() {
    face::EmotionNow rest;
    rest.weights[std::size_t(face::Emotion::neutral)] = 1;
    rest.told = face::Emotion::neutral;
    return rest;
}

std::string name_of(session::FaceUpload::State state) {
    switch (state) {
        case session::FaceUpload::State::none:
            break;
        case session::FaceUpload::State::sending:
            return "sending";
        case session::FaceUpload::State::there:
            return "there";
        case session::FaceUpload::State::refused:
            return "refused";
        case session::FaceUpload::State::unanswered:
            return "unanswered";
    }
    return "off";
}

std::string sentence_of(session::FaceUpload::State state) {
    switch (state) {
        case session::FaceUpload::State::there:
            return "The host has your own face and gives it to the others; they see it while your "
                   "tracker is heard.";
        case session::FaceUpload::State::refused:
            return "The host takes no face of your own at present, and is asked again; the others "
                   "see the usual head.";
        case session::FaceUpload::State::unanswered:
            return "The host does not know faces of one's own; it is of an earlier version. The "
                   "others see the usual head.";
        case session::FaceUpload::State::none:
        case session::FaceUpload::State::sending:
            break;
    }
    return "";
}

}  // namespace

wire::FaceExpression expression_of(const face::FaceNow& face, const face::EmotionNow& told,
                                   bool all_channels, bool mouth_guessed) {
    wire::FaceExpression sent;
    const bool is_lost = face.tracking == face::Tracking::lost;
    using State = wire::FaceExpression::State;
    sent.state = is_lost ? State::lost : mouth_guessed ? State::voiced : State::tracked;
    sent.emotions = told.weights;
    if (told.told != face::Emotion::anger) {
        float& anger = sent.emotions[std::size_t(face::Emotion::anger)];
        sent.emotions[std::size_t(face::Emotion::neutral)] += anger;
        anger = 0;
    }
    sent.jaw_open = face.values[face::jaw_open];
    sent.blink_left = face.values[face::eye_blink_left];
    sent.blink_right = face.values[face::eye_blink_right];
    if (all_channels)
        sent.channels = face.values;
    return sent;
}

FaceLine::FaceLine(const Options& options)
    : from_(options.source == "actor"   ? From::actor
            : options.source == "voice" ? From::voice
                                        : From::tracker),
      all_channels_(options.all_channels),
      own_face_(options.own_face) {
    if (from_ == From::tracker)
        tracked_ = std::make_unique<TrackedFace>(port_of(options.source));
    if (!options.model.empty())
        network_ = read_face_network(options.model);
}

FaceLine::Sending::Sending(FaceLine& line, client::Participant& participant)
    : thread_([&line, &participant](const std::stop_token& stop) {
          if (!contain("face", [&] { line.send(participant, stop); }))
              line.note("off", "", "unseen");
      }) {}

face::FaceNow FaceLine::next(TimePoint end) {
    if (tracked_)
        return tracked_->next(end);
    std::this_thread::sleep_for(std::max(end - steady_now(), Duration::zero()));
    face::FaceNow face;
    face.tracking = face::Tracking::tracked;
    const double seconds = to_seconds(end - began_);
    if (from_ == From::actor) {
        face.values = face::actor_channels(seconds);
        face.present.set();
    } else {
        face.values[face::eye_blink_left] = face.values[face::eye_blink_right] =
            face::idle_blink(seconds);
    }
    return face;
}

bool FaceLine::guess_mouth(face::FaceNow& face, TimePoint now) {
    const int level_db = level_db_;
    const bool is_seen = face.present[face::jaw_open];
    if (is_seen || level_db == no_voice || face.tracking != face::Tracking::tracked)
        return false;
    face.values[face::jaw_open] = mouth_.put(level_db, now);
    return true;
}

bool FaceLine::learn(const std::stop_token& stop) {
    note("learning", "", "unseen");
    network_ = face::train_synthetic_until(tracked_ ? face::Source::unified : face::Source::arkit,
                                           {}, [&] { return stop.stop_requested(); });
    return network_.has_value();
}

void FaceLine::send(client::Participant& participant, const std::stop_token& stop) {
    if (from_ != From::voice && !network_ && !learn(stop))
        return;
    // A voice tells no emotion.
    std::optional<face::EmotionReader> reader;
    if (from_ != From::voice)
        reader.emplace(*network_);
    TimePoint due = began_ = steady_now(), send_at = due;
    auto tracking = face::Tracking::waiting;
    bool is_calibrated = from_ != From::tracker;  // the others are at rest where channels are 0
    wire::FaceExpression sent;  // the last one; at first as if it said that there is none
    TimePoint sent_at;
    bool could_show = true;
    while (!stop.stop_requested()) {
        due = std::max(due + face_step, steady_now());
        face::FaceNow face = next(due);
        if (!is_calibrated && face.tracking == face::Tracking::tracked) {
            log::say("Rest your face for two seconds: that is what the network compares with.");
            reader->calibrate(due);
            is_calibrated = true;
        }
        const face::EmotionNow told = reader ? reader->put(face, due) : at_rest();
        const bool is_guessed = guess_mouth(face, due);
        if (std::exchange(tracking, face.tracking) != face.tracking)
            if (const std::string sentence = sentence_of(face.tracking);
                tracked_ && !sentence.empty())
                log::say(sentence);
        const bool may_show = may_be_seen(participant);
        if (shown_ && std::exchange(could_show, may_show) && !may_show)
            log::say("Your role lets nobody see your face.");
        const bool shown = shown_ && may_show;
        note(shown ? std::string(to_text(face.tracking)) : "off",
             shown ? std::string(to_text(told.told)) : "",
             is_guessed                     ? "guessed"
             : face.present[face::jaw_open] ? "seen"
                                            : "unseen");
        follow_own_face(participant, shown);
        if (due < send_at || !can_send(participant))
            continue;
        send_at = std::max(send_at + period, due);
        wire::FaceExpression now;  // of state none
        if (shown && face.tracking != face::Tracking::waiting)
            now = expression_of(face, told, all_channels_, is_guessed);
        now.time = sent.time;
        const bool is_same = encode_face_expression(now) == encode_face_expression(sent);
        const bool is_fresh = now.state == wire::FaceExpression::State::none ||
                              due - sent_at < session::ExpressionTrack::repeated_after;
        if (is_same && is_fresh)
            continue;
        sent = now;
        sent.time = participant.now();
        sent_at = due;
        participant.send_expression(sent);
    }
}

void FaceLine::follow_own_face(client::Participant& participant, bool shown) {
    if (!own_face_)
        return;
    participant.show_own_face(shown ? own_face_ : nullptr);
    const session::FaceUpload::State state = participant.own_face_state();
    if (std::exchange(told_, state) == state)
        return;
    // A host that refuses again and again is told once.
    if (const std::string sentence = sentence_of(state); !sentence.empty() && sentence != said_)
        log::say(said_ = sentence);
    const std::lock_guard lock(mutex_);
    own_state_ = name_of(state);
}

void FaceLine::note(const std::string& state, const std::string& emotion,
                    const std::string& mouth) {
    const std::lock_guard lock(mutex_);
    state_ = state;
    emotion_ = emotion;
    mouth_state_ = mouth;
}

nlohmann::json FaceLine::json() const {
    const std::lock_guard lock(mutex_);
    nlohmann::json json{{"state", state_}, {"emotion", emotion_}, {"mouth", mouth_state_}};
    if (own_face_)
        json["own"] = own_state_;
    return json;
}

}  // namespace theatron::visit
