// SPDX-License-Identifier: Apache-2.0
#include "host/room_replay.h"

#include <algorithm>

#include "base/fault.h"
#include "base/options.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "capture/playback.h"

namespace theatron::host {
namespace {

std::optional<ReplayedRoom> replayed_room(const std::string& specification) {
    Options options = Options::parse(specification);
    if (options.kind() != "recording")
        return std::nullopt;
    ReplayedRoom room{record::RecordingFile::open(options.value()), options.value(), 0, {}, {}};
    const auto& cameras = room.recording->cameras();
    const auto camera = std::size_t(options.take_int("camera", 0, 0, 1000));
    const capture::PlaybackOptions playback = capture::take_playback_options(options);
    if (!room.recording->room().present || camera >= cameras.size())
        return std::nullopt;
    const auto& frames = cameras[camera].depth.frames;
    if (!frames.empty())
        room.begin = frames[std::min(std::size_t(playback.start), frames.size() - 1)].time();
    if (playback.loop)
        room.round =
            room.recording->duration() + seconds_to_duration(1 / cameras[camera].frames_per_second);
    return room;
}

}  // namespace

std::optional<ReplayedRoom> find_replayed_room(const std::vector<std::string>& specifications) {
    for (std::size_t i = 0; i < specifications.size(); ++i)
        if (auto room = replayed_room(specifications[i])) {
            room->camera = i;
            return room;
        }
    return std::nullopt;
}

bool plays(const ReplayedRoom& room, const std::string& specification) {
    const Options options = Options::parse(specification);
    return options.kind() == "recording" && options.value() == room.file;
}

RoomReplay::RoomReplay(ReplayedRoom room, std::function<bool()> has_begun,
                       std::function<void(Change)> show)
    : source_(std::move(room)),
      has_begun_(std::move(has_begun)),
      show_(std::move(show)),
      room_(source_.recording),
      thread_([this] { (void)contain("replay", [this] { run(); }); }) {}

RoomReplay::~RoomReplay() {
    stopping_ = true;
    thread_.join();
}

void RoomReplay::run() {
    name_this_thread("replay");
    while (!stopping_ && !has_begun_())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    TimePoint zero = steady_now() - source_.begin;  // of the recording
    while (!stopping_) {
        const TimePoint now = steady_now();
        if (source_.round && now - zero >= *source_.round)
            zero += *source_.round;
        if (room_.go_to(now - zero))
            show_(change(now));
        std::this_thread::sleep_for(period);
    }
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
