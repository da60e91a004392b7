// SPDX-License-Identifier: Apache-2.0
#include "bench_ssim.h"

#include <cassert>

#include "image/ssim_window.h"

namespace theatron::bench {
namespace {

constexpr int window = 8, step = 4;

double ssim_of_window(ColorView a, ColorView b, int left, int top) {
    SsimWindow sums;
    for (int y = top; y < top + window; ++y)
        for (int x = left; x < left + window; ++x)
            sums.add(luma(a.row(y)[x]), luma(b.row(y)[x]));
    return sums.ssim();
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

}  // namespace theatron::bench
