// SPDX-License-Identifier: Apache-2.0
// Decoders over the workers of a browser's page: functions and events are those of Decoders.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "client/decoder_messages.h"
#include "client/decoders.h"

namespace theatron::client {

// For the page's one thread. Only one may live at a time: it takes decoder_pool()'s replies.
class PooledDecoders {
public:
    explicit PooledDecoders(const Decoders::Events& events);
    ~PooledDecoders();

    void set_cameras(const std::vector<wire::Camera>& cameras);
    void change_cameras(const std::vector<wire::Camera>& cameras);
    void set_settings(const std::vector<wire::StreamSetting>& settings);
    bool on_media(ByteView message, std::uint64_t connection);
    std::vector<receive::StreamFigures> figures();
    void reset_figures();
    void forget_ages();
    void want_frames();

    std::uint64_t generation() const { return generation_; }

private:
    // Bytes that may wait for one worker; messages beyond them are dropped. A sender that obeys
    // flow control never reaches this limit.
    static constexpr std::size_t most_bytes_waiting = std::size_t(64) << 20;

    // A message that a worker has not decoded yet; the first of them is being decoded.
    struct Waiting {
        std::uint64_t number = 0, connection = 0;
        std::size_t size = 0;
        bool is_taken = false;
    };
    struct Worker {
        std::deque<Waiting> waiting;
        std::size_t bytes_waiting = 0;
        std::vector<receive::StreamFigures> figures;
        TimePoint figures_at;
        bool reset_wanted = false, forget_wanted = false;
        bool frames_wanted = false;  // none has come since want_frames()
        std::map<CameraId, std::shared_ptr<const ColorImage>> colors;  // last that came
    };

    unsigned worker_of(StreamId stream) const {
        return unsigned(camera_of(stream)) % unsigned(workers_.size());
    }
    void post(unsigned worker, const ToWorker& message) const;
    void post_cameras(const std::vector<wire::Camera>& cameras, bool anew) const;
    Duration session_offset() const;

    void on(Worker& worker, const WorkerFrame& m);
    void on(Worker& worker, const WorkerNeedsKey& m);
    void on(Worker& worker, const WorkerDone& m);
    void on(Worker& worker, const WorkerProblem& m);
    void on(Worker& worker, WorkerFigures& m);

    const Decoders::Events& events_;
    std::vector<Worker> workers_;
    std::uint64_t generation_ = 0;
    bool problem_told_ = false;
    Pool<receive::CameraFrame> frames_;
    Pool<ColorImage> colors_;
};

}  // namespace theatron::client
