// SPDX-License-Identifier: Apache-2.0
#include "client/pooled_decoders_web.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/steady_clock.h"
#include "client/decoder_pool_web.h"
#include "client/participant_figures.h"

namespace theatron::client {
namespace {

// Never the same twice in a page: replies that a worker owes to an earlier participant are known
// by it.
std::uint64_t next_number() {
    static std::uint64_t last = 0;
    return ++last;
}

// Copies rows without padding; an image without pixels is one, too. False if they are not of this
// size.
template <class T>
bool copy_rows(ByteView rows, Size size, Image<T>& image) {
    if (size == Size{} && rows.empty()) {
        image.resize(size);
        return true;
    }
    if (size.width <= 0 || size.height <= 0 || rows.size() != size.area() * sizeof(T))
        return false;
    image.resize(size);
    std::memcpy(image.pixels.data(), rows.data(), rows.size());
    return true;
}

}  // namespace

DecoderPool& decoder_pool() {
    static DecoderPool only;
    return only;
}

PooledDecoders::PooledDecoders(const Decoders::Events& events)
    : events_(events), workers_(decoder_pool().count) {
    decoder_pool().on_reply = [this](unsigned worker, ByteView reply) {
        if (auto message = decode_from_worker(reply); message && worker < workers_.size())
            std::visit([&](auto& m) { on(workers_[worker], m); }, *message);
    };
}

PooledDecoders::~PooledDecoders() {
    decoder_pool().on_reply = nullptr;
}

void PooledDecoders::post(unsigned worker, const ToWorker& message) const {
    decoder_pool().post(worker, encode(message));
}

void PooledDecoders::post_cameras(const std::vector<wire::Camera>& cameras, bool anew) const {
    for (unsigned i = 0; i < workers_.size(); ++i) {
        std::vector<wire::Camera> own;
        for (const wire::Camera& camera : cameras)
            if (worker_of(camera.depth_stream) == i)
                own.push_back(camera);
        post(i, WorkerCameras{generation_, anew, std::move(own)});
    }
}

Duration PooledDecoders::session_offset() const {
    return events_.now() - steady_now();
}

void PooledDecoders::set_cameras(const std::vector<wire::Camera>& cameras) {
    generation_ = next_number();
    problem_told_ = false;
    for (Worker& worker : workers_) {
        worker.figures.clear();
        worker.colors.clear();
        worker.frames_wanted = false;
    }
    post_cameras(cameras, true);
}

void PooledDecoders::change_cameras(const std::vector<wire::Camera>& cameras) {
    post_cameras(cameras, false);
}

void PooledDecoders::set_settings(const std::vector<wire::StreamSetting>& settings) {
    problem_told_ = false;
    for (unsigned i = 0; i < workers_.size(); ++i)
        post(i, WorkerSettings{settings});  // those of others are unknown there
}

bool PooledDecoders::on_media(ByteView message, std::uint64_t connection) {
    const auto header = wire::parse_media_header(message);
    const unsigned index = header ? worker_of(header->stream) : 0;
    Worker& worker = workers_[index];
    if (worker.bytes_waiting + message.size() > most_bytes_waiting)
        return true;
    const bool at_once = worker.waiting.empty();
    worker.waiting.push_back({next_number(), connection, message.size(), at_once});
    worker.bytes_waiting += message.size();
    post(index, WorkerMedia{worker.waiting.back().number, session_offset(), message});
    return at_once;
}

std::vector<receive::StreamFigures> PooledDecoders::figures() {
    std::vector<receive::StreamFigures> all;
    for (unsigned i = 0; i < workers_.size(); ++i) {
        Worker& worker = workers_[i];
        post(i, WorkerFiguresWanted{session_offset(), std::exchange(worker.reset_wanted, false),
                                    std::exchange(worker.forget_wanted, false)});
        const auto aged = aged_by(events_.now() - worker.figures_at, worker.figures);
        all.insert(all.end(), aged.begin(), aged.end());
    }
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.stream < b.stream; });
    return all;
}

void PooledDecoders::reset_figures() {
    for (Worker& worker : workers_) {
        worker.reset_wanted = true;
        worker.figures = counted_anew(worker.figures);
    }
}

void PooledDecoders::forget_ages() {
    for (Worker& worker : workers_) {
        worker.forget_wanted = true;
        worker.figures = without_ages(std::move(worker.figures));
    }
}

void PooledDecoders::want_frames() {
    for (unsigned i = 0; i < workers_.size(); ++i)
        if (!std::exchange(workers_[i].frames_wanted, true))
            post(i, WorkerFramesWanted{});
}

void PooledDecoders::on(Worker& worker, const WorkerFrame& m) {
    if (m.generation != generation_)
        return;
    worker.frames_wanted = false;
    auto& color = worker.colors[m.camera];
    if (m.color_size.area() == 0)
        color.reset();
    else if (!m.same_color) {
        const std::shared_ptr<ColorImage> image = colors_.take();
        if (!copy_rows(m.color, m.color_size, *image))
            return;
        color = image;
    }
    const std::shared_ptr<receive::CameraFrame> frame = frames_.take();
    if (!copy_rows(m.depth, m.depth_size, frame->depth))
        return;
    frame->camera = m.camera;
    frame->number = m.number;
    frame->moment = m.moment;
    frame->times = m.times;
    frame->past = m.past;
    frame->color = color;
    events_.frame(frame, generation_);
}

void PooledDecoders::on(Worker&, const WorkerNeedsKey& m) {
    if (m.generation == generation_)
        events_.needs_key(m.stream, m.setting);
}

// The worker is at the next message, if there is one.
void PooledDecoders::on(Worker& worker, const WorkerDone& m) {
    if (worker.waiting.empty() || worker.waiting.front().number != m.number)
        return;
    worker.bytes_waiting -= worker.waiting.front().size;
    worker.waiting.pop_front();
    if (worker.waiting.empty())
        return;
    Waiting& next = worker.waiting.front();
    if (!std::exchange(next.is_taken, true))
        events_.taken(next.connection, next.size);
}

void PooledDecoders::on(Worker&, const WorkerProblem& m) {
    if (m.generation == generation_ && !std::exchange(problem_told_, true))
        events_.problem(m.text);
}

void PooledDecoders::on(Worker& worker, WorkerFigures& m) {
    // From before reset_figures() or forget_ages(), or of other cameras.
    if (worker.reset_wanted || worker.forget_wanted || m.generation != generation_)
        return;
    worker.figures = std::move(m.figures);
    worker.figures_at = events_.now();
}

}  // namespace theatron::client
