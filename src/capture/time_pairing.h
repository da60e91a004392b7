// SPDX-License-Identifier: Apache-2.0
// Pairs the depth and colour pictures of one moment, from two tracks that are read one after
// the other, or from a camera that delivers them separately. Pure: it depends on times only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "base/time.h"

namespace theatron::capture {

// Payload: the type of a picture, movable.
template <class Payload>
class TimePairing {
public:
    struct Picture {
        Duration time{};
        Payload payload;
    };
    struct Pair {
        Picture depth;
        std::optional<Picture> color;
    };

    // Limits the memory if one of the tracks stops.
    static constexpr std::size_t usual_max_waiting = 30;

    // A colour picture belongs to a depth picture if they are at most `tolerance` apart: half
    // of the nominal time between frames. At most `max_colors` wait for theirs.
    explicit TimePairing(Duration tolerance, std::size_t max_colors = usual_max_waiting)
        : tolerance_(tolerance), max_colors_(max_colors) {}

    // For a live camera, where waiting adds delay: a colour picture at most `certain` away is
    // accepted without waiting for the next one, and at most `max_waiting` depth pictures wait
    // for theirs.
    TimePairing(Duration tolerance, Duration certain, std::size_t max_waiting)
        : tolerance_(tolerance), certain_(certain), max_waiting_(max_waiting) {}

    // Times of one track must not decrease; a picture older than the previous one is left out.
    void add_depth(Picture picture) { add(depth_, std::move(picture)); }
    void add_color(Picture picture) { add(color_, std::move(picture)); }
    // Marks the end: no more pictures will come.
    void finish() { finished_ = true; }

    // The next depth picture with the nearest colour picture, as soon as no nearer one can
    // come. Each colour picture is used once.
    std::optional<Pair> take() {
        if (depth_.empty() || !is_decided())
            return std::nullopt;
        Pair pair{std::move(depth_.front()), std::nullopt};
        depth_.pop_front();
        const Duration time = pair.depth.time;
        while (!color_.empty() && color_.front().time < time - tolerance_)
            drop_color();
        while (color_.size() > 1 &&
               distance(color_[1].time, time) <= distance(color_[0].time, time))
            drop_color();
        if (!color_.empty() && distance(color_.front().time, time) <= tolerance_) {
            pair.color = std::move(color_.front());
            color_.pop_front();
        } else if (forget(colors_dropped_, time)) {
            ++left_out_.apart;
        } else {
            remember(depth_alone_, time);
        }
        return pair;
    }

    // Pictures that were left out.
    struct LeftOut {
        std::uint64_t backward = 0;  // older than the one before
        std::uint64_t apart = 0;     // colour that came too long before or after its depth
    };
    const LeftOut& left_out() const { return left_out_; }
    // Colour that belongs to no depth, as a faster track has it; at the end those that wait, too.
    std::uint64_t colors_alone() const {
        return colors_alone_ + (finished_ && depth_.empty() ? color_.size() : 0);
    }

private:
    static constexpr std::size_t most_remembered = 1024;

    static Duration distance(Duration a, Duration b) { return a < b ? b - a : a - b; }

    void add(std::deque<Picture>& track, Picture picture) {
        const bool is_color = &track == &color_;
        std::optional<Duration>& newest = is_color ? newest_color_ : newest_depth_;
        if (newest && picture.time < *newest) {
            ++left_out_.backward;
            return;
        }
        newest = picture.time;
        // Its depth was taken without it.
        if (is_color && forget(depth_alone_, picture.time)) {
            ++left_out_.apart;
            return;
        }
        track.push_back(std::move(picture));
        if (is_color && color_.size() > max_colors_) {
            remember(colors_dropped_, color_.front().time);
            color_.pop_front();
        }
    }
    void drop_color() {
        ++colors_alone_;
        color_.pop_front();
    }
    static void remember(std::deque<Duration>& times, Duration time) {
        times.push_back(time);
        if (times.size() > most_remembered)
            times.pop_front();
    }
    // True if there is a picture that belongs to this time; it and those before it are forgotten.
    bool forget(std::deque<Duration>& times, Duration time) const {
        const auto found = std::find_if(times.begin(), times.end(), [&](Duration other) {
            return distance(other, time) <= tolerance_;
        });
        if (found == times.end())
            return false;
        times.erase(times.begin(), found + 1);
        return true;
    }
    bool is_decided() const {
        const Duration time = depth_.front().time;
        for (const Picture& color : color_)
            if (distance(color.time, time) <= certain_)
                return true;
        return finished_ || depth_.size() > max_waiting_ ||
               (!color_.empty() && color_.back().time >= time + tolerance_);
    }

    Duration tolerance_;
    std::size_t max_colors_ = usual_max_waiting;
    Duration certain_{-1};  // negative: always wait for the next picture
    std::size_t max_waiting_ = usual_max_waiting;
    std::deque<Picture> depth_, color_;
    std::optional<Duration> newest_depth_, newest_color_;
    std::deque<Duration> depth_alone_,
        colors_dropped_;  // their times: taken without colour, unused
    LeftOut left_out_;
    std::uint64_t colors_alone_ = 0;
    bool finished_ = false;
};

}  // namespace theatron::capture
