// SPDX-License-Identifier: Apache-2.0
#include "render/picture_quality.h"

#include <algorithm>
#include <cmath>

#include "image/ssim_window.h"

namespace theatron::render {
namespace {

bool lies_behind(int mm, int other_mm, int jump_mm) {
    return other_mm == 0 || other_mm > mm + jump_mm;
}

// True if this pixel shows a surface and one of its four neighbours shows one behind, or none.
bool is_outline(DepthView depth_mm, int x, int y) {
    const int mm = depth_mm.row(y)[x];
    const auto behind = [&](int nx, int ny) {
        return nx >= 0 && ny >= 0 && nx < depth_mm.size.width && ny < depth_mm.size.height &&
               lies_behind(mm, depth_mm.row(ny)[nx], OutlineError::jump_mm);
    };
    return mm > 0 && (behind(x - 1, y) || behind(x + 1, y) || behind(x, y - 1) || behind(x, y + 1));
}

}  // namespace

void SquaredError::add(ColorView drawn, ColorView exact, MaskView mask) {
    for (int y = 0; y < exact.size.height; ++y)
        for (int x = 0; x < exact.size.width; ++x) {
            if (!mask.row(y)[x])
                continue;
            const Rgb a = drawn.row(y)[x], b = exact.row(y)[x];
            const int r = a.r - b.r, g = a.g - b.g, blue = a.b - b.b;
            sum_ += r * r + g * g + blue * blue;
            count_ += 3;
        }
}

double SquaredError::root_mean_square() const {
    return count_ > 0 ? std::sqrt(sum_ / count_) : 0;
}

double SquaredError::psnr_db() const {
    return sum_ > 0 ? std::min(99.0, 10 * std::log10(255.0 * 255.0 * count_ / sum_)) : 99;
}

void Similarity::add(ColorView drawn, ColorView exact, MaskView mask) {
    constexpr int side = 8, step = 2;
    const auto [width, height] = exact.size;
    Image<float> a(exact.size), b(exact.size);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            b.view().row(y)[x] = float(luma(exact.row(y)[x]));
            a.view().row(y)[x] = mask.row(y)[x] ? float(luma(drawn.row(y)[x])) : b.view().row(y)[x];
        }
    for (int y0 = 0; y0 + side <= height; y0 += step)
        for (int x0 = 0; x0 + side <= width; x0 += step) {
            int inside = 0;
            SsimWindow window;
            for (int y = y0; y < y0 + side; ++y)
                for (int x = x0; x < x0 + side; ++x) {
                    inside += mask.row(y)[x] != 0;
                    window.add(a.view().row(y)[x], b.view().row(y)[x]);
                }
            if (inside < side * side / 2)
                continue;
            sum_ += window.ssim();
            ++count_;
        }
}

void OutlineError::add(DepthView drawn_mm, DepthView exact_mm, MaskView mask) {
    const auto [width, height] = exact_mm.size;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!mask.row(y)[x] || !is_outline(exact_mm, x, y))
                continue;
            double nearest = reach;
            for (int dy = -reach; dy <= reach; ++dy)
                for (int dx = -reach; dx <= reach; ++dx) {
                    const int nx = x + dx, ny = y + dy;
                    if (nx < 0 || ny < 0 || nx >= width || ny >= height)
                        continue;
                    const double away = std::hypot(dx, dy);
                    if (away < nearest && is_outline(drawn_mm, nx, ny))
                        nearest = away;
                }
            sum_ += nearest;
            ++count_;
        }
}

namespace {

// True if a pixel at most two columns and two rows away shows another surface.
bool near_outline(DepthView depth_mm, int x, int y, int jump_mm) {
    const int mm = depth_mm.row(y)[x];
    for (int ny = std::max(y - 2, 0); ny <= std::min(y + 2, depth_mm.size.height - 1); ++ny)
        for (int nx = std::max(x - 2, 0); nx <= std::min(x + 2, depth_mm.size.width - 1); ++nx)
            if (std::abs(depth_mm.row(ny)[nx] - mm) > jump_mm)
                return true;
    return false;
}

}  // namespace

void Holes::add(DepthView drawn_mm, DepthView exact_mm, MaskView mask) {
    for (int y = 0; y < exact_mm.size.height; ++y)
        for (int x = 0; x < exact_mm.size.width; ++x)
            if (mask.row(y)[x] && !near_outline(exact_mm, x, y, jump_mm_)) {
                holes_ += lies_behind(exact_mm.row(y)[x], drawn_mm.row(y)[x], jump_mm_);
                ++count_;
            }
}

}  // namespace theatron::render
