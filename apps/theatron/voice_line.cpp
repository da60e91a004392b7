// SPDX-License-Identifier: Apache-2.0
#include "voice_line.h"
#include "phrases/phrase.h"

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

double to_ms_of(std::uint64_t samples) {
    return double(samples) * 1000 / voice::sample_rate;
}

}  // namespace

VoiceLine::VoiceLine(const Options& options) : options_(options), is_pushed_(options.push_to_talk) {
    if (options_.cleaning != Options::Cleaning::off) {
        try {
            canceller_ = std::make_unique<sound::EchoCanceller>();
        } catch (const Error& error) {
            log::say(error.what());
        }
    }
    if (!options_.speaker.empty())
        use_speaker(options_.speaker);
}

void VoiceLine::use_speaker(const std::string& name) {
    if (speaker_) {
        speaker_->change(name);
        return;
    }
    const auto open = [this](const std::string& wanted) {
        using Spatial = Options::Spatial;
        const bool in_space = options_.spatial == Spatial::on ||
                              (options_.spatial == Spatial::automatic && !sound::is_file(wanted));
        if (!in_space)
            return sound::open_speaker(wanted, [this](std::span<float> out) { play(out); });
        {
            const std::lock_guard lock(mixer_mutex_);
            if (!spatial_)
                spatial_ = std::make_unique<sound::SpatialVoices>();
        }
        constexpr int ears = 2;
        return sound::open_speaker(
            wanted, [this](std::span<float> out) { play_in_space(out); }, ears);
    };
    speaker_ = std::make_unique<sound::KeptDevice>(
        "loudspeaker", name, open, [](const std::string& text) { log::say(text); },
        sound::KeptDevice::usual_interval, options_.usual_instead);
    plays_ = true;
}

void VoiceLine::play(std::span<float> out) {
    {
        const std::lock_guard lock(mixer_mutex_);
        mixer_.pull(out, steady_now());
    }
    if (cleans_)
        canceller_->played(out);
}

void VoiceLine::play_in_space(std::span<float> out) {
    // A voice whose place is not known is heard from ahead.
    constexpr Vec3 ahead{0, 0, -sound::full_loudness_m};
    const TimePoint now = steady_now();
    played_.resize(out.size() / 2);
    {
        const std::lock_guard lock(mixer_mutex_);
        if (head_from_room_) {
            std::vector<sound::SpatialVoices::Voice> voices;
            for (const voice::Mixer::Heard& heard : mixer_.pull_each(played_.size(), now)) {
                const auto place = heads_.find(heard.speaker);
                voices.push_back({heard.speaker,
                                  place != heads_.end() ? *head_from_room_ * place->second : ahead,
                                  heard.samples});
            }
            spatial_->mix(voices, out);
        } else {
            mixer_.pull(played_, now);
            for (std::size_t i = 0; i < played_.size(); ++i)
                out[2 * i] = out[2 * i + 1] = played_[i];
        }
    }
    for (std::size_t i = 0; i < played_.size(); ++i)
        played_[i] = (out[2 * i] + out[2 * i + 1]) / 2;
    if (cleans_)
        canceller_->played(played_);
}

void VoiceLine::place(const Pose& room_from_head, const client::Participant& participant) {
    std::map<ParticipantId, Vec3> heads;
    for (const auto& [id, pose] : participant.poses())
        if (pose.head) {
            const auto& [x, y, z] = pose.head->position;
            heads[id] = {x, y, z};
        }
    const std::lock_guard lock(mixer_mutex_);
    head_from_room_ = inverse(room_from_head);
    heads_ = std::move(heads);
}

void VoiceLine::hear_by(client::Participant::Options& options) {
    options.voice = [this](ParticipantId speaker, ByteView packet) { hear(speaker, packet); };
}

void VoiceLine::hear(ParticipantId speaker, ByteView packet) {
    const TimePoint now = steady_now();
    const std::lock_guard lock(mixer_mutex_);
    speakers_.hear(speaker, packet, now);
    // Without a loudspeaker nothing would take the packets.
    if (plays_)
        mixer_.put(speaker, packet, now);
}

