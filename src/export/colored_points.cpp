// SPDX-License-Identifier: Apache-2.0
#include "export/colored_points.h"

namespace theatron::exporting {

ColorOfDepth::ColorOfDepth(const Calibration& calibration, std::uint64_t& undecoded)
    : undecoded_(undecoded),
      size_(calibration.color.size),
      registration_(calibration),
      out_(calibration.depth.size),
      seen_(calibration.depth.size) {}

bool ColorOfDepth::apply(const Frame& frame) {
    if (frame.color.empty())
        return false;
    if (frame.color.is_jpeg() && jpeg_.decompress(frame.color.jpeg, decoded_) != Status::ok) {
        ++undecoded_;
        return false;
    }
    const ColorImage& color = frame.color.is_jpeg() ? decoded_ : frame.color.pixels;
    if (color.size != size_) {
        ++undecoded_;
        return false;
    }
    registration_.apply(frame.depth.view(), color.view(), out_.view(), seen_.view());
    return true;
}

PointMaker::PointMaker(const Calibration& calibration, std::uint64_t& undecoded)
    : calibration_(calibration), rays_(make_ray_table(calibration.depth)) {
    if (calibration.color.size != Size{})
        colors_.emplace(calibration, undecoded);
}

void PointMaker::append(const Frame& frame, std::vector<ColoredPoint>& out) {
    const std::size_t first = out.size();
    append_points(frame.depth.view(), rays_, {}, calibration_, out);
    if (!colors_ || !colors_->apply(frame))
        return;
    ColoredPoint* point = out.data() + first;
    for (std::size_t i = 0; i < rays_.pixels.size(); ++i) {
        // The pixels of which append_points() makes points.
        if (depth_m(calibration_, frame.depth.pixels[i]) == 0 || rays_.pixels[i].x == no_ray)
            continue;
        if (colors_->seen(i))
            point->color = colors_->color_at(i);
        ++point;
    }
}

}  // namespace theatron::exporting
