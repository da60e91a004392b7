// SPDX-License-Identifier: Apache-2.0
#include "voice_line.h"

#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "session/permissions.h"

namespace theatron::app {
namespace {

// A frame of this level counts as speech.
constexpr int speech_db = -50;

constexpr const char* without_microphone =
    "You have no microphone here: join with --microphone default";

double to_ms_of(std::uint64_t samples) {
    return double(samples) * 1000 / voice::sample_rate;
}

}  // namespace

VoiceLine::VoiceLine(const Options& options) : options_(options) {
    if (options_.speaker.empty())
        return;
    try {
        speaker_ = sound::open_speaker(options_.speaker, [this](std::span<float> out) {
            const std::lock_guard lock(mixer_mutex_);
            mixer_.pull(out, steady_now());
        });
    } catch (const Error& error) {
        log::say(error.what());
    }
}

void VoiceLine::hear(ParticipantId speaker, ByteView packet) {
    // Without a loudspeaker nothing would take the packets.
    if (!speaker_)
        return;
    const std::lock_guard lock(mixer_mutex_);
    mixer_.put(speaker, packet, steady_now());
}

VoiceLine::Talking::Talking(VoiceLine& line, client::Participant& participant) {
    if (line.options_.microphone.empty())
        return;
    {
        const std::lock_guard lock(line.talker_mutex_);
        line.talker_ = std::make_unique<voice::Talker>(
            line.options_.frame_ms,
            [&participant](ByteView packet) { participant.send_voice(packet); });
        line.talker_->set_open(line.is_open_);
    }
    try {
        microphone_ = sound::open_microphone(line.options_.microphone,
                                             [&line, &participant](std::span<const float> samples) {
                                                 const TimePoint now = participant.now();
                                                 const std::lock_guard lock(line.talker_mutex_);
                                                 line.talker_->take(samples, now);
                                             });
        const std::lock_guard lock(line.talker_mutex_);
        line.microphone_began_ = microphone_->began();
    } catch (const Error& error) {
        log::say(error.what());
        const std::lock_guard lock(line.talker_mutex_);
        line.talker_.reset();
    }
}

bool VoiceLine::obey(const std::string& line) {
    std::istringstream words(line);
    std::string what, value;
    words >> what >> value;
    if (what != "microphone" || (value != "on" && value != "off"))
        return false;
    const std::lock_guard lock(talker_mutex_);
    is_open_ = value == "on";
    if (talker_)
        talker_->set_open(is_open_);
    else
        log::say(without_microphone);
    return true;
}

std::string VoiceLine::toggle_microphone() {
    const std::lock_guard lock(talker_mutex_);
    if (!talker_)
        return without_microphone;
    is_open_ = !is_open_;
    talker_->set_open(is_open_);
    return is_open_ ? "Microphone open" : "Microphone closed: nobody hears you";
}

void VoiceLine::note(const wire::Standing& standing) {
    const bool may_speak = session::may(standing.role, session::Right::speak);
    const bool is_heard = may_speak && !standing.muted;
    const std::lock_guard lock(talker_mutex_);
    if (!talker_ || is_heard == std::exchange(is_heard_, is_heard))
        return;
    log::say(is_heard    ? "The others hear you."
             : may_speak ? "An operator has muted you: nobody hears you."
                         : "Nobody hears you, because observers do not speak; an operator can give "
                           "you another role.");
}

nlohmann::json VoiceLine::json() const {
    nlohmann::json result;
    {
        const std::lock_guard lock(talker_mutex_);
        result["microphone"] = !talker_ ? "none" : talker_->is_open() ? "open" : "closed";
        result["heard"] = talker_ && talker_->is_open() && is_heard_;
        if (microphone_began_)
            result["microphone_began_us"] = to_us(*microphone_began_);
        result["level_db"] = talker_ ? talker_->level_db() : -127;
    }
    result["speaker"] = speaker_ != nullptr;
    if (const auto began = speaker_ ? speaker_->began() : std::nullopt)
        result["speaker_began_us"] = to_us(*began);
    result["speaking"] = result["voices"] = nlohmann::json::array();
    const std::lock_guard lock(mixer_mutex_);
    for (const voice::Mixer::Speaker& speaker : mixer_.speakers()) {
        if (speaker.level_db >= speech_db)
            result["speaking"].push_back({{"id", int(speaker.id)}, {"level_db", speaker.level_db}});
        result["voices"].push_back(
            {{"id", int(speaker.id)},
             {"delay_ms", to_ms(speaker.delay)},
             {"seconds", to_ms_of(speaker.figures.samples) / 1000},
             {"concealed_ms", to_ms_of(speaker.figures.concealed)},
             {"longest_concealed_ms", to_ms_of(speaker.figures.longest_concealed)}});
    }
    result["unreadable"] = mixer_.unreadable();
    return result;
}

}  // namespace theatron::app