VoiceLine::Talking::Talking(VoiceLine& line, client::Participant& participant) : line_(line) {
    {
        const std::lock_guard lock(line.talker_mutex_);
        line.talker_ = std::make_unique<voice::Talker>(
            line.options_.frame_ms,
            [&participant](ByteView packet) { participant.send_voice(packet); });
        line.apply();
    }
    line.participant_ = &participant;
    if (!line.options_.microphone.empty())
        line.use_microphone(line.options_.microphone);
}

VoiceLine::Talking::~Talking() {
    line_.microphone_.reset();
    line_.participant_ = nullptr;
    const std::lock_guard lock(line_.talker_mutex_);
    line_.talker_.reset();
}

void VoiceLine::use_microphone(const std::string& name) {
    if (microphone_) {
        microphone_->change(name);
        return;
    }
    const auto open = [this](const std::string& wanted) {
        using Cleaning = Options::Cleaning;
        cleans_ = canceller_ && (options_.cleaning == Cleaning::on || !sound::is_file(wanted));
        return sound::open_microphone(wanted,
                                      [this](std::span<const float> samples) { take(samples); });
    };
    microphone_ = std::make_unique<sound::KeptDevice>(
        "microphone", name, open, [](const std::string& text) { log::say(text); },
        sound::KeptDevice::usual_interval, options_.usual_instead);
}

// The microphone has delivered these samples just now.
void VoiceLine::take(std::span<const float> samples) {
    const TimePoint now = participant_->now();
    if (cleans_) {
        uncleaned_.insert(uncleaned_.end(), samples.begin(), samples.end());
        constexpr std::size_t block = sound::EchoCanceller::block;
        const std::size_t whole = uncleaned_.size() / block * block;
        for (std::size_t i = 0; i < whole; i += block)
            canceller_->clean(std::span<float, block>(uncleaned_.data() + i, block));
        const auto end = uncleaned_.begin() + std::ptrdiff_t(whole);
        cleaned_.assign(uncleaned_.begin(), end);
        uncleaned_.erase(uncleaned_.begin(), end);
        samples = cleaned_;
    }
    const std::lock_guard lock(talker_mutex_);
    talker_->take(samples, now);
}

bool VoiceLine::has_microphone() const {
    return microphone_ && microphone_->works();
}

bool VoiceLine::obey(const std::string& line) {
    std::istringstream words(line);
    std::string what, value;
    words >> what >> value;
    if (what == "talk" && (value == "on" || value == "off")) {
        {
            const std::lock_guard lock(talker_mutex_);
            line_holds_ = value == "on";
        }
        hold(false, steady_now());
        return true;
    }
    if (what == "use" && (value == "microphone" || value == "speaker")) {
        std::string name;
        std::getline(words >> std::ws, name);
        if (name.empty())
            name = "default";
        if (value == "speaker")
            use_speaker(name);
        else if (participant_)
            use_microphone(name);
        return true;
    }
    if (what != "microphone" || (value != "on" && value != "off" && value != "push"))
        return false;
    if (!has_microphone())
        log::say(theatron::say(Phrase::no_microphone_here));
    const std::lock_guard lock(talker_mutex_);
    is_open_ = value != "off";
    if (is_open_)
        is_pushed_ = value == "push";
    apply();
    return true;
}

void VoiceLine::apply() {
    if (talker_)
        talker_->set_open(is_open_ && (!is_pushed_ || talks_));
}

void VoiceLine::hold(bool is_held, TimePoint now) {
    const std::lock_guard lock(talker_mutex_);
    is_held = is_held || line_holds_;
    if (is_held)
        held_at_ = now;
    const bool talks = is_held || (talks_ && now - held_at_ < release_time);
    if (std::exchange(talks_, talks) != talks)
        apply();
}

std::string VoiceLine::toggle_push_to_talk() {
    const std::lock_guard lock(talker_mutex_);
    is_pushed_ = !is_pushed_;
    apply();
    return say(is_pushed_ ? Phrase::push_to_talk : Phrase::open_microphone);
}

bool VoiceLine::pushes_to_talk() const {
    const std::lock_guard lock(talker_mutex_);
    return is_pushed_;
}

