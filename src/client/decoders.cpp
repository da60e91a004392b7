// SPDX-License-Identifier: Apache-2.0
#include "client/decoders.h"

#include <algorithm>

#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::client {

Decoders::Decoders(const receive::Receiver::Events& events)
    : now_(events.now), needs_key_(events.needs_key) {
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
            if (!contain("decode", [&] { (void)worker.receiver.on_media(message, now_()); }))
                ask_for_key(message);
        }
        lock.lock();
        worker.busy = false;
        worker.bytes_waiting -= message.size();
        if (worker.bytes_spare + message.capacity() <= most_bytes_spare) {
            worker.bytes_spare += message.capacity();
            worker.spare.push_back(std::move(message));
        }
        worker.changed.notify_all();
    }
}

// The picture is lost, and what its decoder holds may be anything.
void Decoders::ask_for_key(ByteView message) {
    const auto header = wire::parse_media_header(message);
    if (header && needs_key_)
        (void)contain("decode", [&] { needs_key_(header->stream, header->setting); });
}

void Decoders::drain(Worker& worker) {
    std::unique_lock lock(worker.mutex);
    worker.changed.wait(lock, [&] { return worker.waiting.empty() && !worker.busy; });
}

void Decoders::set_cameras(const std::vector<wire::Camera>& cameras) {
    max_sizes_.clear();
    for (const wire::Camera& camera : cameras)
        for (const StreamId stream : {camera.depth_stream, camera.color_stream})
            max_sizes_[stream] = receive::max_media_size(camera, stream);
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
    if (header) {
        const auto known = max_sizes_.find(header->stream);
        if (known == max_sizes_.end())
            return;
        // Without its payload it is refused and counted like any other damage.
        if (message.size() > known->second)
            message = message.first(wire::media_header_size);
    } else {
        message = message.first(std::min(message.size(), wire::media_header_size));
    }
    const std::size_t share = most_bytes_waiting / workers_.size();
    std::unique_lock lock(worker.mutex);
    worker.changed.wait(lock, [&] {
        return worker.waiting.size() < most_waiting &&
               (worker.bytes_waiting == 0 || worker.bytes_waiting + message.size() <= share);
    });
    Bytes copy;
    if (!worker.spare.empty()) {
        copy = std::move(worker.spare.back());
        worker.spare.pop_back();
        worker.bytes_spare -= copy.capacity();
    }
    copy.assign(message.begin(), message.end());
    worker.bytes_waiting += copy.size();
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

}  // namespace theatron::client
