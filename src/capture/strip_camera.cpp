// SPDX-License-Identifier: Apache-2.0
#include "capture/strip_camera.h"

#include <algorithm>

#include "base/lasting_error.h"
#include "photon/strip.h"

namespace theatron::capture {
namespace {

constexpr Size board_depth{640, 576}, board_color{1280, 720};
constexpr double board_depth_focal = 504, board_color_focal = 610;
constexpr std::uint16_t board_distance_mm = 1200;
constexpr int board_cell_px = 30;
constexpr Rgb board_wall{150, 150, 150};
constexpr double longest_strip_delay_ms = 10'000;

CameraModel board_lens(Size size, double focal) {
    CameraModel model;
    model.size = size;
    model.fx = model.fy = focal;
    model.cx = (size.width - 1) / 2.0;
    model.cy = (size.height - 1) / 2.0;
    return model;
}

CameraInfo board_info(const StripCamera& wanted) {
    CameraInfo info;
    info.name = "strip";
    info.calibration.depth = board_lens(board_depth, board_depth_focal);
    info.calibration.color = board_lens(board_color, board_color_focal);
    info.frames_per_second = wanted.frames_per_second;
    info.live = true;
    return info;
}

class BoardCamera final : public Camera {
public:
    BoardCamera(const StripCamera& wanted, Clock clock)
        : info_(board_info(wanted)),
          delay_(wanted.delay),
          period_(seconds_to_duration(1 / wanted.frames_per_second)),
          clock_(std::move(clock)) {}

    const CameraInfo& info() const override { return info_; }

    Capture next(Duration timeout) override {
        const TimePoint now = clock_.now();
        if (taken_ == TimePoint{})
            taken_ = now;
        // Pictures that are more than a period late are left out, as a sensor does.
        while (taken_ + delay_ + period_ < now)
            taken_ += period_;
        const Duration wait = taken_ + delay_ - now;
        if (wait > timeout) {
            clock_.sleep(timeout);
            return {};
        }
        if (wait > Duration(0))
            clock_.sleep(wait);
        const auto frame = pool_.take();
        draw(taken_, *frame);
        frame->times.delivered = clock_.now();
        taken_ += period_;
        return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
    }

private:
    void draw(TimePoint taken, Frame& frame) {
        frame.number = number_++;
        frame.times = {};
        frame.times.captured = taken;
        frame.depth.resize(board_depth);
        // No sensor gives the same depth image twice: one that does so stands still.
        std::fill(frame.depth.pixels.begin(), frame.depth.pixels.end(),
                  std::uint16_t(board_distance_mm + frame.number % 2));
        frame.color.jpeg.clear();
        frame.color.size = board_color;
        frame.color.pixels.resize(board_color);
        std::fill(frame.color.pixels.pixels.begin(), frame.color.pixels.pixels.end(), board_wall);
        const Size strip{photon::strip_width * board_cell_px, photon::strip_height * board_cell_px};
        const MutableColorView color = frame.color.pixels.view();
        photon::draw_strip(photon::strip_time_at(taken),
                           {color.row((board_color.height - strip.height) / 2) +
                                (board_color.width - strip.width) / 2,
                            strip, color.stride});
    }

    CameraInfo info_;
    Duration delay_, period_;
    Clock clock_;
    FramePool pool_;
    FrameNumber number_ = 0;
    TimePoint taken_;  // the next picture
};

}  // namespace

std::unique_ptr<Camera> make_strip_camera(const StripCamera& wanted, Clock clock) {
    return std::make_unique<BoardCamera>(wanted, std::move(clock));
}

std::unique_ptr<Camera> open_strip_camera(Options& options, const Progress&) {
    StripCamera wanted;
    wanted.delay =
        seconds_to_duration(options.take_number("delay", 0, 0, longest_strip_delay_ms) / 1000);
    wanted.frames_per_second = options.take_number("fps", 30, 1, 240);
    options.require_no_problem();
    if (!options.value().empty())
        throw LastingError("The camera 'strip' takes no '" + options.value() +
                           "'; write strip or strip:delay=75.");
    return make_strip_camera(wanted, steady_clock());
}

}  // namespace theatron::capture
