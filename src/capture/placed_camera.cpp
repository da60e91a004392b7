// SPDX-License-Identifier: Apache-2.0
#include "capture/placed_camera.h"
#include "base/lasting_error.h"

namespace theatron::capture {
namespace {

class PlacedCamera final : public Camera {
public:
    PlacedCamera(std::unique_ptr<Camera> camera, const CameraPlaces::Entry& entry,
                 std::uint64_t registration)
        : camera_(std::move(camera)), info_(camera_->info()) {
        Calibration& calibration = info_.calibration;
        calibration.room_from_camera = entry.room_from_camera;
        calibration.registered = true;
        calibration.person = 0;
        calibration.registration = registration;
        calibration.covariance = entry.covariance;
        if (entry.depth_offset_mm)
            calibration.depth_offset_mm = entry.depth_offset_mm;
        if (entry.color_gain)
            calibration.color_gain = entry.color_gain;
    }

    const CameraInfo& info() const override { return info_; }
    void follow(std::shared_ptr<Transport> transport) override {
        camera_->follow(std::move(transport));
    }
    std::uint64_t lost_pictures() const override { return camera_->lost_pictures(); }
    bool skip_none() override { return camera_->skip_none(); }
    Capture next(Duration timeout) override { return camera_->next(timeout); }

private:
    std::unique_ptr<Camera> camera_;
    CameraInfo info_;
};

}  // namespace

std::optional<Pose> take_place_option(Options& options) {
    const std::string text = options.take("place");
    if (text.empty())
        return {};
    const auto place = parse_place(text);
    if (!place)
        throw LastingError(
            "place=" + text +
            " is not X:Y:Z or X:Y:Z:YAW:PITCH:ROLL in metres and degrees, for example "
            "place=0:1.5:2:180.");
    return place;
}

std::unique_ptr<Camera> make_placed_camera(std::unique_ptr<Camera> camera, const Pose& place) {
    CameraPlaces::Entry by_hand;
    by_hand.room_from_camera = place;
    return std::make_unique<PlacedCamera>(std::move(camera), by_hand, 0);
}

std::unique_ptr<Camera> open_camera_at(const std::string& specification, const CameraPlaces& places,
                                       const Progress& progress) {
    std::unique_ptr<Camera> camera = open_camera(specification, progress);
    const CameraPlaces::Entry* entry = places.find(camera->info().name);
    const bool by_hand = !Options::parse(specification).take("place").empty();
    if (!entry || by_hand)
        return camera;
    return std::make_unique<PlacedCamera>(std::move(camera), *entry, places.registration());
}

}  // namespace theatron::capture
