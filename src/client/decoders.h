// SPDX-License-Identifier: Apache-2.0
// receive::Receiver on several threads: each decodes some of the cameras, so that
// many cameras use all cores of a viewer. The caller never waits for a decoder. In a browser
// the page's workers are used (decoders_web.cpp).
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "receive/receiver.h"

namespace theatron::client {

class Decoders {
public:
    // All are called from decoding threads.
    struct Events {
        // `generation` is what set_cameras() returned for the cameras of the frame.
        std::function<void(receive::CameraFramePtr, std::uint64_t generation)> frame;
        std::function<void(StreamId, SettingId)> needs_key;
        // A message for which on_media() returned false is no longer waiting.
        std::function<void(std::uint64_t connection, std::size_t bytes)> taken;
        // One sentence: this build cannot decode a codec that the host uses.
        std::function<void(const std::string&)> problem;
        std::function<TimePoint()> now;  // session time
    };
    explicit Decoders(Events events);
    ~Decoders();

    // The functions below are for one thread. None of them waits for decoding.

    // As in Receiver, in the order of the calls; messages that still wait are dropped.
    // Returns the generation, a number that is new each time.
    std::uint64_t set_cameras(const std::vector<wire::Camera>& cameras);
    // Some cameras came or left: messages that wait for the others, and their decoders, stay.
    void change_cameras(const std::vector<wire::Camera>& cameras);
    void set_settings(const std::vector<wire::StreamSetting>& settings);

    // Moves the message away and leaves other memory for the next. True if a thread decodes it at
    // once, or if it is dropped: because it belongs to no camera, or because more than
    // most_bytes_waiting would wait. False: Events::taken follows, with this `connection`, which
    // may be any number.
    bool on_media(Bytes& message, std::uint64_t connection);

    // Figures of a short time ago, except for age_now_ms, which is of now.
    std::vector<receive::StreamFigures> figures();
    void reset_figures();
    // The session's time has become known: earlier ages meant nothing.
    void forget_ages();
    // In a browser's workers, whose frames cost the page a copy: from the first call on,
    // Events::frame follows for the next frame of each camera alone, again after each call.
    // Elsewhere for all.
    void want_frames();

private:
    // Bytes that may wait for all threads together; messages beyond them are dropped. A sender
    // that obeys flow control never reaches this limit.
    static constexpr std::size_t most_bytes_waiting = std::size_t(128) << 20;
    // Estimated memory of a message beside its bytes.
    static constexpr std::size_t message_overhead = 256;
    // Memory of messages that is kept for the next ones, of each thread.
    static constexpr std::size_t most_bytes_spare = std::size_t(8) << 20;

    struct Message {
        Bytes bytes;
        std::uint64_t connection = 0;
        bool is_taken = false;  // on_media() returned true for it
        std::size_t cost() const { return bytes.capacity() + message_overhead; }
    };
    struct Cameras {
        std::vector<wire::Camera> cameras;
        std::uint64_t generation = 0;
    };
    struct Settings {
        std::vector<wire::StreamSetting> settings;
        std::shared_ptr<std::atomic_flag> problem_told;
    };
    using Work = std::variant<Message, Cameras, Settings>;

    struct Worker {
        explicit Worker(receive::Receiver::Events events) : receiver(std::move(events)) {}

        // The worker's thread only.
        receive::Receiver receiver;
        std::uint64_t generation = 0;

        std::mutex mutex;  // guards all below
        std::condition_variable changed;
        std::deque<Work> waiting;
        std::size_t bytes_waiting = 0;  // cost of these messages
        std::vector<Bytes> spare;       // memory of messages that were decoded
        std::size_t bytes_spare = 0;
        bool busy = false;
        bool stopping = false;
        bool figures_wanted = false, reset_wanted = false, forget_wanted = false;
        std::vector<receive::StreamFigures> figures;
        TimePoint figures_at;
        std::thread thread;
    };
    receive::Receiver::Events receiver_events(std::size_t worker);
    void run(Worker& worker);
    void note_figures(Worker& worker, std::unique_lock<std::mutex>& lock);
    void work_on(Worker& worker, Work& work);
    void decode(Worker& worker, const Message& message);
    static void keep_memory(Worker& worker, Bytes memory);
    void queue(Worker& worker, Work work);
    // Notes the sizes of messages, and returns the cameras of one worker.
    void note_sizes(const std::vector<wire::Camera>& cameras);
    std::vector<wire::Camera> cameras_of(const Worker& worker,
                                         const std::vector<wire::Camera>& cameras);
    Worker& worker_of(StreamId stream) {
        return *workers_[std::size_t(camera_of(stream)) % workers_.size()];
    }

    const Events events_;
    std::uint64_t generation_ = 0;
    std::map<StreamId, std::size_t> max_sizes_;  // of messages
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace theatron::client
