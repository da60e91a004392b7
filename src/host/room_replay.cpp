// SPDX-License-Identifier: Apache-2.0
#include "host/room_replay.h"

#include <algorithm>
#include <utility>

#include "base/fault.h"
#include "base/options.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "capture/playback.h"
#include "voice/packet.h"

namespace theatron::host {
namespace {

// Poses of a paused recording are repeated before they look stale.
constexpr Duration repeated_after = std::chrono::milliseconds(500);

std::optional<PlayedRecording> played_recording(const std::string& specification) {
    Options options = Options::parse(specification);
    if (options.kind() != "recording")
        return std::nullopt;
    PlayedRecording played{record::RecordingFile::open(options.value()), options.value(), 0, {}};
    const auto& cameras = played.recording->cameras();
    const auto camera = std::size_t(options.take_int("camera", 0, 0, 1000));
    const capture::PlaybackOptions playback = capture::take_playback_options(options);
    Duration begin{};
    double frames_per_second = 30;
    if (cameras.empty() && played.recording->room().present) {
        options.require_no_problem();
    } else if (camera < cameras.size()) {
        const auto& frames = cameras[camera].depth.frames;
        frames_per_second = cameras[camera].frames_per_second;
        if (!frames.empty())
            begin = frames[std::min(std::size_t(playback.start), frames.size() - 1)].time();
    } else {
        return std::nullopt;
    }
    std::optional<Duration> round;
    if (playback.loop)
        round = played.recording->duration() + seconds_to_duration(1 / frames_per_second);
    played.transport =
        std::make_shared<capture::Transport>(played.recording->duration(), round, begin);
    return played;
}

}  // namespace

std::optional<PlayedRecording> find_played_recording(
    const std::vector<std::string>& specifications) {
    std::optional<PlayedRecording> first;
    for (std::size_t i = 0; i < specifications.size(); ++i)
        if (auto played = played_recording(specifications[i])) {
            played->camera = i;
            if (played->recording->room().present)
                return played;
            if (!first)
                first = std::move(played);
        }
    return first;
}

std::vector<std::string> without_room_only(const std::optional<PlayedRecording>& played,
                                           const std::vector<std::string>& specifications) {
    std::vector<std::string> rest;
    for (const std::string& specification : specifications)
        if (!played || !played->recording->cameras().empty() || !plays(*played, specification))
            rest.push_back(specification);
    return rest;
}

bool plays(const PlayedRecording& played, const std::string& specification) {
    const Options options = Options::parse(specification);
    return options.kind() == "recording" && options.value() == played.file;
}

std::size_t camera_in_recording(const std::string& specification) {
    return std::size_t(Options::parse(specification).take_int("camera", 0, 0, 1000));
}

RoomReplay::RoomReplay(PlayedRecording played, std::function<bool()> has_begun,
                       std::function<void(Change)> show,
                       std::function<void(std::vector<Speech>)> speak)
    : source_(std::move(played)),
      has_begun_(std::move(has_begun)),
      show_(std::move(show)),
      speak_(std::move(speak)),
      room_(source_.recording),
      voices_(source_.recording),
      thread_([this] { run(); }) {}

RoomReplay::~RoomReplay() {
    stopping_ = true;
    thread_.join();
}

void RoomReplay::run() {
    name_this_thread("replay");
    while (!stopping_ && !has_begun_())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    while (!stopping_) {
        (void)contain("replay", [this] { play(steady_now()); });
        std::this_thread::sleep_for(period);
    }
}

void RoomReplay::play(TimePoint now) {
    const capture::Transport::State state = source_.transport->state(now);
    play_voices(state, now);
    if (state.paused && now - repeated_ >= repeated_after) {
        repeated_ = now;
        shown_.clear();
        show_(change(now));
    } else if (room_.go_to(state.position)) {
        show_(change(now));
    }
}

void RoomReplay::play_voices(const capture::Transport::State& state, TimePoint now) {
    const auto follows = std::pair(state.changes, state.rounds);
    if (voices_follow_ != follows) {
        voices_follow_ = follows;
        voices_zero_ = now - state.position;
        voices_.restart_at(state.position);
    }
    if (state.paused)
        return;
    std::vector<Speech> speech;
    voices_.play(state.position, [&](const capture::RecordedSpeech& said) {
        voice::Packet packet;
        packet.frame_ms = int(said.samples * 1000 / voice::sample_rate);
        const bool can_be_sent =
            packet.samples() == said.samples && (packet.frame_ms == 10 || packet.frame_ms == 20);
        if (!can_be_sent || said.person == ParticipantId{} ||
            said.opus.size() > voice::max_opus_size)
            return;
        packet.time = voices_zero_ + said.at;
        // Numbers follow the time, so that they also grow in the next round.
        packet.number = std::uint32_t((to_us(packet.time) / 1000 + 5) / packet.frame_ms);
        packet.pauses = said.pauses;
        packet.level_db = said.level_db;
        packet.opus = said.opus;
        voice::write_packet(packet, speech.emplace_back(Speech{said.person, {}}).packet);
    });
    if (!speech.empty())
        speak_(std::move(speech));
}

RoomReplay::Change RoomReplay::change(TimePoint now) {
    Change change;
    change.objects = room_.objects();
    for (const auto& [person, body] : shown_)
        if (!room_.poses().contains(person))
            change.left.push_back(person);
    for (const auto& [person, body] : room_.poses()) {
        const auto shown = shown_.find(person);
        if (shown != shown_.end() && shown->second == body)
            continue;
        auto pose = wire::decode_person_pose(body);
        if (!pose)
            continue;
        pose->time = now;
        change.poses.emplace_back(person, wire::encode_person_pose(*pose));
    }
    shown_ = room_.poses();
    return change;
}

}  // namespace theatron::host
