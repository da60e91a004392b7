// SPDX-License-Identifier: Apache-2.0
#include "or_screen/picture_place.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace theatron::or_screen {
namespace {

// Surfaces that are nearer to the lens than this are not found.
constexpr double nearest_m = 0.1;
constexpr int least_steps = 8, most_steps = 2000;

class Line {
public:
    // `from` and `to` in the frame of the depth camera.
    Line(const Calibration& calibration, DepthView depth, Vec3 from, Vec3 to)
        : calibration_(calibration), depth_(depth), from_(from), to_(to) {}

    Sight sight() const {
        const double reach = length(to_ - from_);
        if (depth_.size.area() == 0 || reach < 2 * nearest_m)
            return Sight::unmeasured;
        // Equal steps of 1 / distance are about equal steps in the picture.
        const double most = reach / nearest_m;
        const int count = steps(nearest_m / reach);
        std::optional<Sample> before;
        for (int i = 0; i <= count; ++i) {
            const std::optional<Sample> now = sample(1 / (most + (1 - most) * i / count));
            if (before && now && before->behind_m < hidden_behind_m &&
                now->behind_m >= hidden_behind_m && is_same_surface(*before, *now))
                return Sight::hidden;
            before = now;
        }
        return before ? Sight::visible : Sight::unmeasured;
    }

private:
    struct Sample {
        double surface_m = 0;  // along the camera's axis
        double behind_m = 0;
    };

    static bool is_same_surface(const Sample& a, const Sample& b) {
        return std::abs(a.surface_m - b.surface_m) < 2 * hidden_behind_m;
    }

    Vec3 at(double share) const { return from_ + (to_ - from_) * share; }

    int steps(double first_share) const {
        const auto first = project(calibration_.depth, at(first_share)),
                   last = project(calibration_.depth, to_);
        if (!first || !last)
            return most_steps;
        const double pixels = std::hypot(last->x - first->x, last->y - first->y);
        return std::clamp(int(std::min(2 * pixels, double(most_steps))), least_steps, most_steps);
    }

    // Nothing where no surface was measured.
    std::optional<Sample> sample(double share) const {
        const Vec3 p = at(share);
        const auto pixel = project(calibration_.depth, p);
        if (!pixel)
            return std::nullopt;
        const double x = std::floor(pixel->x + 0.5), y = std::floor(pixel->y + 0.5);
        if (!(x >= 0 && y >= 0 && x < depth_.size.width && y < depth_.size.height))
            return std::nullopt;
        const double surface = depth_m(calibration_, depth_.row(int(y))[int(x)]);
        if (!(surface > 0))
            return std::nullopt;
        return Sample{surface, p.z - surface};
    }

    const Calibration& calibration_;
    DepthView depth_;
    Vec3 from_, to_;
};

}  // namespace

const char* text_of(Sight sight) {
    switch (sight) {
        case Sight::visible:
            return "visible";
        case Sight::unmeasured:
            return "unmeasured";
        case Sight::hidden:
            return "hidden";
        case Sight::outside:
            return "outside";
    }
    return "unknown";
}

PicturePlace place_in_picture(const Calibration& calibration, DepthView depth, Vec3 place) {
    const Vec3 in_depth = inverse(calibration.room_from_camera) * place;
    const auto pixel = project(calibration.color, calibration.color_from_depth * in_depth);
    const Size size = calibration.color.size;
    if (!pixel || !(pixel->x >= -0.5 && pixel->y >= -0.5 && pixel->x < size.width - 0.5 &&
                    pixel->y < size.height - 0.5))
        return {};
    const Vec3 lens = inverse(calibration.color_from_depth).translation;
    return {Line(calibration, depth, lens, in_depth).sight(), *pixel};
}

}  // namespace theatron::or_screen
