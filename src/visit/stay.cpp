// SPDX-License-Identifier: Apache-2.0
#include "visit/stay.h"

#include <utility>

#include "phrases/phrase.h"
#include "session/permissions.h"

namespace theatron::visit {
namespace {

using Phase = client::Participant::Phase;

}  // namespace

void KeptSettings::change(const client::Settings& settings) {
    if (settings == now)
        return;
    now = settings;
    if (keep)
        keep(now);
}

client::Participant::Options Stay::with(client::Participant::Options join, const Ports& ports) {
    if (ports.voice)
        ports.voice->hear_by(join);
    if (ports.face)
        join.face = ports.face->events();
    return join;
}

Stay::Stay(client::Participant::Options join, const Ports& ports, KeptSettings settings)
    : ports_(ports), settings_(std::move(settings)), participant_(with(std::move(join), ports)) {
    if (ports_.cameras)
        publishing_.emplace(*ports_.cameras, participant_);
    if (ports_.face)
        showing_.emplace(*ports_.face, participant_);
    if (ports_.voice)
        talking_.emplace(*ports_.voice, participant_);
    if (ports_.expression)
        sending_.emplace(*ports_.expression, participant_);
}

std::string Stay::obey(const StayCommand& command) {
    return std::visit([this](const auto& one) { return carry_out(one); }, command);
}

std::string Stay::carry_out(const ToggleMicrophone&) {
    if (!ports_.voice)
        return say(Phrase::no_microphone_here);
    const auto state = ports_.voice->voices().microphone;
    const bool has_none =
        !state || *state == viewer::Microphone::none || *state == viewer::Microphone::missing;
    if (!has_none || !session::may(participant_.status().standing.role, session::Right::speak))
        return ports_.voice->toggle_microphone();
    return carry_out(UseMicrophone{settings_.now.microphone});
}

std::string Stay::carry_out(const SetMicrophone& command) {
    if (!ports_.voice)
        return say(Phrase::no_microphone_here);
    if (command.to == SetMicrophone::To::closed)
        ports_.voice->close_microphone();
    else
        ports_.voice->open_microphone(command.to == SetMicrophone::To::push_to_talk);
    return ports_.voice->has_microphone() ? "" : say(Phrase::no_microphone_here);
}

std::string Stay::carry_out(const TogglePushToTalk&) {
    if (!ports_.voice)
        return say(Phrase::no_microphone_here);
    const std::string text = ports_.voice->toggle_push_to_talk();
    client::Settings settings = settings_.now;
    settings.push_to_talk = ports_.voice->pushes_to_talk();
    settings_.change(settings);
    return text;
}

std::string Stay::carry_out(const HoldTalk& command) {
    if (ports_.voice)
        ports_.voice->hold_by_line(command.held);
    return "";
}

std::string Stay::carry_out(const UseMicrophone& command) {
    if (!ports_.voice)
        return say(Phrase::no_microphone_here);
    ports_.voice->use_microphone(command.device);
    client::Settings settings = settings_.now;
    settings.microphone = command.device;
    settings.speaks = true;
    settings_.change(settings);
    return say(Phrase::microphone_is_opening);
}

std::string Stay::carry_out(const UseSpeaker& command) {
    if (!ports_.voice)
        return "";
    ports_.voice->use_speaker(command.device);
    client::Settings settings = settings_.now;
    settings.loudspeaker = command.device;
    settings.hears = true;
    settings_.change(settings);
    return "";
}

std::string Stay::carry_out(const AllowVoiceRecording& command) {
    const bool agrees = command.agrees.value_or(!participant_.voice_may_record());
    participant_.allow_voice_recording(agrees);
    client::Settings settings = settings_.now;
    settings.voice_may_record = agrees;
    settings_.change(settings);
    if (agrees && !participant_.asks_voice_consent())
        return say(Phrase::host_asks_no_consent);
    return say(agrees ? Phrase::voice_may_record : Phrase::voice_may_not_record);
}

std::string Stay::carry_out(const ShowFace& command) {
    if (!ports_.face)
        return say(Phrase::no_webcam_here);
    const bool shown = command.shown.value_or(!ports_.face->is_wanted());
    ports_.face->show(shown);
    return say(shown ? Phrase::webcam_is_opening : Phrase::webcam_is_off);
}

std::string Stay::carry_out(const ShowExpression& command) {
    if (!ports_.expression)
        return say(Phrase::no_tracker_here);
    ports_.expression->show(command.shown);
    return "";
}

std::vector<std::string> Stay::tick(TimePoint now) {
    std::vector<std::string> sentences;
    const client::Participant::Status status = participant_.status();
    if (ports_.voice && status.phase == Phase::joined)
        ports_.voice->note(status.standing);
    if (ports_.face) {
        ports_.face->on_tick();
        if (std::string problem = ports_.face->take_problem(); !problem.empty())
            sentences.push_back(std::move(problem));
    }
    if (ports_.expression)
        ports_.expression->hear(ports_.voice ? ports_.voice->heard_level_db() : std::nullopt);
    if (ports_.cameras)
        for (std::string& text : sources_.take(*ports_.cameras, now))
            sentences.push_back(std::move(text));
    return sentences;
}

bool Stay::is_over() const {
    const client::Participant::Status status = participant_.status();
    return status.joins > 0 && (status.phase == Phase::ended || status.phase == Phase::refused);
}

}  // namespace theatron::visit
