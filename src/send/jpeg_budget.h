// SPDX-License-Identifier: Apache-2.0
// The quality and the size of automatic colour's JPEG pictures, so that a camera's colour takes at
// most 20 Mbit/s. Pure: pictures are counted, not timed.
//
// Quality falls first, then the size is halved, at most twice. A coarser step is taken with the
// picture that is too large, which is then encoded again; a finer one after many pictures that
// would have fitted.
#pragma once

#include <cstddef>
#include <span>

namespace theatron::send {

// The camera whose pictures the budget is for.
struct JpegLimits {
    double frames_per_second = 30;  // below one it counts as one
    // False for pictures that are read or that are drawn with their own size: a screen, a face.
    bool may_be_smaller = true;
};

class JpegBudget {
public:
    static constexpr double most_mbit = 20;
    // Consecutive pictures that must fit before a finer step is tried, or a camera's own pictures
    // are sent again. Each failed try of a finer step doubles its number, up to `longest_wait`; a
    // step that holds for `longest_wait` pictures resets it.
    static constexpr int first_wait = 30, longest_wait = 1800;

    struct Step {
        int quality;  // of JPEG
        int divisor;  // of width and height
        double size;  // bytes, relative to the first step; typical
    };
    // From the finest to the coarsest. The last one may take more than the bound.
    std::span<const Step> steps() const { return steps_; }

    explicit JpegBudget(const JpegLimits& limits);

    // The bytes that a picture may have.
    std::size_t most_bytes() const { return most_bytes_; }

    // To be called with the bytes of each picture that a camera gives as JPEG: true if it is to be
    // sent as it is.
    bool takes_own(std::size_t bytes);

    // How the next picture is to be encoded.
    const Step& step() const { return steps()[step_]; }
    // To be called with the bytes of a picture encoded so. False: it is too large, step() is
    // coarser now, and the picture must be encoded again.
    bool takes(std::size_t bytes);

private:
    bool fits(double bytes, double share) const { return bytes <= share * double(most_bytes_); }

    std::span<const Step> steps_;
    std::size_t most_bytes_;
    bool own_fits_ = true;
    int own_calm_ = 0;  // of a camera's own pictures, in a row: well below the bound
    std::size_t step_ = 0;
    int calm_ = 0;  // pictures in a row that would fit with a finer step
    int wait_ = first_wait;
    int since_try_ = longest_wait;  // pictures since a finer step began
};

}  // namespace theatron::send
