// SPDX-License-Identifier: Apache-2.0
#include "capture/cropped_camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/lasting_error.h"
#include "capture/crop.h"
#include "video/camera_pixels_native.h"
#include "video/jpeg_crop_native.h"

namespace theatron::capture {
namespace {

// Distances of hands and instruments, for "auto".
constexpr double near_m = 0.3, far_m = 8;

std::string in_words(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Crop whole(Size size) {
    return {0, 0, size};
}

Crop read_crop(const char* key, const std::string& text, Size picture) {
    const auto crop = parse_crop(text);
    if (!crop)
        throw LastingError(std::string(key) + "=" + text + " is not X:Y:WxH, for example " + key +
                           "=50:50:540x476.");
    if (!lies_in(*crop, picture))
        throw LastingError(std::string(key) + "=" + text + " reaches beyond the picture of " +
                           in_words(picture) + ".");
    return *crop;
}

// Extends the crop so that its corner is on a JPEG block.
Crop on_blocks(const Crop& crop) {
    const int dx = crop.x % video::JpegCropper::block, dy = crop.y % video::JpegCropper::block;
    return {crop.x - dx, crop.y - dy, {crop.size.width + dx, crop.size.height + dy}};
}

Crop color_part(const CropOptions& options, const Calibration& calibration) {
    const Size size = calibration.color.size;
    if (options.color.empty() || options.color == "off")
        return whole(size);
    if (options.color != "auto")
        return on_blocks(read_crop("color_crop", options.color, size));
    const Crop seen = color_seen_by_depth(calibration, near_m, far_m);
    if (!lies_in(seen, size))
        throw Error(
            "color_crop=auto: the depth camera sees nothing of what the colour camera sees.");
    return on_blocks(seen);
}

Size color_size(const CropOptions& options, const Calibration& calibration, Size part) {
    if (options.color_size.empty())
        return part;
    Size size;
    if (options.color_size == "depth") {
        const double scale = calibration.depth.fx / calibration.color.fx;
        size = {std::clamp(int(std::lround(part.width * scale)), 1, part.width),
                std::clamp(int(std::lround(part.height * scale)), 1, part.height)};
        return size;
    }
    const auto parsed = parse_size(options.color_size);
    if (!parsed)
        throw LastingError("color_size=" + options.color_size +
                           " is not WIDTHxHEIGHT or depth, for example color_size=1280x720.");
    if (parsed->width > part.width || parsed->height > part.height)
        throw LastingError("color_size=" + options.color_size +
                           " is larger than the colour there is, " + in_words(part) + ".");
    return *parsed;
}

template <class T>
void copy_part(const Image<T>& image, const Crop& crop, Image<T>& out) {
    out.resize(crop.size);
    copy_pixels(part_of(image.view(), crop), out.view());
}

class CroppedCamera final : public Camera {
public:
    CroppedCamera(std::unique_ptr<Camera> camera, const CropOptions& options)
        : camera_(std::move(camera)), info_(camera_->info()) {
        Calibration& c = info_.calibration;
        depth_whole_ = c.depth.size;
        depth_ = options.depth.empty() ? whole(depth_whole_)
                                       : read_crop("crop", options.depth, depth_whole_);
        c.depth = cropped(c.depth, depth_);
        color_whole_ = c.color.size;
        if (color_whole_ == Size{}) {
            if (!options.color_size.empty() || !(options.color.empty() || options.color == "off"))
                throw Error("The camera '" + info_.name +
                            "' gives no colour that could be cropped.");
            return;
        }
        color_ = color_part(options, c);
        c.color = cropped(c.color, color_);
        color_size_ = color_size(options, c, color_.size);
        c.color = scaled(c.color, color_size_);
    }

    const CameraInfo& info() const override { return info_; }
    void follow(std::shared_ptr<Transport> transport) override {
        camera_->follow(std::move(transport));
    }
    bool skip_none() override { return camera_->skip_none(); }
    std::uint64_t lost_pictures() const override {
        return camera_->lost_pictures() + damaged_colors_;
    }

    Capture next(Duration timeout) override {
        Capture capture = camera_->next(timeout);
        if (capture.kind != Capture::Kind::frame)
            return capture;
        const Frame& from = *capture.frame;
        if (from.depth.size != depth_whole_)
            return {Capture::Kind::failed, nullptr,
                    "The camera '" + info_.name + "' changed the size of its depth pictures."};
        const auto out = frames_.take();
        out->number = from.number;
        out->times = from.times;
        copy_part(from.depth, depth_, out->depth);
        convert_color(from.color, out->color);
        damaged_colors_ += out->color.empty() && !from.color.empty();
        capture.frame = out;
        return capture;
    }

private:
    // A damaged colour picture is dropped; its depth is kept.
    void convert_color(const ColorData& from, ColorData& out) {
        out.jpeg.clear();
        out.pixels.pixels.clear();
        out.pixels.size = out.size = {};
        if (from.empty() || from.size != color_whole_)
            return;
        if (color_size_ == color_whole_) {
            out = from;
            return;
        }
        if (color_size_ == color_.size && from.is_jpeg()) {
            const auto part = jpeg_.crop(from.jpeg, color_.x, color_.y, color_.size);
            if (part)
                out.jpeg.assign(part->begin(), part->end());
            if (part)
                out.size = color_.size;
            // JPEG with larger blocks than usual is decoded to pixels instead.
            if (part || part.error() != Status::unsupported)
                return;
        }
        const auto image = pixels_.of(from);
        if (!image || image->size != color_whole_)
            return;
        const ColorView part = part_of(*image, color_);
        out.size = color_size_;
        out.pixels.resize(color_size_);
        scale_by_area(part, out.pixels.view());
    }

    std::unique_ptr<Camera> camera_;
    CameraInfo info_;
    Size depth_whole_, color_whole_;
    Crop depth_, color_;
    Size color_size_;
    std::uint64_t damaged_colors_ = 0;
    FramePool frames_;
    video::JpegCropper jpeg_;
    video::CameraPixels pixels_;
};

}  // namespace

CropOptions take_crop_options(Options& options) {
    CropOptions crop;
    crop.depth = options.take("crop");
    crop.color = options.take("color_crop");
    crop.color_size = options.take("color_size");
    return crop;
}

std::unique_ptr<Camera> make_cropped_camera(std::unique_ptr<Camera> camera,
                                            const CropOptions& options) {
    return std::make_unique<CroppedCamera>(std::move(camera), options);
}

}  // namespace theatron::capture
