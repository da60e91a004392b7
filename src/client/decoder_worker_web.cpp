// SPDX-License-Identifier: Apache-2.0
#include "client/decoder_worker_web.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fault.h"
#include "base/steady_clock.h"
#include "client/decoder_messages.h"
#include "client/wanted_frames.h"
#include "video/browser_decoders_web.h"

namespace theatron::client {
namespace {

class DecoderWorker {
public:
    DecoderWorker(Duration clock_difference, std::function<void(ByteView)> reply)
        : clock_difference_(clock_difference), reply_(std::move(reply)), receiver_(events()) {
        video::browser_decoders().on_news = [this] {
            (void)contain("decode", [&] { receiver_.poll(now()); });
            tell_done();
        };
    }

    void on(const WorkerCameras& m) {
        generation_ = m.generation;
        if (m.anew) {
            receiver_.set_cameras({});
            colors_.clear();
            wanted_.begin_anew();
        }
        for (const CameraId camera : std::exchange(cameras_, {}))
            wanted_.forget(camera);
        for (const wire::Camera& camera : m.cameras)
            cameras_.push_back(camera.id);
        receiver_.set_cameras(m.cameras);
        tell_done();
    }

    void on(const WorkerSettings& m) {
        try {
            receiver_.set_settings(m.settings);
        } catch (const Error& e) {
            reply(WorkerProblem{generation_, e.what()});
        }
    }

    void on(const WorkerMedia& m) {
        session_offset_ = m.session_offset;
        // The receiver counts damage and requests a key frame.
        if (!contain("decode", [&] { (void)receiver_.on_media(m.message, now()); }))
            // The picture is lost, and the state of its decoder is undefined.
            if (const auto header = wire::parse_media_header(m.message))
                reply(WorkerNeedsKey{generation_, header->stream, header->setting});
        done_.push_back(m.number);
        tell_done();
    }

    void on(const WorkerFiguresWanted& m) {
        session_offset_ = m.session_offset;
        if (m.reset)
            receiver_.reset_figures();
        if (m.forgets_ages)
            receiver_.forget_ages();
        reply(WorkerFigures{generation_, receiver_.figures(now())});
    }

    void on(const WorkerFramesWanted&) {
        for (const receive::CameraFramePtr& frame : wanted_.want())
            send(*frame);
    }

private:
    // Pictures that a browser's decoder may work on while further messages come.
    static constexpr std::size_t most_decoded_at_once = 2;

    // The host sends no more than what was taken, so that none of its pictures wait here for long.
    void tell_done() {
        if (receiver_.pending() > most_decoded_at_once)
            return;
        for (const std::uint64_t number : std::exchange(done_, {}))
            reply(WorkerDone{number});
    }

    receive::Receiver::Events events() {
        receive::Receiver::Events events;
        events.frame = [this](const receive::CameraFramePtr& frame) {
            if (wanted_.add(frame))
                send(*frame);
        };
        events.needs_key = [this](StreamId stream, SettingId setting) {
            reply(WorkerNeedsKey{generation_, stream, setting});
        };
        events.now = [this] { return now(); };
        return events;
    }

    void send(const receive::CameraFrame& frame) {
        WorkerFrame m;
        m.generation = generation_;
        m.camera = frame.camera;
        m.number = frame.number;
        m.moment = frame.moment;
        m.times = frame.times;
        m.past = frame.past;
        m.depth_size = frame.depth.size;
        m.depth = std::as_bytes(std::span(frame.depth.pixels));
        if (frame.color) {
            // Keeping it keeps its memory from being used for the next.
            auto& before = colors_[frame.camera];
            m.same_color = before == frame.color;
            before = frame.color;
            m.color_size = frame.color->size;
            if (!m.same_color)
                m.color = std::as_bytes(std::span(frame.color->pixels));
        }
        reply(m);
    }

    TimePoint now() const { return steady_now() - clock_difference_ + session_offset_; }
    void reply(const FromWorker& message) { reply_(encode(message)); }

    Duration clock_difference_, session_offset_{};
    std::function<void(ByteView)> reply_;
    std::uint64_t generation_ = 0;
    receive::Receiver receiver_;
    std::vector<CameraId> cameras_;
    WantedFrames wanted_;
    std::map<CameraId, std::shared_ptr<const ColorImage>> colors_;  // last sent
    std::vector<std::uint64_t> done_;  // messages that the page does not know to be taken
};

std::optional<DecoderWorker>& worker() {
    static std::optional<DecoderWorker> only;
    return only;
}

}  // namespace

void begin_decoder_worker(Duration clock_difference, std::function<void(ByteView)> reply) {
    worker().emplace(clock_difference, std::move(reply));
}

void on_decoder_work(ByteView message) {
    if (const auto work = decode_to_worker(message))
        std::visit([](const auto& m) { worker()->on(m); }, *work);
}

}  // namespace theatron::client
