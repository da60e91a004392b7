// SPDX-License-Identifier: Apache-2.0
#include "capture/face_camera.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <thread>

#include "base/lasting_error.h"
#include "base/steady_clock.h"
#include "geometry/screen.h"
#include "image/frame_pool.h"

namespace theatron::capture {
namespace {

constexpr double face_width_m = 0.28;
// Share of the period by which a picture may come early, since cameras are uneven.
constexpr double early_share = 0.2;
constexpr const char* test_device = "test";
constexpr Size webcam_picture{640, 480};

CameraInfo face_info(double frames_per_second) {
    CameraInfo info;
    info.name = "face";
    info.calibration = screen_calibration(face_picture, face_width_m, {});
    info.frames_per_second = std::clamp(frames_per_second, 1.0, face_fps);
    return info;
}

void begin_frame(Frame& frame, FrameNumber number) {
    frame.number = number;
    frame.times = {};
    frame.depth.resize(screen_grid);
    std::fill(frame.depth.pixels.begin(), frame.depth.pixels.end(),
              std::uint16_t(screen_distance_mm));
    frame.color.jpeg.clear();
    frame.color.size = face_picture;
    frame.color.pixels.resize(face_picture);
}

class FaceCamera final : public Camera {
public:
    explicit FaceCamera(std::unique_ptr<Camera> camera)
        : camera_(std::move(camera)), info_(face_info(camera_->info().frames_per_second)) {
        info_.live = camera_->info().live;
    }

    const CameraInfo& info() const override { return info_; }

    Capture next(Duration timeout) override {
        const TimePoint end = steady_now() + timeout;
        const Duration least = seconds_to_duration((1 - early_share) / face_fps);
        while (true) {
            Capture capture = camera_->next(std::max(Duration(0), end - steady_now()));
            if (capture.kind != Capture::Kind::frame)
                return capture;
            const Frame& given = *capture.frame;
            if (taken_ && given.times.captured - *taken_ < least)
                continue;
            if (given.color.pixels.empty())
                return {.kind = Capture::Kind::failed,
                        .frame = {},
                        .problem = "This camera gives no pictures that can be scaled."};
            taken_ = given.times.captured;
            const auto frame = pool_.take();
            begin_frame(*frame, number_++);
            frame->times = given.times;
            fit_middle(given.color.pixels.view(), frame->color.pixels.view());
            return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
        }
    }

private:
    std::unique_ptr<Camera> camera_;
    CameraInfo info_;
    FramePool pool_;
    FrameNumber number_ = 0;
    std::optional<TimePoint> taken_;
};

class TestFace final : public Camera {
public:
    const CameraInfo& info() const override { return info_; }

    Capture next(Duration timeout) override {
        const TimePoint now = steady_now();
        if (due_ == TimePoint{})
            due_ = now;
        if (due_ > now + timeout) {
            std::this_thread::sleep_for(timeout);
            return {};
        }
        std::this_thread::sleep_for(due_ - now);
        const auto frame = pool_.take();
        begin_frame(*frame, number_++);
        draw_test_face(frame->number, frame->color.pixels.view());
        frame->times.captured = due_;
        frame->times.delivered = steady_now();
        // A late picture does not make the next one early.
        due_ = std::max(due_ + seconds_to_duration(1 / face_fps), frame->times.delivered);
        return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
    }

private:
    CameraInfo info_ = face_info(face_fps);
    FramePool pool_;
    FrameNumber number_ = 0;
    TimePoint due_;
};

struct Part {
    int begin = 0, size = 0;
};

// The part of a side of `size` pixels that shape `shape` leaves, with the other side and its shape.
Part middle(int size, int shape, int other, int other_shape) {
    const int part = int(std::min<std::int64_t>(size, std::int64_t(other) * shape / other_shape));
    return {(size - std::max(part, 1)) / 2, std::max(part, 1)};
}

// The pixels of `part` that pixel i of n covers.
Part covered(const Part& part, int i, int n) {
    const int begin = part.begin + int(std::int64_t(i) * part.size / n);
    const int end = part.begin + int(std::int64_t(i + 1) * part.size / n);
    return {begin, std::max(end - begin, 1)};
}

}  // namespace

void fit_middle(ColorView picture, MutableColorView out) {
    const Part across =
        middle(picture.size.width, out.size.width, picture.size.height, out.size.height);
    const Part down =
        middle(picture.size.height, out.size.height, picture.size.width, out.size.width);
    for (int y = 0; y < out.size.height; ++y) {
        const Part rows = covered(down, y, out.size.height);
        Rgb* to = out.row(y);
        for (int x = 0; x < out.size.width; ++x) {
            const Part columns = covered(across, x, out.size.width);
            unsigned r = 0, g = 0, b = 0;
            for (int v = 0; v < rows.size; ++v) {
                const Rgb* from = picture.row(rows.begin + v) + columns.begin;
                for (int u = 0; u < columns.size; ++u) {
                    r += from[u].r;
                    g += from[u].g;
                    b += from[u].b;
                }
            }
            const unsigned count = unsigned(rows.size) * unsigned(columns.size);
            to[x] = {std::uint8_t(r / count), std::uint8_t(g / count), std::uint8_t(b / count)};
        }
    }
}

void draw_test_face(FrameNumber number, MutableColorView out) {
    constexpr Rgb left{220, 60, 40}, right{40, 90, 220}, disc{245, 245, 245}, hand{25, 25, 25};
    constexpr double steps = face_fps;
    const double radius = 0.3 * out.size.height, half_hand = 0.03 * out.size.height;
    const double angle = 2 * std::numbers::pi * double(number % unsigned(steps)) / steps;
    const double ahead_x = std::sin(angle), ahead_y = -std::cos(angle);
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x) {
            const double dx = x + 0.5 - 0.5 * out.size.width;
            const double dy = y + 0.5 - 0.5 * out.size.height;
            const double along = dx * ahead_x + dy * ahead_y;
            const double beside = std::abs(dx * ahead_y - dy * ahead_x);
            const bool in_disc = std::hypot(dx, dy) < radius;
            const bool in_hand = in_disc && along > 0 && beside < half_hand;
            out.row(y)[x] = in_hand ? hand : in_disc ? disc : dx < 0 ? left : right;
        }
}

std::unique_ptr<Camera> make_face_camera(std::unique_ptr<Camera> camera) {
    return std::make_unique<FaceCamera>(std::move(camera));
}

std::unique_ptr<Camera> open_face_camera(Options& options, const Progress& progress) {
    options.require_no_problem();
    std::string device = options.value();
    if (device.empty())
        throw LastingError("Name a webcam, as in /dev/video0, a video file, or test.");
    if (device == test_device)
        return std::make_unique<TestFace>();
    return make_face_camera(
        open_camera(webcam_specification(std::move(device), webcam_picture), progress));
}

std::string webcam_specification(std::string device, Size size) {
    constexpr std::string_view v4l2 = "v4l2:";
    const bool is_device = device.starts_with(v4l2) || device.starts_with("/dev/");
    if (device.starts_with(v4l2))
        device.erase(0, v4l2.size());
    return is_device ? std::string(v4l2) + device + ",size=" + std::to_string(size.width) + "x" +
                           std::to_string(size.height) + ",fps=15"
                     : "video:" + device + ",loop=1";
}

}  // namespace theatron::capture
