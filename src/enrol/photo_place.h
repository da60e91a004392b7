// SPDX-License-Identifier: Apache-2.0
// Where a photo stands in a window, and how much of it is seen. Pure.
#pragma once

#include <algorithm>

#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::enrol {

class PhotoPlace {
public:
    static constexpr double most_zoom = 12;

    // The photo fits into the part of the window that begins at `left_px`. Neither size is empty.
    PhotoPlace(Size photo, Size window, double left_px) {
        const double free = std::max(window.width - left_px, 1.0);
        scale_ = std::min(free / photo.width, double(window.height) / photo.height);
        shift_ = {left_px + (free - scale_ * photo.width) / 2,
                  (window.height - scale_ * photo.height) / 2};
        fitting_ = scale_;
    }

    double scale() const { return scale_; }  // pixels of the window a pixel of the photo
    Vec2 window_of(Vec2 photo) const {
        return {photo.x * scale_ + shift_.x, photo.y * scale_ + shift_.y};
    }
    Vec2 photo_of(Vec2 window) const {
        return {(window.x - shift_.x) / scale_, (window.y - shift_.y) / scale_};
    }

    // The photo becomes larger by this factor (below 1: smaller, not below the whole photo). The
    // place of the photo below `window` stays there.
    void zoom(double factor, Vec2 window) {
        const Vec2 fixed = photo_of(window);
        const double wanted = std::clamp(scale_ * factor, fitting_, most_zoom * fitting_);
        shift_ = {window.x - fixed.x * wanted, window.y - fixed.y * wanted};
        scale_ = wanted;
    }
    bool is_whole() const { return scale_ <= fitting_ * 1.0001; }

private:
    double scale_ = 1, fitting_ = 1;
    Vec2 shift_;
};

}  // namespace theatron::enrol
