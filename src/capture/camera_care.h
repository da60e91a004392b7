// SPDX-License-Identifier: Apache-2.0
// The state of a camera: detects that it is silent, repeats pictures, jumps in time or is
// gone, and decides when to open it again. Pure: the time is passed in.
#pragma once

#include <cstdint>
#include <string>

#include "base/time.h"

namespace theatron::capture {

// The problem of a camera that is stale.
enum class Trouble : std::uint8_t {
    none,
    silent,     // no pictures come
    repeating,  // the same picture, or the same time, again and again
    time_jump,  // impossible times: in the future, decreasing, or long ago
    gone,       // unplugged, failed, or it cannot be opened
};
inline constexpr int trouble_kinds = 5;
const char* text_of(Trouble trouble);

// A hash of sampled depth pixels: equal hashes mean a repeated picture. 0 for a picture without
// measurements, which is never compared.
struct PictureMark {
    std::uint64_t value = 0;
};

class CameraCare {
public:
    struct Options {
        Duration period = 33'333us;
        bool live = true;  // as CameraInfo::live: compare pictures, open again
        // Its pictures are waited for: none is too late, and it is never silent.
        bool patient = false;
    };

    // A camera is stale after this time without a good picture; later for slow cameras.
    static constexpr Duration stale_after = 150ms;
    // Time until a stale camera that still responds is opened again: the second one for a
    // camera that was opened again and gave no picture since. A camera that never gave a
    // picture is not opened again: it may wait for the camera that synchronises it.
    static constexpr Duration reopen_after = 1500ms, reopen_new_after = 10s;
    // Time between attempts to open; doubles after each failure.
    static constexpr Duration first_wait = 250ms, longest_wait = 5s;

    CameraCare(const Options& options, TimePoint opened);

    // A picture came. True if it is good; otherwise it must be discarded.
    bool on_frame(TimePoint captured, TimePoint delivered, PictureMark mark);
    void on_gone(std::string problem, TimePoint now);
    void on_opened(TimePoint now);
    void on_open_failed(std::string problem, TimePoint now);
    // Updates the state; call at least every 20 ms.
    void on_time(TimePoint now);

    bool stale() const { return trouble_ != Trouble::none; }
    Trouble trouble() const { return trouble_; }
    // One sentence for the user about a camera that is gone; empty otherwise.
    const std::string& problem() const { return problem_; }
    // True if the camera should be closed and opened now.
    bool wants_reopen(TimePoint now) const;
    // The arrival of the last good picture, or the start of the wait for the first one.
    TimePoint last_good() const { return last_good_; }

    // Counts since construction.
    struct Figures {
        std::uint64_t repeated_frames = 0, jumped_frames = 0;
        std::uint64_t reopens = 0, failed_reopens = 0;
        std::uint64_t troubles[trouble_kinds] = {};  // by kind
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
    bool any_frame_ = false;  // since the camera was opened
    bool ever_good_ = false;
    TimePoint last_good_;  // or the time of opening
    TimePoint last_captured_;
    PictureMark last_mark_;
    Duration wait_ = first_wait;
    TimePoint next_attempt_;
};

}  // namespace theatron::capture
