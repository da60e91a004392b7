// SPDX-License-Identifier: Apache-2.0
#include "client/decoders.h"

#include <algorithm>

#include "base/error.h"
#include "base/fault.h"
#include "base/thread_name.h"
#include "client/participant_figures.h"

namespace theatron::client {

Decoders::Decoders(Events events) : events_(std::move(events)) {
    const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
    for (unsigned i = 0; i < cores; ++i)
        workers_.push_back(std::make_unique<Worker>(receiver_events(i)));
    for (const auto& worker : workers_)
        worker->thread = std::thread([this, own = worker.get()] { run(*own); });
}

Decoders::~Decoders() {
    for (const auto& worker : workers_) {
        {
            const std::lock_guard lock(worker->mutex);
            worker->stopping = true;
        }
        worker->changed.notify_all();
        worker->thread.join();
    }
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

void Decoders::run(Worker& worker) {
    name_this_thread("decode");
    std::unique_lock lock(worker.mutex);
    while (true) {
        worker.changed.wait(lock, [&] {
            return !worker.waiting.empty() || worker.stopping || worker.figures_wanted;
        });
        if (worker.stopping)
            return;
        if (worker.figures_wanted)
            note_figures(worker, lock);
        if (worker.waiting.empty())
            continue;
        Work work = std::move(worker.waiting.front());
        worker.waiting.pop_front();
        auto* message = std::get_if<Message>(&work);
        if (message)
            worker.bytes_waiting -= message->cost();
        worker.busy = true;
        lock.unlock();
        // The receiver counts damage and requests a key frame.
        if (!contain("decode", [&] { work_on(worker, work); }) && message)
            // The picture is lost, and the state of its decoder is undefined.
            if (const auto header = wire::parse_media_header(message->bytes))
                (void)contain("decode",
                              [&] { events_.needs_key(header->stream, header->setting); });
        lock.lock();
        worker.busy = false;
        if (message)
            keep_memory(worker, std::move(message->bytes));
    }
}

void Decoders::note_figures(Worker& worker, std::unique_lock<std::mutex>& lock) {
    worker.figures_wanted = false;
    const bool reset = std::exchange(worker.reset_wanted, false);
    const bool forget = std::exchange(worker.forget_wanted, false);
    worker.busy = true;
    lock.unlock();
    std::vector<receive::StreamFigures> figures;
    const TimePoint now = events_.now();
    (void)contain("decode", [&] {
        if (reset)
            worker.receiver.reset_figures();
        if (forget)
            worker.receiver.forget_ages();
        figures = worker.receiver.figures(now);
    });
    lock.lock();
    worker.busy = false;
    // Called meanwhile: these figures are from before it.
    if (worker.reset_wanted || worker.forget_wanted)
        return;
    worker.figures = std::move(figures);
    worker.figures_at = now;
}

void Decoders::work_on(Worker& worker, Work& work) {
    if (auto* message = std::get_if<Message>(&work)) {
        if (!message->is_taken)
            events_.taken(message->connection, message->bytes.size());
        (void)worker.receiver.on_media(message->bytes, events_.now());
    } else if (auto* cameras = std::get_if<Cameras>(&work)) {
        worker.generation = cameras->generation;
        worker.receiver.set_cameras(cameras->cameras);
    } else if (auto* settings = std::get_if<Settings>(&work)) {
        try {
            worker.receiver.set_settings(settings->settings);
        } catch (const Error& e) {
            if (!settings->problem_told->test_and_set())
                events_.problem(e.what());
        }
    }
}

void Decoders::keep_memory(Worker& worker, Bytes memory) {
    if (worker.bytes_spare + memory.capacity() > most_bytes_spare)
        return;
    worker.bytes_spare += memory.capacity();
    worker.spare.push_back(std::move(memory));
}

void Decoders::queue(Worker& worker, Work work) {
    {
        const std::lock_guard lock(worker.mutex);
        worker.waiting.push_back(std::move(work));
    }
    worker.changed.notify_all();
}

void Decoders::note_sizes(const std::vector<wire::Camera>& cameras) {
    max_sizes_.clear();
    for (const wire::Camera& camera : cameras)
        for (const StreamId stream : {camera.depth_stream, camera.color_stream})
            max_sizes_[stream] = receive::max_media_size(camera, stream);
}

std::vector<wire::Camera> Decoders::cameras_of(const Worker& worker,
                                               const std::vector<wire::Camera>& cameras) {
    std::vector<wire::Camera> own;
    for (const wire::Camera& camera : cameras)
        if (&worker_of(camera.depth_stream) == &worker)
            own.push_back(camera);
    return own;
}

std::uint64_t Decoders::set_cameras(const std::vector<wire::Camera>& cameras) {
    ++generation_;
    note_sizes(cameras);
    for (const auto& worker : workers_) {
        std::deque<Work> left_out;
        {
            const std::lock_guard lock(worker->mutex);
            left_out.swap(worker->waiting);
            worker->bytes_waiting = 0;
            worker->figures.clear();
        }
        for (const Work& work : left_out)
            if (const auto* message = std::get_if<Message>(&work); message && !message->is_taken)
                events_.taken(message->connection, message->bytes.size());
        // No decoder is kept: numbers of settings may start again.
        queue(*worker, Cameras{{}, generation_});
        queue(*worker, Cameras{cameras_of(*worker, cameras), generation_});
    }
    return generation_;
}

void Decoders::change_cameras(const std::vector<wire::Camera>& cameras) {
    note_sizes(cameras);
    for (const auto& worker : workers_)
        queue(*worker, Cameras{cameras_of(*worker, cameras), generation_});
}

void Decoders::set_settings(const std::vector<wire::StreamSetting>& settings) {
    const auto problem_told = std::make_shared<std::atomic_flag>();
    for (const auto& worker : workers_)
        queue(*worker, Settings{settings, problem_told});  // those of others are unknown there
}

bool Decoders::on_media(Bytes& message, std::uint64_t connection) {
    const auto header = wire::parse_media_header(message);
    const auto known = header ? max_sizes_.find(header->stream) : max_sizes_.end();
    if (header && known == max_sizes_.end())
        return true;
    Worker& worker = header ? worker_of(header->stream) : *workers_.front();
    // Without its payload it is refused and counted like any other damage.
    if (!header || message.size() > known->second) {
        message.resize(std::min(message.size(), wire::media_header_size));
        message.shrink_to_fit();
    }
    bool at_once = false;
    {
        const std::lock_guard lock(worker.mutex);
        at_once = worker.waiting.empty() && !worker.busy;
        Message work{std::move(message), connection, at_once};
        message = {};
        if (!at_once && worker.bytes_waiting + work.cost() > most_bytes_waiting / workers_.size())
            return true;
        worker.bytes_waiting += work.cost();
        worker.waiting.push_back(std::move(work));
        if (!worker.spare.empty()) {
            message = std::move(worker.spare.back());
            worker.spare.pop_back();
            worker.bytes_spare -= message.capacity();
        }
    }
    worker.changed.notify_all();
    return at_once;
}

std::vector<receive::StreamFigures> Decoders::figures() {
    std::vector<receive::StreamFigures> all;
    const TimePoint now = events_.now();
    for (const auto& worker : workers_) {
        {
            const std::lock_guard lock(worker->mutex);
            worker->figures_wanted = true;
            const auto aged = aged_by(now - worker->figures_at, worker->figures);
            all.insert(all.end(), aged.begin(), aged.end());
        }
        worker->changed.notify_all();
    }
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.stream < b.stream; });
    return all;
}

void Decoders::reset_figures() {
    for (const auto& worker : workers_) {
        {
            const std::lock_guard lock(worker->mutex);
            worker->figures_wanted = worker->reset_wanted = true;
            worker->figures = counted_anew(worker->figures);
        }
        worker->changed.notify_all();
    }
}

void Decoders::want_frames() {}

void Decoders::forget_ages() {
    for (const auto& worker : workers_) {
        {
            const std::lock_guard lock(worker->mutex);
            worker->figures_wanted = worker->forget_wanted = true;
            worker->figures = without_ages(std::move(worker->figures));
        }
        worker->changed.notify_all();
    }
}

}  // namespace theatron::client
