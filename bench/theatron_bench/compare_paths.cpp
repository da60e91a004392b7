// SPDX-License-Identifier: Apache-2.0
#include "compare_paths.h"

#include <utility>

#include "base/error.h"
#include "bench_libjpeg.h"
#include "compare_coders.h"
#include "compare_pcl.h"
#include "compare_points.h"
#include "filter/chain.h"
#include "filter/color_registration.h"

namespace theatron::bench {
namespace {

constexpr Duration between_pictures = Duration(33'333);

filter::Chain filters_of(const std::string& chain, const Calibration& calibration) {
    return {filter::parse_chain(chain).settings,
            {.size = calibration.depth.size, .depth_unit_mm = calibration.depth_unit_mm}};
}

// Depth with the colour of each of its pixels, as in programs that send points: depth without
// colour is left out.
class RegisteredImages {
public:
    RegisteredImages(const Calibration& calibration, const std::string& chain)
        : filters_(filters_of(chain, calibration)),
          registration_(calibration),
          jpeg_(video::make_color_decoder(video::ColorCodecId::jpeg)),
          seen(calibration.depth.size) {
        color.size = calibration.depth.size;
        color.pixels.resize(color.size);
    }

    void take(const DepthImage& measured, const ColorData& picture) {
        if (jpeg_->submit(picture.jpeg, 0) != Status::ok)
            throw Error("A picture of the generated room is damaged.");
        auto decoded = jpeg_->poll();
        depth = copy_of(filters_.apply(measured.view(), between_pictures));
        registration_.apply(depth.view(), decoded->image.view(), color.pixels.view(), seen.view());
        jpeg_->recycle(std::move(decoded->image));
        for (std::size_t i = 0; i < seen.pixels.size(); ++i)
            if (seen.pixels[i] == 0)
                depth.pixels[i] = 0;
    }

private:
    filter::Chain filters_;
    filter::ColorRegistration registration_;
    std::unique_ptr<video::ColorDecoder> jpeg_;

public:
    DepthImage depth;
    ColorData color;
    Image<std::uint8_t> seen;
};

class VideoPath final : public CameraPath {
public:
    explicit VideoPath(const std::string& codec) : color_(codec) {}

    std::size_t send(const CompareCamera& camera, std::size_t number) override {
        return color_.encode(camera.color[number]);
    }
    void receive(ArrivedCamera& arrived) override { arrived.color.push_back(color_.decode()); }

private:
    ColorCoder color_;
};

class PaperPath final : public CameraPath {
public:
    explicit PaperPath(const CompareCamera& camera) : images_(camera.calibration, "paper") {}

    std::size_t send(const CompareCamera& camera, std::size_t number) override {
        images_.take(camera.depth[number], camera.color[number]);
        const std::size_t depth_bytes = depth_.encode(images_.depth.view());
        return depth_bytes + color_.encode(images_.color);
    }
    void receive(ArrivedCamera& arrived) override {
        arrived.depth.push_back(depth_.decode());
        arrived.color.push_back(color_.decode());
    }
    void finish(ArrivedCamera& arrived, std::vector<PictureCost>&) override {
        arrived.calibration.color = arrived.calibration.depth;
        arrived.calibration.color_from_depth = {};
    }

private:
    RegisteredImages images_;
    ColorCoder color_{make_libjpeg_encoder(video::parse_color_setting("jpeg:quality=85").setting),
                      make_libjpeg_decoder()};
    DepthCoder depth_{"trvl"};
};

class TheatronPath final : public CameraPath {
public:
    TheatronPath(const CompareCamera& camera, const std::string& color_codec)
        : filters_(filters_of("default", camera.calibration)), color_(color_codec) {}

    std::size_t send(const CompareCamera& camera, std::size_t number) override {
        const std::size_t depth_bytes =
            depth_.encode(filters_.apply(camera.depth[number].view(), between_pictures));
        return depth_bytes + color_.encode(camera.color[number]);
    }
    void receive(ArrivedCamera& arrived) override {
        arrived.depth.push_back(depth_.decode());
        arrived.color.push_back(color_.decode());
    }

private:
    filter::Chain filters_;
    ColorCoder color_;
    DepthCoder depth_{"strata"};
};

// Another program encodes and decodes, all pictures at once.
class PclPath final : public CameraPath {
public:
    explicit PclPath(const CompareCamera& camera)
        : images_(camera.calibration, "default"), rays_(make_ray_table(camera.calibration.depth)) {}

    std::size_t send(const CompareCamera& camera, std::size_t number) override {
        images_.take(camera.depth[number], camera.color[number]);
        clouds_.push_back(cloud_of(camera.calibration, rays_, images_.depth.view(),
                                   images_.color.pixels.view(),
                                   std::as_const(images_.seen).view()));
        return 0;
    }
    void receive(ArrivedCamera& arrived) override { arrived.depth = {images_.depth}; }
    void finish(ArrivedCamera& arrived, std::vector<PictureCost>& costs) override {
        PclFigures figures = pcl_figures(clouds_);
        for (std::size_t i = 0; i < clouds_.size(); ++i) {
            costs[i].bytes += std::size_t(figures.clouds[i].bytes);
            costs[i].sender_ms += figures.clouds[i].encode_ms;
            costs[i].receiver_ms = figures.clouds[i].decode_ms;
        }
        arrived.library = "PCL " + figures.version;
        arrived.points = std::move(figures.last);
        arrived.point_grid_m = figures.resolution_m;
        // Points of a grid touch if they are as large as its cells are wide at a slant.
        arrived.point_edge_m = figures.resolution_m * 1.5;
    }

private:
    RegisteredImages images_;
    Image<Ray> rays_;
    std::vector<PointCloud> clouds_;
};

}  // namespace

std::unique_ptr<CameraPath> make_video_path(const std::string& color_codec) {
    return std::make_unique<VideoPath>(color_codec);
}

std::unique_ptr<CameraPath> make_paper_path(const CompareCamera& camera) {
    return std::make_unique<PaperPath>(camera);
}

std::unique_ptr<CameraPath> make_theatron_path(const CompareCamera& camera,
                                               const std::string& color_codec) {
    return std::make_unique<TheatronPath>(camera, color_codec);
}

std::unique_ptr<CameraPath> make_pcl_path(const CompareCamera& camera) {
    return std::make_unique<PclPath>(camera);
}

}  // namespace theatron::bench
