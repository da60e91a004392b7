// SPDX-License-Identifier: Apache-2.0
#include "bench_filter_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "synthetic/frame_cache.h"
#include "synthetic/sensor_model.h"

namespace theatron::bench {
namespace {

constexpr Size size{640, 576};
constexpr double frames_per_second = 30;

// The surface seen by a pixel.
struct Surface {
    double mm = 0, reflectivity = 0.5, cos_incidence = 0.9;
};

// Renders frames of surface(x, y, frame) with one camera.
template <class Draw>
FilterClip draw(const char* name, int frames, Draw surface) {
    FilterClip clip{.name = name, .size = size, .measured = {}, .exact = {}};
    synthetic::DepthSensor sensor(synthetic::nfov_unbinned(), size, 1);
    Image<float> depth(size), reflectivity(size), cosine(size);
    for (int frame = 0; frame < frames; ++frame) {
        Image<float> exact(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const Surface s = surface(x, y, frame);
                depth.view().row(y)[x] = float(s.mm / 1000);
                reflectivity.view().row(y)[x] = float(s.reflectivity);
                cosine.view().row(y)[x] = float(s.cos_incidence);
                if (synthetic::inside_mask(size, x, y))
                    exact.view().row(y)[x] = float(s.mm);
            }
        DepthImage measured(size);
        sensor.capture({depth.view(), reflectivity.view(), cosine.view(), {}}, std::uint32_t(frame),
                       measured.view());
        clip.measured.push_back(std::move(measured));
        clip.exact.push_back(std::move(exact));
    }
    return clip;
}

// Spots too dark to be measured, one to nine pixels wide, on a grid.
bool in_dark_spot(int x, int y) {
    constexpr int grid = 36;
    const int column = x / grid, row = y / grid;
    const double width = 1 + (column * 5 + row * 3) % 9;
    return std::hypot(x % grid - grid / 2, y % grid - grid / 2) < width / 2;
}

Surface room(int x, int y, double person_x) {
    Surface s;
    // A slanted wall, further away at the right, and a table that extends towards the camera.
    s.mm = 2600 + 1.2 * x;
    s.reflectivity = 0.6;
    if (y > 360) {
        s.mm = std::min(s.mm, 2200 * 180.0 / (180 + (y - 360) * 0.9));
        s.reflectivity = 0.45;
        s.cos_incidence = 0.6;
    }
    // A head and a body, round.
    const auto ellipsoid = [&](double cx, double cy, double rx, double ry, double mm,
                               double depth_mm) {
        const double u = (x - cx) / rx, v = (y - cy) / ry, r = u * u + v * v;
        if (r >= 1 || mm - depth_mm * std::sqrt(1 - r) >= s.mm)
            return;
        s.mm = mm - depth_mm * std::sqrt(1 - r);
        s.reflectivity = 0.55;
        s.cos_incidence = std::max(0.15, std::sqrt(1 - r));
    };
    ellipsoid(person_x, 150, 45, 60, 1800, 110);
    ellipsoid(person_x - 10, 380, 110, 190, 1850, 160);
    if (in_dark_spot(x, y))
        s.reflectivity = 0.004;
    return s;
}

}  // namespace

FilterClip rocking_person(int frames) {
    return draw("rocking_person", frames, [](int x, int y, int frame) {
        return room(x, y, 300 + 40 * std::sin(frame * 2 * std::numbers::pi / 60));
    });
}

FilterClip still_room(int frames) {
    return draw("still_room", frames, [](int x, int y, int) { return room(x, y, 300); });
}

FilterClip seen_in_stereo(FilterClip clip, double noise_steps) {
    // Focal length 580 pixels, 75 mm between camera and projector, eighths of a pixel.
    constexpr double steps_times_mm = 580 * 75 * 8;
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, noise_steps);
    for (std::size_t t = 0; t < clip.measured.size(); ++t)
        for (std::size_t i = 0; i < clip.measured[t].pixels.size(); ++i) {
            std::uint16_t& mm = clip.measured[t].pixels[i];
            const double exact = clip.exact[t].pixels[i];
            if (mm == 0 || exact == 0)
                continue;
            const double steps = std::max(1.0, std::round(steps_times_mm / exact + noise(random)));
            mm = std::uint16_t(std::min(65535.0, std::round(steps_times_mm / steps)));
        }
    return clip;
}

std::vector<Board> moving_boards() {
    std::vector<Board> boards;
    constexpr double speeds[] = {5, 10, 20, 50, 100};
    for (int i = 0; i < 5; ++i) {
        const int left = 130 + 80 * i;
        boards.push_back({left, 140, left + 70, 270, speeds[i]});
        boards.push_back({left, 300, left + 70, 430, -speeds[i]});
    }
    return boards;
}

FilterClip boards_moving(int frames) {
    return draw("boards_moving", frames, [boards = moving_boards()](int x, int y, int frame) {
        for (const Board& b : boards)
            if (x >= b.left && x < b.right && y >= b.top && y < b.bottom)
                return Surface{1800 + b.mm_per_s * frame / frames_per_second, 0.5, 0.95};
        return Surface{3000, 0.6, 0.95};
    });
}

CrossingBoard crossing_board(double pixels_per_frame) {
    return {120, 120, pixels_per_frame, 150, 430, 1800, 2800};
}

FilterClip board_crossing(const CrossingBoard& board, int frames) {
    return draw("board_crossing", frames, [&](int x, int y, int frame) {
        const bool on_board =
            x >= board.left(frame) && x < board.right(frame) && y >= board.top && y < board.bottom;
        return on_board ? Surface{board.board_mm, 0.5, 0.95} : Surface{board.wall_mm, 0.6, 0.95};
    });
}

std::vector<DepthImage> operating_room_frames(int frames, const capture::Progress& progress) {
    synthetic::FrameLoop loop({}, progress);
    std::vector<DepthImage> images;
    Frame frame;
    for (std::size_t i = 0; i < std::min(std::size_t(frames), loop.frames()); ++i) {
        loop.read(i, frame);
        images.push_back(frame.depth);
    }
    return images;
}

FilterClip operating_room_clip(int frames, const capture::Progress& progress) {
    synthetic::LoopOptions options;
    synthetic::FrameLoop measured(options, progress);
    options.noise = false;
    options.color = {0, 0};
    synthetic::FrameLoop exact(options, progress);
    FilterClip clip{.name = "operating_room",
                    .size = measured.calibration().depth.size,
                    .measured = {},
                    .exact = {}};
    const std::size_t count = std::min({std::size_t(frames), measured.frames(), exact.frames()});
    Frame frame;
    for (std::size_t i = 0; i < count; ++i) {
        measured.read(i, frame);
        clip.measured.push_back(frame.depth);
        exact.read(i, frame);
        Image<float> mm(clip.size);
        std::copy(frame.depth.pixels.begin(), frame.depth.pixels.end(), mm.pixels.begin());
        clip.exact.push_back(std::move(mm));
    }
    return clip;
}

}  // namespace theatron::bench