std::string VoiceLine::toggle_microphone() {
    if (!has_microphone())
        return say(Phrase::no_microphone_here);
    const std::lock_guard lock(talker_mutex_);
    is_open_ = !is_open_;
    apply();
    return say(!is_open_    ? Phrase::microphone_is_closed
               : is_pushed_ ? Phrase::push_to_talk
                            : Phrase::microphone_is_open);
}

void VoiceLine::note(const wire::Standing& standing) {
    const bool may_speak = session::may(standing.role, session::Right::speak);
    const bool has = has_microphone();
    const std::lock_guard lock(talker_mutex_);
    is_heard_ = may_speak && !standing.muted;
    // The participant says who is muted.
    if (!has || may_speak == std::exchange(may_speak_, may_speak))
        return;
    log::say(may_speak ? "The others hear you."
                       : "Nobody hears you, because observers do not speak; an operator can give "
                         "you another role.");
}

std::set<ParticipantId> VoiceLine::speaking() const {
    const std::lock_guard lock(mixer_mutex_);
    return speakers_.speaking(steady_now());
}

viewer::Voices VoiceLine::voices() const {
    using viewer::Microphone;
    viewer::Voices voices;
    const bool has = has_microphone();
    {
        const std::lock_guard lock(talker_mutex_);
        voices.microphone = !microphone_         ? Microphone::none
                            : !has || !talker_   ? Microphone::missing
                            : !is_open_          ? Microphone::closed
                            : talker_->is_open() ? Microphone::open
                                                 : Microphone::waits;
        if (has && talker_)
            voices.own_level_db = talker_->level_db();
    }
    const std::lock_guard lock(mixer_mutex_);
    voices.speaking = speakers_.levels_db(steady_now());
    return voices;
}

viewer::SoundChoices VoiceLine::sound_choices(const sound::DeviceList& devices) const {
    const auto with_usual = [](const std::vector<std::string>& names) {
        std::vector<std::string> all = names;
        if (!all.empty())
            all.insert(all.begin(), "default");
        return all;
    };
    return {with_usual(devices.microphones), with_usual(devices.loudspeakers),
            microphone_ ? microphone_->name() : "", speaker_ ? speaker_->name() : ""};
}

nlohmann::json VoiceLine::json() const {
    nlohmann::json result;
    const bool has = has_microphone();
    {
        const std::lock_guard lock(talker_mutex_);
        const bool talks = has && talker_ && talker_->is_open();
        result["microphone"] = !has ? "none" : !is_open_ ? "closed" : is_pushed_ ? "push" : "open";
        result["talks"] = talks;
        result["heard"] = talks && is_heard_;
        result["level_db"] = has && talker_ ? talker_->level_db() : -127;
    }
    if (has) {
        result["microphone_name"] = microphone_->name();
        result["echo_cancellation"] = cleans_.load();
        if (const auto began = microphone_->began())
            result["microphone_began_us"] = to_us(*began);
    }
    result["speaker"] = speaker_ && speaker_->works();
    if (const auto began = speaker_ ? speaker_->began() : std::nullopt)
        result["speaker_began_us"] = to_us(*began);
    result["speaking"] = result["voices"] = nlohmann::json::array();
    const std::lock_guard lock(mixer_mutex_);
    for (const voice::Mixer::Speaker& speaker : mixer_.speakers()) {
        if (speaker.level_db >= speech_db)
            result["speaking"].push_back(
                {{"id", std::uint32_t(speaker.id)}, {"level_db", speaker.level_db}});
        result["voices"].push_back(
            {{"id", std::uint32_t(speaker.id)},
             {"delay_ms", to_ms(speaker.delay)},
             {"seconds", to_ms_of(speaker.figures.samples) / 1000},
             {"concealed_ms", to_ms_of(speaker.figures.concealed)},
             {"longest_concealed_ms", to_ms_of(speaker.figures.longest_concealed)}});
    }
    result["unreadable"] = mixer_.unreadable();
    result["space"] = !spatial_                                    ? "off"
                      : spatial_->way() == sound::SpatialWay::hrtf ? "hrtf"
                                                                   : "panning";
    return result;
}

}  // namespace theatron::app
