// SPDX-License-Identifier: Apache-2.0
// The effect of filters on recorded depth, which has no truth to compare with: the size of the
// coded frames, and the flicker of what stands still.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "bench_filter.h"
#include "codec/depth_stream.h"
#include "filter/chain.h"
#include "video/depth_codecs.h"

namespace theatron::bench {
namespace {

using Images = std::vector<DepthImage>;

Images filtered_recording(const Images& measured, const filter::ChainSettings& settings) {
    filter::Chain chain(settings, {.size = measured.front().size});
    Images out;
    for (const DepthImage& frame : measured)
        out.push_back(copy_of(chain.apply(frame.view(), std::chrono::microseconds(33'333))));
    return out;
}

double kilobytes_per_frame(const Images& images) {
    codec::DepthStreamEncoder encoder =
        video::make_depth_encoder(video::parse_depth_setting("strata").setting);
    Bytes out(encoder.max_encoded_size(images.front().size));
    double bytes = 0;
    for (std::size_t t = 0; t < images.size(); ++t) {
        const std::size_t size =
            encoder.encode(images[t].view(), FrameNumber(t), t == 0, out).bytes;
        bytes += t > 0 || images.size() == 1 ? double(size) : 0;
    }
    return bytes / double(std::max<std::size_t>(1, images.size() - 1)) / 1000;
}

// Flags of the pixels that a stereo camera's noise alone moves.
std::vector<std::uint8_t> still_pixels(const Images& measured) {
    std::vector<std::uint8_t> still(measured.front().pixels.size());
    std::vector<int> depths;
    for (std::size_t i = 0; i < still.size(); ++i) {
        depths.clear();
        for (const DepthImage& image : measured)
            if (image.pixels[i] != 0)
                depths.push_back(image.pixels[i]);
        if (depths.size() * 10 < measured.size() * 9)
            continue;
        std::sort(depths.begin(), depths.end());
        const double median = depths[depths.size() / 2], metres = median / 1000;
        const double near = 4 + 10 * metres * metres;
        still[i] = median - depths.front() <= near && depths.back() - median <= near;
    }
    return still;
}

// The root of the mean variance over time of still pixels. Frames without a measurement are
// left out: filters that hold a depth would seem quieter.
double still_sigma(const Images& measured, const Images& images,
                   const std::vector<std::uint8_t>& still) {
    double variance = 0, pixels = 0;
    for (std::size_t i = 0; i < still.size(); ++i) {
        double sum = 0, squares = 0, count = 0;
        for (std::size_t t = 0; still[i] && t < images.size(); ++t)
            if (const double mm = images[t].pixels[i]; mm > 0 && measured[t].pixels[i] > 0) {
                sum += mm;
                squares += mm * mm;
                ++count;
            }
        if (count == 0)
            continue;
        variance += std::max(0.0, squares / count - sum / count * (sum / count));
        ++pixels;
    }
    return pixels == 0 ? 0 : std::sqrt(variance / pixels);
}

}  // namespace

nlohmann::json filter_quality_of_recording(const filter::ChainSettings& settings,
                                           const std::string& scene, const Images& measured) {
    for (const DepthImage& frame : measured)
        if (frame.size != measured.front().size)
            throw Error("The depth images of '" + scene + "' are not all of one size.");
    const Images images = filtered_recording(measured, settings);
    const std::vector<std::uint8_t> still = still_pixels(measured);
    double changes = 0, still_changes = 0, flips = 0, valid = 0;
    for (std::size_t t = 0; t < images.size(); ++t)
        for (std::size_t i = 0; i < still.size(); ++i) {
            const int now = images[t].pixels[i];
            valid += now > 0;
            if (t == 0)
                continue;
            const int before = images[t - 1].pixels[i];
            changes += now != before;
            still_changes += still[i] && now != before;
            flips += (now > 0) != (before > 0);
        }
    const double pixels = double(still.size());
    const double still_ones = double(std::count(still.begin(), still.end(), std::uint8_t(1)));
    const double steps = double(std::max<std::size_t>(1, images.size() - 1));
    return {{"filters", settings.spelling()},
            {"scenes",
             {{{"scene", scene},
               {"kb_per_frame", kilobytes_per_frame(images)},
               {"still", still_ones / pixels},
               {"still_sigma_mm", still_sigma(measured, images, still)},
               {"still_changes", still_changes / std::max(1.0, still_ones) / steps},
               {"changes", changes / pixels / steps},
               {"flips", flips / pixels / steps},
               {"valid", valid / pixels / double(images.size())}}}}};
}

}  // namespace theatron::bench
