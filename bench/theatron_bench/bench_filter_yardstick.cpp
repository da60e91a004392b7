// SPDX-License-Identifier: Apache-2.0
#include "bench_filter_yardstick.h"

#ifdef THEATRON_BENCH_OPENCV
#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>
#endif

namespace theatron::bench {

#ifdef THEATRON_BENCH_OPENCV

std::optional<double> opencv_median_ms(const DepthImage& depth) {
    cv::setNumThreads(1);
    cv::Mat in(depth.size.height, depth.size.width, CV_16UC1), out;
    std::copy(depth.pixels.begin(), depth.pixels.end(), in.ptr<std::uint16_t>());
    double fastest = 1e9;
    for (int pass = 0; pass < 40; ++pass) {
        const auto begin = std::chrono::steady_clock::now();
        cv::medianBlur(in, out, 3);
        fastest = std::min(fastest, std::chrono::duration<double, std::milli>(
                                        std::chrono::steady_clock::now() - begin)
                                        .count());
    }
    return fastest;
}

#else

std::optional<double> opencv_median_ms(const DepthImage&) {
    return std::nullopt;
}

#endif

}  // namespace theatron::bench
