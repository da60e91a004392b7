// SPDX-License-Identifier: Apache-2.0
// What goes into a recording: takes the pictures of live streams as they come,
// gives those that can be decoded to the recorder, begins its segments, and knows
// what is missing.
//
// Pure but for the recorder: times are given. `now` is always the recording
// machine's own steady clock; the session's clock only goes into the file.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "record/recorder.h"
#include "record/stream_gate.h"

namespace theatron::record {

class Intake {
public:
    // A stream of which nothing came for so long, or for three of its pictures, is said to be
    // missing.
    static constexpr Duration silence_limit = std::chrono::milliseconds(1500);
    // What is missing is said again so often, as long as more gets lost.
    static constexpr Duration news_interval = std::chrono::seconds(1);

    // Nothing is created before the first picture.
    Intake(std::filesystem::path file, const Recorder::Options& options)
        : file_(std::move(file)), options_(options) {}

    // The two clocks now, and the wall's.
    struct Now {
        TimePoint local;
        ClockPair clock;
    };

    // These cameras are sent in these settings from now on. If anything but the numbers of the
    // settings is new, or `new_connection` (the session's clock and all numbers may be new), a
    // segment begins with the first key frame in one of the new settings. From any thread, in
    // order with take().
    void describe(std::vector<RecordedCamera> cameras, std::map<StreamId, SettingId> settings,
                  bool new_connection, TimePoint now);

    // Takes a whole media message of any stream. Never waits, never throws. True if the stream's
    // sender should be asked for a key frame. From any thread; messages of one stream in order.
    [[nodiscard]] bool take(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                            const std::string& filters, const Now& now);

    // The last file is not at its name any more: a new one begins with the next key frame, which is
    // asked for. Until then pictures still go into the last one, which may only be renamed.
    void begin_segment();

    // Of this camera nothing more will come, and nothing is missing.
    void on_end(CameraId camera);

    // Call some times a second: sentences for a person on what has gone missing since the last
    // call.
    std::vector<std::string> news(TimePoint now);

    struct Stream {
        StreamId id{};
        std::string camera;  // its name
        StreamGate::Figures figures;
        // Times without any picture, of more than silence_limit, and connections that were lost.
        std::uint64_t interruptions = 0;
        // When the first and the last picture came.
        std::optional<TimePoint> first, last;
        bool complete() const {
            return figures.recorded > 0 && figures.lost + figures.dropped + interruptions == 0;
        }
    };
    // All that were ever described. `now`: a stream that is silent is interrupted.
    std::vector<Stream> streams(TimePoint now) const;

    // When the newest picture that came was captured, in session time; of cameras that go on.
    // Nothing before the first one.
    std::optional<TimePoint> newest_captured() const;

    // Null before the first picture. It lives as long as the intake.
    Recorder* recorder() const;
    // Why the recording could not begin or has ended by itself, one sentence; empty if it has not.
    std::string problem() const;

private:
    struct Entry {
        Stream stream;
        StreamGate gate;
        Duration patience{};
        TimePoint heard;                    // of it, or of its description
        std::optional<TimePoint> captured;  // the last one recorded, in session time
        bool ended = false, silent = false;
        std::uint64_t said = 0;  // pictures that were said to be missing
    };
    struct Description {
        std::vector<RecordedCamera> cameras;
        std::map<StreamId, SettingId> settings;
        bool new_connection = false;
    };

    bool begin(Description description, const wire::MediaHeader& header, const Now& now);
    bool can_begin_with(const Entry& entry) const;
    void note_time(Entry& entry, const wire::MediaHeader& header, TimePoint now);

    const std::filesystem::path file_;
    const Recorder::Options options_;

    mutable std::mutex mutex_;  // guards all below
    std::unique_ptr<Recorder> recorder_;
    std::string problem_;
    std::map<StreamId, Entry> entries_;
    Description current_;                 // of the newest segment
    std::optional<Description> pending_;  // not begun yet
    bool wants_segment_ = false;
    TimePoint looked_, said_;
    bool disk_is_late_ = false;
};

}  // namespace theatron::record
