// SPDX-License-Identifier: Apache-2.0
#include "visit/voice_line.h"
#include "phrases/phrase.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "session/permissions.h"

namespace theatron::visit {
namespace {

// A frame of this level counts as speech.
constexpr int speech_db = -50;

double to_ms_of(std::uint64_t samples) {
    return double(samples) * 1000 / voice::sample_rate;
}

void say_text(const std::string& text) {
    log::say(text);
}

std::unique_ptr<sound::EchoCanceller> canceller_of(VoiceLine::Options::Cleaning cleaning) {
    if (cleaning == VoiceLine::Options::Cleaning::off)
        return nullptr;
    try {
        return std::make_unique<sound::EchoCanceller>();
    } catch (const Error& error) {
        log::say(error.what());
        return nullptr;
    }
}

}  // namespace

VoiceLine::VoiceLine(const Options& options)
    : options_(options),
      switch_(options.push_to_talk),
      canceller_(canceller_of(options.cleaning)),
      output_([this](std::span<const float> samples) { rendered(samples); }) {
    if (!options_.speaker.empty())
        use_speaker(options_.speaker);
}

void VoiceLine::rendered(std::span<const float> samples) {
    if (cleans_)
        canceller_->played(samples);
}

void VoiceLine::use_speaker(const std::string& name) {
    if (speaker_)
        return speaker_->change(name);
    output_thread_ = std::make_unique<sound::FeedThread>(
        "loudspeaker", [this] { return output_.work(steady_now); });
    speaker_ = std::make_unique<sound::KeptDevice>(
        "loudspeaker", name, [this](const std::string& wanted) { return open_speaker(wanted); },
        say_text, sound::KeptDevice::usual_interval, options_.usual_instead);
}

std::unique_ptr<sound::SoundDevice> VoiceLine::open_speaker(const std::string& name) {
    using Spatial = Options::Spatial;
    const bool in_space = options_.spatial == Spatial::on ||
                          (options_.spatial == Spatial::automatic && !sound::is_file(name));
    const int channels = in_space ? 2 : 1;
    output_.begin(channels);
    return sound::open_speaker(
        name,
        [this](std::span<float> out) {
            output_.play(out, steady_now());
            output_thread_->wake();
        },
        channels);
}

void VoiceLine::place(const Pose& room_from_head, const client::Participant& participant) {
    std::map<ParticipantId, Vec3> heads;
    for (const auto& [id, pose] : participant.poses())
        if (pose.head) {
            const auto& [x, y, z] = pose.head->position;
            heads[id] = {x, y, z};
        }
    output_.place(room_from_head, std::move(heads));
}

void VoiceLine::hear_by(client::Participant::Options& options) {
    options.voice = [this](ParticipantId speaker, ByteView packet) {
        output_.hear(speaker, packet, steady_now());
    };
}

VoiceLine::Talking::Talking(VoiceLine& line, client::Participant& participant) : line_(line) {
    line.input_ = std::make_unique<sound::VoiceInput>(
        line.options_.frame_ms, [&participant](ByteView packet) { participant.send_voice(packet); },
        [&participant](TimePoint steady) { return participant.session_time(steady); });
    line.input_thread_ = std::make_unique<sound::FeedThread>("microphone", [&line] {
        line.input_->work();
        return TimePoint::max();
    });
    line.apply();
    if (!line.options_.microphone.empty())
        line.use_microphone(line.options_.microphone);
}

VoiceLine::Talking::~Talking() {
    line_.microphone_.reset();
    line_.input_thread_.reset();
    line_.input_.reset();
}

void VoiceLine::use_microphone(const std::string& name) {
    if (microphone_)
        return microphone_->change(name);
    if (!input_)
        return;
    microphone_ = std::make_unique<sound::KeptDevice>(
        "microphone", name, [this](const std::string& wanted) { return open_microphone(wanted); },
        say_text, sound::KeptDevice::usual_interval, options_.usual_instead);
}

std::unique_ptr<sound::SoundDevice> VoiceLine::open_microphone(const std::string& name) {
    using Cleaning = Options::Cleaning;
    cleans_ = canceller_ && (options_.cleaning == Cleaning::on || !sound::is_file(name));
    input_->clean_by(cleans_ ? canceller_.get() : nullptr);
    return sound::open_microphone(name, [this](std::span<const float> samples) {
        input_->take(samples, steady_now());
        input_thread_->wake();
    });
}

bool VoiceLine::has_microphone() const {
    return microphone_ && microphone_->works();
}

void VoiceLine::apply() {
    if (input_)
        input_->set_open(switch_.talks());
}

void VoiceLine::hold(bool is_held, TimePoint now) {
    switch_.hold(is_held || line_holds_, now);
    apply();
}

void VoiceLine::hold_by_line(bool is_held) {
    line_holds_ = is_held;
    hold(false, steady_now());
}

std::string VoiceLine::toggle_push_to_talk() {
    switch_.set_pushes(!switch_.pushes());
    apply();
    return say(switch_.pushes() ? Phrase::push_to_talk : Phrase::open_microphone);
}

std::string VoiceLine::toggle_microphone() {
    if (!has_microphone())
        return say(Phrase::no_microphone_here);
    switch_.set_open(!switch_.is_open());
    apply();
    return say(!switch_.is_open() ? Phrase::microphone_is_closed
               : switch_.pushes() ? Phrase::push_to_talk
                                  : Phrase::microphone_is_open);
}

void VoiceLine::close_microphone() {
    switch_.set_open(false);
    apply();
}

void VoiceLine::open_microphone(bool pushes) {
    switch_.set_open(true);
    switch_.set_pushes(pushes);
    apply();
}

void VoiceLine::note(const wire::Standing& standing) {
    const bool may_speak = session::may(standing.role, session::Right::speak);
    is_heard_ = may_speak && !standing.muted;
    // The participant says who is muted.
    if (!has_microphone() || may_speak == std::exchange(may_speak_, may_speak))
        return;
    log::say(may_speak ? "The others hear you."
                       : "Nobody hears you, because observers do not speak; an operator can give "
                         "you another role.");
}

std::optional<int> VoiceLine::heard_level_db() const {
    if (!has_microphone() || !switch_.talks() || !is_heard_)
        return std::nullopt;
    return input_->level_db();
}

std::set<ParticipantId> VoiceLine::speaking() const {
    return output_.speaking(steady_now());
}

viewer::Voices VoiceLine::voices() const {
    using viewer::Microphone;
    viewer::Voices voices;
    const bool has = has_microphone();
    voices.microphone = !microphone_         ? Microphone::none
                        : !has               ? Microphone::missing
                        : !switch_.is_open() ? Microphone::closed
                        : switch_.talks()    ? Microphone::open
                                             : Microphone::waits;
    if (has)
        voices.own_level_db = input_->level_db();
    voices.speaking = output_.levels_db(steady_now());
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

nlohmann::json VoiceLine::microphone_json() const {
    const bool has = has_microphone();
    const bool talks = has && switch_.talks();
    nlohmann::json result{{"microphone", !has                 ? "none"
                                         : !switch_.is_open() ? "closed"
                                         : switch_.pushes()   ? "push"
                                                              : "open"},
                          {"talks", talks},
                          {"heard", talks && is_heard_},
                          {"level_db", has ? input_->level_db() : -127}};
    if (!has)
        return result;
    result["microphone_name"] = microphone_->name();
    result["echo_cancellation"] = cleans_.load();
    result["lost_ms"] = to_ms_of(input_->lost());
    if (const auto began = microphone_->began())
        result["microphone_began_us"] = to_us(*began);
    return result;
}

nlohmann::json VoiceLine::json() const {
    nlohmann::json result = microphone_json();
    const sound::VoiceOutput::Figures figures = output_.figures();
    result["speaker"] = speaker_ && speaker_->works();
    if (result["speaker"])
        result["lead_ms"] = to_ms(figures.lead);
    if (const auto began = speaker_ ? speaker_->began() : std::nullopt)
        result["speaker_began_us"] = to_us(*began);
    result["speaking"] = result["voices"] = nlohmann::json::array();
    for (const voice::Mixer::Speaker& speaker : figures.speakers) {
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
    result["unreadable"] = figures.unreadable;
    result["missing_ms"] = to_ms_of(figures.missing);
    result["space"] = !figures.space                              ? "off"
                      : *figures.space == sound::SpatialWay::hrtf ? "hrtf"
                                                                  : "panning";
    return result;
}

}  // namespace theatron::visit
