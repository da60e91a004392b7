// SPDX-License-Identifier: Apache-2.0
// receive::Receiver on several threads: each decodes some of the cameras, so that
// many cameras use all cores of a viewer.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "receive/receiver.h"

namespace theatron::client {

class Decoders {
public:
    // The events come from the decoding threads; `now` must be given.
    explicit Decoders(const receive::Receiver::Events& events);
    ~Decoders();

    // As in Receiver, from one thread. Both wait until what came before is decoded.
    void set_cameras(const std::vector<wire::Camera>& cameras);
    void set_settings(const std::vector<wire::StreamSetting>& settings);

    // Takes a copy. Waits while too much is undecoded, so that the sender notices. Messages that
    // no camera's pictures can need are left out (receive::max_media_size).
    void on_media(ByteView message);

    // From any thread.
    std::vector<receive::StreamFigures> figures();
    void reset_figures();

private:
    // About what the cameras of one thread send at once. More would only make frames older,
    // and keep the host encoding what nobody decodes in time.
    static constexpr std::size_t most_waiting = 10;
    // Limit for all threads together, in bytes. A message that is larger waits alone.
    static constexpr std::size_t most_bytes_waiting = std::size_t(128) << 20;
    // Memory of messages that is kept for the next ones, of each thread.
    static constexpr std::size_t most_bytes_spare = std::size_t(8) << 20;

    struct Worker {
        explicit Worker(const receive::Receiver::Events& events) : receiver(events) {}

        std::mutex receiver_mutex;
        receive::Receiver receiver;

        std::mutex mutex;  // guards all below
        std::condition_variable changed;
        std::deque<Bytes> waiting;
        std::size_t bytes_waiting = 0;  // of these, and of the one that is being decoded
        std::vector<Bytes> spare;       // memory of messages that were decoded
        std::size_t bytes_spare = 0;
        bool busy = false;
        bool stopping = false;
        std::thread thread;
    };
    void run(Worker& worker);
    void ask_for_key(ByteView message);
    static void drain(Worker& worker);
    Worker& worker_of(StreamId stream) {
        return *workers_[std::size_t(camera_of(stream)) % workers_.size()];
    }

    std::function<TimePoint()> now_;
    std::map<StreamId, std::size_t> max_sizes_;  // of messages; who calls on_media()
    std::function<void(StreamId, SettingId)> needs_key_;
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace theatron::client
