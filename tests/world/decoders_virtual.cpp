// SPDX-License-Identifier: Apache-2.0
// Decoding in the World: at once, in the event that brought the message.
#include "base/error.h"
#include "base/fault.h"
#include "client/decoders.h"

namespace theatron::client {

Decoders::Decoders(Events events) : events_(std::move(events)) {
    workers_.push_back(std::make_unique<Worker>(receiver_events(0)));
}

Decoders::~Decoders() = default;

receive::Receiver::Events Decoders::receiver_events(std::size_t worker) {
    receive::Receiver::Events events;
    events.frame = [this, worker](receive::CameraFramePtr frame) {
        events_.frame(std::move(frame), workers_[worker]->generation);
    };
    events.needs_key = events_.needs_key;
    events.now = events_.now;
    return events;
}

std::uint64_t Decoders::set_cameras(const std::vector<wire::Camera>& cameras) {
    Worker& worker = *workers_.front();
    worker.generation = ++generation_;
    worker.receiver.set_cameras({});
    worker.receiver.set_cameras(cameras);
    return generation_;
}

void Decoders::change_cameras(const std::vector<wire::Camera>& cameras) {
    workers_.front()->receiver.set_cameras(cameras);
}

void Decoders::set_settings(const std::vector<wire::StreamSetting>& settings) {
    try {
        workers_.front()->receiver.set_settings(settings);
    } catch (const Error& e) {
        events_.problem(e.what());
    }
}

bool Decoders::on_media(Bytes& message, std::uint64_t) {
    receive::Receiver& receiver = workers_.front()->receiver;
    if (!contain("decode", [&] { (void)receiver.on_media(message, events_.now()); }))
        if (const auto header = wire::parse_media_header(message))
            (void)contain("decode", [&] { events_.needs_key(header->stream, header->setting); });
    return true;
}

std::vector<receive::StreamFigures> Decoders::figures() {
    return workers_.front()->receiver.figures(events_.now());
}

void Decoders::reset_figures() {
    workers_.front()->receiver.reset_figures();
}

void Decoders::want_frames() {}

void Decoders::forget_ages() {
    workers_.front()->receiver.forget_ages();
}

}  // namespace theatron::client
