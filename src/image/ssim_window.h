// SPDX-License-Identifier: Apache-2.0
// Structural similarity of brightness (Wang et al. 2004) within one window of two pictures.
#pragma once

#include "image/view.h"

namespace theatron {

inline double luma(Rgb p) {
    return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b;
}

class SsimWindow {
public:
    // One pixel's brightness in both pictures, 0 to 255.
    void add(double a, double b) {
        ++n_;
        a_ += a;
        b_ += b;
        aa_ += a * a;
        bb_ += b * b;
        ab_ += a * b;
    }

    // 1: equal. At least one pixel was added.
    double ssim() const {
        constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
        const double a = a_ / n_, b = b_ / n_;
        const double variance_a = aa_ / n_ - a * a, variance_b = bb_ / n_ - b * b;
        const double covariance = ab_ / n_ - a * b;
        return (2 * a * b + c1) * (2 * covariance + c2) /
               ((a * a + b * b + c1) * (variance_a + variance_b + c2));
    }

private:
    double n_ = 0, a_ = 0, b_ = 0, aa_ = 0, bb_ = 0, ab_ = 0;
};

}  // namespace theatron
