// SPDX-License-Identifier: Apache-2.0
#include "decoders.h"

#include <algorithm>

#include "base/thread_name.h"

namespace theatron::app {

Decoders::Decoders(const receive::Receiver::Events& events) : now_(events.now) {
    const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
    for (unsigned i = 0; i < cores; ++i) {
        workers_.push_back(std::make_unique<Worker>(events));
        workers_.back()->thread =
            std::thread([this, worker = workers_.back().get()] { run(*worker); });
    }
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

void Decoders::run(Worker& worker) {
    name_this_thread("decode");
    std::unique_lock lock(worker.mutex);
    while (true) {
        worker.changed.wait(lock, [&] { return !worker.waiting.empty() || worker.stopping; });
        if (worker.stopping)
            return;
        Bytes message = std::move(worker.waiting.front());
        worker.waiting.pop_front();
        worker.busy = true;
        lock.unlock();
        {
            const std::lock_guard receiving(worker.receiver_mutex);
            // Damage is counted there, and a key frame asked for.
            (void)worker.receiver.on_media(message, now_());
        }
        lock.lock();
        worker.busy = false;
        worker.spare.push_back(std::move(message));
        worker.changed.notify_all();
    }
}

void Decoders::drain(Worker& worker) {
    std::unique_lock lock(worker.mutex);
    worker.changed.wait(lock, [&] { return worker.waiting.empty() && !worker.busy; });
}

void Decoders::set_cameras(const std::vector<wire::Camera>& cameras) {
    for (const auto& worker : workers_) {
        std::vector<wire::Camera> own;
        for (const wire::Camera& camera : cameras)
            if (&worker_of(camera.depth_stream) == worker.get())
                own.push_back(camera);
        drain(*worker);
        const std::lock_guard lock(worker->receiver_mutex);
        worker->receiver.set_cameras(own);
    }
}

void Decoders::set_settings(const std::vector<wire::StreamSetting>& settings) {
    for (const auto& worker : workers_) {
        drain(*worker);
        const std::lock_guard lock(worker->receiver_mutex);
        worker->receiver.set_settings(settings);  // those of others are unknown there
    }
}

void Decoders::on_media(ByteView message) {
    const auto header = wire::parse_media_header(message);
    Worker& worker = header ? worker_of(header->stream) : *workers_.front();
    std::unique_lock lock(worker.mutex);
    worker.changed.wait(lock, [&] { return worker.waiting.size() < most_waiting; });
    Bytes copy;
    if (!worker.spare.empty()) {
        copy = std::move(worker.spare.back());
        worker.spare.pop_back();
    }
    copy.assign(message.begin(), message.end());
    worker.waiting.push_back(std::move(copy));
    lock.unlock();
    worker.changed.notify_all();
}

std::vector<receive::StreamFigures> Decoders::figures() {
    std::vector<receive::StreamFigures> all;
    for (const auto& worker : workers_) {
        const std::lock_guard lock(worker->receiver_mutex);
        const auto own = worker->receiver.figures(now_());
        all.insert(all.end(), own.begin(), own.end());
    }
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.stream < b.stream; });
    return all;
}

void Decoders::reset_figures() {
    for (const auto& worker : workers_) {
        const std::lock_guard lock(worker->receiver_mutex);
        worker->receiver.reset_figures();
    }
}

}  // namespace theatron::app
