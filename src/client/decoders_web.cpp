// SPDX-License-Identifier: Apache-2.0
// Decoding in a browser: in the page's workers, or where there are none at once in the event that
// brought the message.
#include <algorithm>

#include "base/error.h"
#include "base/fault.h"
#include "client/decoder_pool_web.h"
#include "client/decoders.h"
#include "client/pooled_decoders_web.h"
#include "video/browser_decoders_web.h"

namespace theatron::client {
namespace {

// The workers' decoders of the page's one participant.
std::unique_ptr<PooledDecoders>& pooled() {
    static std::unique_ptr<PooledDecoders> only;
    return only;
}

}  // namespace

Decoders::Decoders(Events events) : events_(std::move(events)) {
    pooled().reset();
    if (decoder_pool().count > 0)
        pooled() = std::make_unique<PooledDecoders>(events_);
    workers_.push_back(std::make_unique<Worker>(receiver_events(0)));
    video::browser_decoders().on_news = [this] {
        (void)contain("decode", [&] { workers_.front()->receiver.poll(events_.now()); });
    };
}

Decoders::~Decoders() {
    video::browser_decoders().on_news = nullptr;
    pooled().reset();
}

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
    if (pooled()) {
        pooled()->set_cameras(cameras);
        return pooled()->generation();
    }
    Worker& worker = *workers_.front();
    worker.generation = ++generation_;
    // No decoder is kept: numbers of settings may start again.
    worker.receiver.set_cameras({});
    worker.receiver.set_cameras(cameras);
    return generation_;
}

void Decoders::change_cameras(const std::vector<wire::Camera>& cameras) {
    if (pooled())
        return pooled()->change_cameras(cameras);
    workers_.front()->receiver.set_cameras(cameras);
}

void Decoders::set_settings(const std::vector<wire::StreamSetting>& settings) {
    if (pooled())
        return pooled()->set_settings(settings);
    try {
        workers_.front()->receiver.set_settings(settings);
    } catch (const Error& e) {
        events_.problem(e.what());
    }
}

bool Decoders::on_media(Bytes& message, std::uint64_t connection) {
    if (pooled())
        return pooled()->on_media(message, connection);
    receive::Receiver& receiver = workers_.front()->receiver;
    // The receiver counts damage and requests a key frame.
    if (!contain("decode", [&] { (void)receiver.on_media(message, events_.now()); }))
        // The picture is lost, and the state of its decoder is undefined.
        if (const auto header = wire::parse_media_header(message))
            (void)contain("decode", [&] { events_.needs_key(header->stream, header->setting); });
    return true;
}

std::vector<receive::StreamFigures> Decoders::figures() {
    if (pooled())
        return pooled()->figures();
    return workers_.front()->receiver.figures(events_.now());
}

void Decoders::reset_figures() {
    if (pooled())
        return pooled()->reset_figures();
    workers_.front()->receiver.reset_figures();
}

void Decoders::want_frames() {
    if (pooled())
        pooled()->want_frames();
}

void Decoders::forget_ages() {
    if (pooled())
        return pooled()->forget_ages();
    workers_.front()->receiver.forget_ages();
}

}  // namespace theatron::client
