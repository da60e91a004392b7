// SPDX-License-Identifier: Apache-2.0
#include "bench_ssim.h"

#include <cassert>

namespace theatron::app {
namespace {

constexpr int window = 8, step = 4;

double brightness(Rgb p) {
    return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b;
}

double ssim_of_window(ColorView a, ColorView b, int left, int top) {
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (int y = top; y < top + window; ++y)
        for (int x = left; x < left + window; ++x) {
            const double p = brightness(a.row(y)[x]), q = brightness(b.row(y)[x]);
            sum_a += p;
            sum_b += q;
            sum_aa += p * p;
            sum_bb += q * q;
            sum_ab += p * q;
        }
    constexpr double n = window * window;
    constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    const double mean_a = sum_a / n, mean_b = sum_b / n;
    const double var_a = sum_aa / n - mean_a * mean_a, var_b = sum_bb / n - mean_b * mean_b;
    const double covariance = sum_ab / n - mean_a * mean_b;
    return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

}  // namespace

double ssim(ColorView a, ColorView b) {
    assert(a.size == b.size && a.size.width >= window && a.size.height >= window);
    double sum = 0;
    long windows = 0;
    for (int y = 0; y + window <= a.size.height; y += step)
        for (int x = 0; x + window <= a.size.width; x += step) {
            sum += ssim_of_window(a, b, x, y);
            ++windows;
        }
    return sum / double(windows);
}

}  // namespace theatron::app
