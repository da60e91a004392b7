// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_care.h"

#include <algorithm>

namespace theatron::capture {
namespace {

// Pictures cannot be later than their arrival, except for the error of the estimated relation
// between the clocks.
constexpr Duration most_ahead = 20ms;
// A busy machine may fetch a picture late, but not by more than this.
constexpr Duration most_behind = 1s;

}  // namespace

const char* text_of(Trouble trouble) {
    switch (trouble) {
        case Trouble::none:
            return "none";
        case Trouble::silent:
            return "silent";
        case Trouble::repeating:
            return "repeating";
        case Trouble::time_jump:
            return "time_jump";
        case Trouble::gone:
            return "gone";
    }
    return "unknown";
}

CameraCare::CameraCare(const Options& options, TimePoint opened)
    : options_(options), last_good_(opened) {}

Trouble CameraCare::judge(TimePoint captured, TimePoint delivered, PictureMark mark) const {
    const bool is_late = !options_.patient && captured < delivered - most_behind;
    if (captured > delivered + most_ahead || is_late)
        return Trouble::time_jump;
    if (!any_frame_)
        return Trouble::none;
    if (captured < last_captured_)
        return Trouble::time_jump;
    const bool same_picture = options_.live && mark.value != 0 && mark.value == last_mark_.value;
    return captured == last_captured_ || same_picture ? Trouble::repeating : Trouble::none;
}

bool CameraCare::on_frame(TimePoint captured, TimePoint delivered, PictureMark mark) {
    if (!open_)
        return false;
    const Trouble fault = judge(captured, delivered, mark);
    if (fault != Trouble::none) {
        ++(fault == Trouble::repeating ? figures_.repeated_frames : figures_.jumped_frames);
        last_fault_ = fault;
        on_time(delivered);
        return false;
    }
    any_frame_ = ever_good_ = true;
    last_captured_ = captured;
    last_mark_ = mark;
    last_good_ = delivered;
    last_fault_ = Trouble::silent;
    wait_ = first_wait;
    problem_.clear();
    become(Trouble::none);
    return true;
}

void CameraCare::on_gone(std::string problem, TimePoint now) {
    open_ = false;
    problem_ = std::move(problem);
    become(Trouble::gone);
    next_attempt_ = now + wait_;
}

void CameraCare::on_opened(TimePoint now) {
    ++figures_.reopens;
    open_ = true;
    any_frame_ = false;
    last_fault_ = Trouble::silent;
    // Remains stale until its first picture; the wait for it begins now.
    last_good_ = now;
}

void CameraCare::on_open_failed(std::string problem, TimePoint now) {
    ++figures_.failed_reopens;
    wait_ = std::min(2 * wait_, longest_wait);
    on_gone(std::move(problem), now);
}

void CameraCare::on_time(TimePoint now) {
    const Duration patience = std::max(stale_after, options_.period * 5 / 2);
    if (open_ && !options_.patient && !stale() && now - last_good_ > patience)
        become(last_fault_);
}

void CameraCare::become(Trouble trouble) {
    if (trouble == trouble_)
        return;
    trouble_ = trouble;
    ++figures_.troubles[std::size_t(trouble)];
}

bool CameraCare::wants_reopen(TimePoint now) const {
    if (!options_.live || !stale())
        return false;
    if (!open_)
        return now >= next_attempt_;
    return ever_good_ && now - last_good_ >= (any_frame_ ? reopen_after : reopen_new_after);
}

}  // namespace theatron::capture
