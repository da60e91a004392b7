// SPDX-License-Identifier: Apache-2.0
#include "synthetic/played_part.h"

#include <algorithm>

namespace theatron::synthetic {
namespace {

// Cameras ask for a picture at slightly different times, and one may be late.
constexpr std::size_t kept_turns = 4;

}  // namespace

std::size_t PlayedPart::add_camera(std::size_t frames) {
    const std::lock_guard lock(mutex_);
    frames_.push_back(frames);
    return frames_.size() - 1;
}

void PlayedPart::note_frames(std::size_t camera, std::size_t frames) {
    const std::lock_guard lock(mutex_);
    frames_.at(camera) = frames;
}

PlayedPart::Turn PlayedPart::next_turn(std::uint64_t begin) const {
    const std::size_t frames = frames_.empty() ? whole_ : *std::ranges::min_element(frames_);
    if (frames >= whole_)
        return {begin, whole_, whole_};
    // The first frame comes once, at the beginning of the next turn.
    return {begin, frames, std::max<std::size_t>(1, 2 * (frames - 1))};
}

std::uint64_t PlayedPart::newest() {
    const std::lock_guard lock(mutex_);
    return newest_;
}

std::size_t PlayedPart::frame_at(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    newest_ = std::max(newest_, number);
    if (turns_.empty())
        turns_.push_back(next_turn(0));
    while (number >= turns_.back().begin + turns_.back().pictures)
        turns_.push_back(next_turn(turns_.back().begin + turns_.back().pictures));
    while (turns_.size() > kept_turns)
        turns_.pop_front();
    const auto turn =
        std::ranges::find_if(turns_, [&](const Turn& t) { return number < t.begin + t.pictures; });
    if (number < turn->begin)
        return 0;
    const auto at = std::size_t(number - turn->begin);
    return at < turn->frames ? at : turn->pictures - at;
}

}  // namespace theatron::synthetic
