// SPDX-License-Identifier: Apache-2.0
#include "capture/uneven_camera.h"

#include "base/error.h"

namespace theatron::capture {
namespace {

class UnevenCamera final : public Camera {
public:
    UnevenCamera(std::unique_ptr<Camera> camera, Unevenness unevenness,
                 std::function<void(Duration)> sleep)
        : camera_(std::move(camera)), unevenness_(unevenness), sleep_(std::move(sleep)) {}

    const CameraInfo& info() const override { return camera_->info(); }
    void follow(std::shared_ptr<Transport> transport) override {
        camera_->follow(std::move(transport));
    }
    bool skip_none() override { return camera_->skip_none(); }
    std::uint64_t lost_pictures() const override { return camera_->lost_pictures(); }

    Capture next(Duration timeout) override {
        Capture got = camera_->next(timeout);
        if (got.kind != Capture::Kind::frame)
            return got;
        if (unevenness_.skip_every > 0 && ++pictures_ % unevenness_.skip_every == 0)
            return {};
        if (unevenness_.late != Duration{}) {
            sleep_(unevenness_.late);
            auto frame = std::make_shared<Frame>(*got.frame);
            frame->times.captured += unevenness_.late;
            frame->times.delivered += unevenness_.late;
            got.frame = std::move(frame);
        }
        return got;
    }

private:
    std::unique_ptr<Camera> camera_;
    Unevenness unevenness_;
    std::function<void(Duration)> sleep_;
    std::int64_t pictures_ = 0;
};

}  // namespace

std::unique_ptr<Camera> make_uneven_camera(std::unique_ptr<Camera> camera, Unevenness unevenness,
                                           std::function<void(Duration)> sleep) {
    return std::make_unique<UnevenCamera>(std::move(camera), unevenness, std::move(sleep));
}

std::optional<Unevenness> take_uneven_options(Options& options) {
    const int late_ms = options.take_int("late_ms", 0, 0, 30);
    const int skip_every = options.take_int("skip_every", 0, 0, 1'000'000);
    if (skip_every == 1)
        throw Error("skip_every=1 leaves no picture; it takes 2 and more, or 0 for none.");
    if (late_ms == 0 && skip_every == 0)
        return std::nullopt;
    return Unevenness{std::chrono::milliseconds(late_ms), skip_every};
}

}  // namespace theatron::capture
