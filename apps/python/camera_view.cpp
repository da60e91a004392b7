// SPDX-License-Identifier: Apache-2.0
#include "camera_view.h"

namespace theatron::python {

std::shared_ptr<ColorImage> CameraView::decode(ByteView jpeg) const {
    std::shared_ptr<ColorImage> picture = pictures_.take();
    const std::lock_guard lock(mutex_);
    if (jpeg_.decompress(jpeg, *picture) == Status::ok && picture->size == calibration_.color.size)
        return picture;
    ++undecoded_;
    return nullptr;
}

std::vector<ColoredPoint> CameraView::points(const Frame& frame, bool in_room) const {
    std::vector<ColoredPoint> points;
    const std::lock_guard lock(mutex_);
    // A host that is too busy sends smaller pictures.
    const ColorImage& pixels = frame.color.pixels;
    const Size color = pixels.empty() ? calibration_.color.size : pixels.size;
    if (!points_ || points_->calibration().color.size != color) {
        Calibration calibration = calibration_;
        if (calibration.color.size.area() > 0)
            calibration.color = scaled(calibration.color, color);
        points_.emplace(calibration, undecoded_of_points_);
    }
    points_->append(frame, points);
    if (in_room)
        transform_points(calibration_.room_from_camera, points);
    return points;
}

std::uint64_t CameraView::undecoded() const {
    const std::lock_guard lock(mutex_);
    return undecoded_;
}

}  // namespace theatron::python
