// SPDX-License-Identifier: Apache-2.0
// Is a camera all right? Notices when it falls silent, repeats itself, jumps in
// time or is gone, and says when to open it again. Pure: the time is passed in.
#pragma once

#include <cstdint>
#include <string>

#include "base/time.h"

namespace theatron::capture {

// What is wrong with a camera that is not live.
enum class Trouble : std::uint8_t {
    none,
    silent,     // no picture comes
    repeating,  // the same picture, or the same time, again and again
    time_jump,  // times that cannot be: in the future, falling, or long ago
    gone,       // unplugged, failed, or it cannot be opened
};
inline constexpr int trouble_kinds = 5;
const char* text_of(Trouble trouble);

// A sampled value of a depth picture that differs whenever a sensor's noise does.
// 0 if the picture shows nothing, which tells nothing.
struct PictureMark {
    std::uint64_t value = 0;
};

class CameraCare {
public:
    struct Options {
        Duration period = 33'333us;
        bool live = true;  // pictures are compared, and it is opened again (CameraInfo::live)
    };

    // Not a good picture for this long: stale. Longer for cameras that are slow by themselves.
    static constexpr Duration stale_after = 150ms;
    // A stale camera that still answers is opened again after this time, one that was
    // opened again and gave no picture yet after the second. One that never gave any
    // is left alone: it may wait for another camera that sets its pace.
    static constexpr Duration reopen_after = 1500ms, reopen_new_after = 10s;
    // Between attempts to open: twice as long after each failure.
    static constexpr Duration first_wait = 250ms, longest_wait = 5s;

    CameraCare(const Options& options, TimePoint opened);

    // A picture came. True if it is good; else it is to be passed over.
    bool on_frame(TimePoint captured, TimePoint delivered, PictureMark mark);
    void on_gone(std::string problem, TimePoint now);
    void on_opened(TimePoint now);
    void on_open_failed(std::string problem, TimePoint now);
    // Time goes by: call at least every 20 ms.
    void on_time(TimePoint now);

    bool stale() const { return trouble_ != Trouble::none; }
    Trouble trouble() const { return trouble_; }
    // One sentence for a person about gone cameras; empty otherwise.
    const std::string& problem() const { return problem_; }
    // The camera should be closed and opened now.
    bool wants_reopen(TimePoint now) const;
    // When the last good picture came, or since when it has been waited for.
    TimePoint last_good() const { return last_good_; }

    // Since the beginning.
    struct Figures {
        std::uint64_t repeated_frames = 0, jumped_frames = 0;
        std::uint64_t reopens = 0, failed_reopens = 0;
        std::uint64_t troubles[trouble_kinds] = {};  // how often, by kind
    };
    const Figures& figures() const { return figures_; }

private:
    Trouble judge(TimePoint captured, TimePoint delivered, PictureMark mark) const;
    void become(Trouble trouble);

    Options options_;
    Figures figures_;
    Trouble trouble_ = Trouble::none;
    Trouble last_fault_ = Trouble::silent;  // of the pictures since the last good one
    std::string problem_;
    bool open_ = true;
    bool any_frame_ = false;  // since it was opened
    bool ever_good_ = false;
    TimePoint last_good_;  // or when it was opened
    TimePoint last_captured_;
    PictureMark last_mark_;
    Duration wait_ = first_wait;
    TimePoint next_attempt_;
};

}  // namespace theatron::capture
