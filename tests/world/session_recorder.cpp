// SPDX-License-Identifier: Apache-2.0
#include "world/session_recorder.h"

#include <algorithm>

#include "client/session_recording.h"

namespace theatron::world {

SessionRecorder::SessionRecorder(World& world, const std::string& name,
                                 const std::string& depth_codec)
    : file_(world.folder() / (name + ".mkv")), path_(Network::instance().path(name)) {
    net::Link link = net::parse_link(world.link(wire::Role::expert));
    link.host = name;
    source_ =
        client::record_session(link, name, file_.string(), {depth_codec, "jpeg:quality=85"}, {});
    later();
}

SessionRecorder::~SessionRecorder() {
    finish();
}

void SessionRecorder::later() {
    timer_ = Schedule::instance().after(100ms, [this] {
        source_->tick();
        later();
    });
}

void SessionRecorder::finish() {
    if (!timer_)
        return;
    Schedule::instance().cancel(*timer_);
    timer_.reset();
    source_->stop();
    source_->intake().take_held();
    if (record::Recorder* recorder = source_->intake().recorder())
        recorder->finish();
}

std::uint64_t SessionRecorder::recorded() {
    std::uint64_t count = 0;
    for (const auto& stream : source_->intake().streams(Schedule::instance().now()))
        count += stream.figures.recorded;
    return count;
}

bool SessionRecorder::is_complete() {
    const auto streams = source_->intake().streams(Schedule::instance().now());
    return std::all_of(streams.begin(), streams.end(), [](const auto& s) { return s.complete(); });
}

}  // namespace theatron::world
