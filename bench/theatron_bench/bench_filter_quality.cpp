// SPDX-License-Identifier: Apache-2.0
// The accuracy of filters against ground truth. docs/filters.md explains the figures.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench_filter.h"
#include "codec/depth_stream.h"
#include "filter/chain.h"
#include "video/depth_codecs.h"

namespace theatron::bench {
namespace {

constexpr Duration frame_time = std::chrono::microseconds(33'333);
constexpr int settling_frames = 20;

// Surfaces of one picture that are further apart than this belong to different objects.
constexpr float edge_mm = 150;

// A pixel further from the truth than this is a flying pixel; nearer, it is noise.
constexpr float flying_mm = 40;

std::vector<DepthImage> filtered(const FilterClip& clip, const filter::ChainSettings& settings,
                                 const filter::Background* background = nullptr) {
    filter::Chain chain(settings, {.size = clip.size, .background = background});
    std::vector<DepthImage> out;
    for (const DepthImage& frame : clip.measured)
        out.push_back(copy_of(chain.apply(frame.view(), frame_time)));
    return out;
}

class Mean {
public:
    void add(double value) {
        sum_ += value;
        ++count_;
    }
    double value() const { return count_ == 0 ? 0 : sum_ / double(count_); }
    long count() const { return count_; }

private:
    double sum_ = 0;
    long count_ = 0;
};

// The range of exact depth around a pixel.
struct Surroundings {
    float nearest = 1e9f, furthest = 0;
    bool edge() const { return furthest - nearest > edge_mm; }
    bool between(float mm) const { return mm > nearest + flying_mm && mm < furthest - flying_mm; }
};

Surroundings around(const Image<float>& exact, int x, int y, int radius) {
    Surroundings s;
    for (int v = std::max(0, y - radius); v <= std::min(exact.size.height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(exact.size.width - 1, x + radius); ++u)
            if (const float mm = exact.view().row(v)[u]; mm > 0) {
                s.nearest = std::min(s.nearest, mm);
                s.furthest = std::max(s.furthest, mm);
            }
    return s;
}

// True if no surface around the pixel is at about this distance.
bool hangs_in_the_air(const Image<float>& exact, int x, int y, float mm) {
    constexpr int radius = 2;
    for (int v = std::max(0, y - radius); v <= std::min(exact.size.height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(exact.size.width - 1, x + radius); ++u)
            if (std::abs(exact.view().row(v)[u] - mm) < flying_mm)
                return false;
    return true;
}

template <class Each>
void for_each_pixel(Size size, Each each) {
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            each(x, y, std::size_t(y) * std::size_t(size.width) + std::size_t(x));
}

// Standard deviation over time of static pixels: the root of the mean variance of pixels that
// are measured in most frames.
double temporal_sigma(const FilterClip& clip, const std::vector<DepthImage>& images) {
    Mean variance;
    for_each_pixel(clip.size, [&](int, int, std::size_t i) {
        Mean depth, square;
        for (std::size_t t = settling_frames; t < images.size(); ++t) {
            if (std::abs(clip.exact[t].pixels[i] - clip.exact[settling_frames].pixels[i]) > 0.5f)
                return;
            // Only frames with a measurement: pixels that a filter holds are constant.
            if (clip.measured[t].pixels[i] == 0 || images[t].pixels[i] == 0)
                continue;
            const double mm = images[t].pixels[i];
            // A pixel at an edge that alternates between two surfaces is not noise.
            if (std::abs(mm - clip.exact[t].pixels[i]) > flying_mm)
                return;
            depth.add(mm);
            square.add(mm * mm);
        }
        if (depth.count() * 10 > long(images.size() - settling_frames) * 9)
            variance.add(std::max(0.0, square.value() - depth.value() * depth.value()));
    });
    return std::sqrt(variance.value());
}

// Compared with the mean of the raw measurements of a pixel, the sensor's constant errors
// cancel; the rest is the part that filters can change.
struct Errors {
    double rmse_mm = 0;          // of measured pixels within flying_mm of the truth
    double valid = 0;            // share of pixels with depth among those with a surface
    double flips = 0;            // share of pixels that gain or lose depth from frame to frame
    double flying = 0;           // share of flying pixels among those beside an edge
    double mbit_per_second = 0;  // with strata, at 30 frames a second
};

double mbit_per_second(const std::vector<DepthImage>& images) {
    codec::DepthStreamEncoder encoder =
        video::make_depth_encoder(video::parse_depth_setting("strata").setting);
    Bytes out(encoder.max_encoded_size(images.front().size));
    double bytes = 0;
    std::size_t frames = 0;
    for (std::size_t t = 0; t < images.size(); ++t) {
        const std::size_t size =
            encoder.encode(images[t].view(), FrameNumber(t), t == 0, out).bytes;
        if (t < settling_frames)
            continue;
        bytes += double(size);
        ++frames;
    }
    return bytes / double(std::max<std::size_t>(1, frames)) * 8 * 30 / 1e6;
}

Errors errors_of(const FilterClip& clip, const std::vector<DepthImage>& images) {
    Mean square, valid, flips, flying;
    for (std::size_t t = settling_frames; t < images.size(); ++t)
        for_each_pixel(clip.size, [&](int x, int y, std::size_t i) {
            const float exact = clip.exact[t].pixels[i];
            if (exact == 0)
                return;
            const int mm = images[t].pixels[i];
            valid.add(mm > 0);
            flips.add((mm > 0) != (images[t - 1].pixels[i] > 0));
            if (mm == 0)
                return;
            const double error = mm - exact;
            if (std::abs(error) <= flying_mm)
                square.add(error * error);
            // Every fourth frame only, because the search around pixels is slow.
            if (t % 4 == 0)
                if (around(clip.exact[t], x, y, 2).edge())
                    flying.add(hangs_in_the_air(clip.exact[t], x, y, float(mm)));
        });
    return {std::sqrt(square.value()), valid.value(), flips.value(), flying.value(),
            mbit_per_second(images)};
}

nlohmann::json to_json(const Errors& e) {
    return {{"rmse_mm", e.rmse_mm},
            {"valid", e.valid},
            {"flips", e.flips},
            {"flying", e.flying},
            {"depth_mbit_per_second", e.mbit_per_second}};
}

// For pixels uncovered within the last two frames by an object much nearer than the
// background: the share that still shows the object.
Mean ghosts(const FilterClip& clip, const std::vector<DepthImage>& images) {
    Mean ghost;
    for (std::size_t t = 4; t < images.size(); ++t)
        for_each_pixel(clip.size, [&](int x, int y, std::size_t i) {
            const float now = clip.exact[t].pixels[i], before = clip.exact[t - 4].pixels[i];
            if (before == 0 || now - before < edge_mm || clip.exact[t - 1].pixels[i] < now - 60)
                return;
            // Pixels beside the object's current edge are blurred by it and do not count.
            if (around(clip.exact[t], x, y, 2).edge())
                return;
            const float mm = images[t].pixels[i];
            ghost.add(mm > 0 && mm < now - edge_mm / 2);
        });
    return ghost;
}

// Holes that the filter should fill: pixels without measurement, at most nine wide, on one
// surface.
struct Holes {
    double filled = 0;    // share of those pixels
    double error_mm = 0;  // mean of the filled ones
};

Holes holes_of(const FilterClip& clip, const std::vector<DepthImage>& images) {
    Mean filled, error;
    constexpr int reach = 8;
    for (std::size_t t = settling_frames; t < images.size(); t += 5) {
        const auto measured = [&](int x, int y) {
            return x >= 0 && y >= 0 && x < clip.size.width && y < clip.size.height &&
                   clip.measured[t].view().row(y)[x] > 0;
        };
        const auto run = [&](int x, int y, int dx, int dy) {
            int n = 0;
            while (n <= reach && !measured(x + dx * (n + 1), y + dy * (n + 1)))
                ++n;
            return n;
        };
        for_each_pixel(clip.size, [&](int x, int y, std::size_t i) {
            const float exact = clip.exact[t].pixels[i];
            if (exact == 0 || measured(x, y) || around(clip.exact[t], x, y, 5).edge())
                return;
            const int wide = run(x, y, -1, 0) + 1 + run(x, y, 1, 0);
            const int high = run(x, y, 0, -1) + 1 + run(x, y, 0, 1);
            if (wide > reach || high > reach)
                return;
            const int mm = images[t].pixels[i];
            filled.add(mm > 0);
            if (mm > 0)
                error.add(std::abs(mm - exact));
        });
    }
    return {filled.value(), error.value()};
}

FilterClip seen(FilterClip clip, bool stereo) {
    return stereo ? seen_in_stereo(std::move(clip)) : clip;
}

nlohmann::json board_biases(const filter::ChainSettings& settings, bool stereo) {
    const FilterClip clip = seen(boards_moving(60), stereo);
    const std::vector<DepthImage> images = filtered(clip, settings);
    const filter::ChainSettings off;
    nlohmann::json rows = nlohmann::json::array();
    Mean overall;
    for (const Board& board : moving_boards()) {
        // The sensor's constant errors are equal in both and cancel.
        Mean bias, absolute;
        for (std::size_t t = settling_frames; t < images.size(); ++t)
            for (int y = board.top + 8; y < board.bottom - 8; ++y)
                for (int x = board.left + 8; x < board.right - 8; ++x) {
                    const int mm = images[t].view().row(y)[x];
                    const int measured = clip.measured[t].view().row(y)[x];
                    if (mm > 0 && measured > 0)
                        bias.add(mm - measured);
                }
        overall.add(std::abs(bias.value()));
        rows.push_back({{"mm_per_second", board.mm_per_s}, {"bias_mm", bias.value()}});
    }
    return {{"speeds", rows}, {"mean_bias_mm", overall.value()}};
}

// The subpixel position of a board's edge in a row: the middle between the last pixel on one
// side of the mean depth and the first on the other.
double edge_at(const std::uint16_t* row, double guess, double middle_mm, bool board_is_right) {
    double best = guess, distance = 1e9;
    for (int x = std::max(1, int(guess) - 60); x < std::min(639, int(guess) + 60); ++x) {
        if (row[x] == 0 || (row[x] < middle_mm) != board_is_right)
            continue;
        // The nearest measured pixel at the left that is on the other side.
        int left = x - 1;
        while (left > 0 && row[left] == 0 && x - left < 12)
            --left;
        if (row[left] == 0 || (row[left] < middle_mm) == board_is_right)
            continue;
        const double at = (left + x + 1) / 2.0;
        if (std::abs(at - guess) < distance) {
            distance = std::abs(at - guess);
            best = at;
        }
    }
    return best;
}

nlohmann::json crossing(const filter::ChainSettings& settings, bool stereo) {
    nlohmann::json rows = nlohmann::json::array();
    double worst_lag = 0;
    Mean ghost;
    for (const double speed : {1.0, 3.0, 8.0}) {
        const CrossingBoard board = crossing_board(speed);
        const FilterClip clip = seen(board_crossing(board, 36), stereo);
        const std::vector<DepthImage> images = filtered(clip, settings);
        const double middle = (board.board_mm + board.wall_mm) / 2;
        Mean leading, trailing, width;
        for (std::size_t t = settling_frames; t < images.size(); ++t)
            for (int y = board.top + 10; y < board.bottom - 10; y += 7) {
                const std::uint16_t* row = images[t].view().row(y);
                const std::uint16_t* raw = clip.measured[t].view().row(y);
                const double right = board.right(int(t)), left = board.left(int(t));
                // The lag relative to the sensor's own picture, in pixels.
                leading.add(edge_at(raw, right, middle, false) -
                            edge_at(row, right, middle, false));
                trailing.add(edge_at(raw, left, middle, true) - edge_at(row, left, middle, true));
                // Pixels that belong to neither side.
                int between = 0;
                for (int x = int(right) - 10; x < int(right) + 10; ++x)
                    between += row[x] == 0 || (row[x] > board.board_mm + flying_mm &&
                                               row[x] < board.wall_mm - flying_mm);
                width.add(between);
            }
        const double lag = std::max(std::abs(leading.value()), std::abs(trailing.value())) / speed;
        worst_lag = std::max(worst_lag, lag);
        ghost.add(ghosts(clip, images).value());
        rows.push_back({{"pixels_per_frame", speed},
                        {"leading_lag_frames", leading.value() / speed},
                        {"trailing_lag_frames", trailing.value() / speed},
                        {"edge_width_pixels", width.value()}});
    }
    return {{"speeds", rows}, {"worst_lag_frames", worst_lag}, {"ghosts", ghost.value()}};
}

}  // namespace

nlohmann::json filter_quality_of_clip(const filter::ChainSettings& settings, const FilterClip& clip,
                                      const filter::Background* background) {
    const std::vector<DepthImage> images = filtered(clip, settings, background);
    nlohmann::json result = to_json(errors_of(clip, images));
    const double raw = temporal_sigma(clip, clip.measured), now = temporal_sigma(clip, images);
    result["scene"] = clip.name;
    result["temporal_sigma_mm"] = now;
    result["temporal_sigma_cut"] = now > 0 ? raw / now : 0;
    const Mean ghost = ghosts(clip, images);
    result["ghosts"] = ghost.value();
    result["uncovered_pixels"] = ghost.count();
    const Holes holes = holes_of(clip, images);
    result["holes_filled"] = holes.filled;
    result["holes_error_mm"] = holes.error_mm;
    return result;
}

nlohmann::json filter_quality(const filter::ChainSettings& settings, bool stereo) {
    const auto quality = [&](FilterClip clip) {
        return filter_quality_of_clip(settings, seen(std::move(clip), stereo));
    };
    return {
        {"filters", settings.spelling()},
        {"scenes", nlohmann::json::array({quality(still_room(50)), quality(rocking_person(50))})},
        {"moving_boards", board_biases(settings, stereo)},
        {"crossing_board", crossing(settings, stereo)}};
}

}  // namespace theatron::bench
