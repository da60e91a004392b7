// SPDX-License-Identifier: Apache-2.0
#include "bench_view.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "files/png_file.h"
#include "render/cloud_set.h"
#include "render/offscreen_context_native.h"
#include "render/picture_quality.h"

namespace theatron::bench {
namespace {

using render::CloudSet;
using render::Picture;

constexpr int before_last = ViewBenchCamera::frames - 2;

struct Figures {
    render::SquaredError seen, overlap, flicker;
    std::vector<render::SquaredError> patterned;  // by kind of colour
    render::Similarity similarity;
    render::OutlineError outline;
    render::Holes holes;
};

// The colour that a viewer receives with the depth.
struct ColorKind {
    const char *key, *picture;  // in JSON, and in file names
    ViewBenchImages (*images)(const ViewBenchCamera& camera, int frame);
};

ViewBenchImages whole_color(const ViewBenchCamera& camera, int frame) {
    return {camera.calibration, camera.depth[frame], camera.color[frame]};
}

ViewBenchImages fine_color(const ViewBenchCamera& camera, int frame) {
    ViewBenchImages images{camera.calibration, camera.depth[frame], camera.fine_color};
    images.calibration.color = camera.fine_model;
    return images;
}

constexpr ColorKind color_kinds[] = {
    {"psnr_patterned_db", "", whole_color},
    {"psnr_patterned_fine_db", "_fine", fine_color},
    {"psnr_patterned_depth_sized_db", "_depth_sized",
     [](const ViewBenchCamera& camera, int frame) {
         return depth_sized_color(camera.calibration, camera.depth[frame].view(),
                                  camera.color[frame].view());
     }},
    {"psnr_patterned_registered_db", "_registered", [](const ViewBenchCamera& camera, int frame) {
         return registered_color(camera.calibration, camera.depth[frame].view(),
                                 camera.color[frame].view());
     }}};

void show(CloudSet& scene, const std::vector<ViewBenchCamera>& cameras, int frame,
          const ColorKind& kind) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const ViewBenchImages images = kind.images(cameras[i], frame);
        scene.set_camera(CameraId(i), images.calibration);
        if (scene.upload(CameraId(i), images.depth.view(), images.color.view()) != Status::ok)
            throw Error("A generated camera's images do not have the size of its calibration.");
    }
}

void write(const std::string& folder, const std::string& name, const ColorImage& picture) {
    if (folder.empty())
        return;
    std::filesystem::create_directories(folder);
    files::write_png(std::filesystem::path(folder) / (name + ".png"), picture.view());
}

}  // namespace

nlohmann::json bench_view(const ViewBenchScene& truth, std::vector<std::string> renderers,
                          const std::string& pictures, const capture::Progress& progress) {
    if (renderers.empty())
        renderers = render::renderer_names();
    const Size size = truth.places.front().exact_color.size;

    render::OffscreenContext context;
    std::vector<Figures> figures(renderers.size());
    {
        // Renderers may use earlier frames, so all frames are shown in order.
        CloudSet scene;
        for (int frame = 0; frame < before_last; ++frame) {
            show(scene, truth.cameras, frame, color_kinds[0]);
            for (const std::string& renderer : renderers)
                (void)scene.render(truth.places[0].view, size, renderer);
        }
        std::vector<std::vector<ColorImage>> before;
        show(scene, truth.cameras, before_last, color_kinds[0]);
        for (const ViewBenchPlace& place : truth.places) {
            auto& pictures_here = before.emplace_back();
            for (const std::string& renderer : renderers)
                pictures_here.push_back(scene.render(place.view, size, renderer).color);
            progress("drawing", double(before.size()) / double(truth.places.size()));
        }
        show(scene, truth.cameras, before_last + 1, color_kinds[0]);
        for (std::size_t p = 0; p < truth.places.size(); ++p) {
            const ViewBenchPlace& place = truth.places[p];
            const ColorView exact = place.exact_color.view();
            write(pictures, "view" + std::to_string(p) + "_exact", place.exact_color);
            for (std::size_t r = 0; r < renderers.size(); ++r) {
                const Picture drawn = scene.render(place.view, size, renderers[r]);
                Figures& f = figures[r];
                f.seen.add(drawn.color.view(), exact, place.seen.view());
                f.overlap.add(drawn.color.view(), exact, place.overlap.view());
                f.similarity.add(drawn.color.view(), exact, place.seen.view());
                f.flicker.add(drawn.color.view(), before[p][r].view(), place.overlap.view());
                f.outline.add(drawn.depth_mm.view(), place.exact_mm.view(), place.person.view());
                f.holes.add(drawn.depth_mm.view(), place.exact_mm.view(), place.person.view());
                write(pictures, "view" + std::to_string(p) + "_" + renderers[r], drawn.color);
            }
            progress("drawing and comparing", double(p + 1) / double(truth.places.size()));
        }
    }
    for (const ColorKind& kind : color_kinds) {
        CloudSet scene;
        for (int frame = 0; frame < ViewBenchCamera::frames; ++frame) {
            show(scene, truth.cameras, frame, kind);
            for (const std::string& renderer : renderers)
                (void)scene.render(truth.close[0].view, size, renderer);
        }
        for (std::size_t r = 0; r < renderers.size(); ++r) {
            render::SquaredError& error = figures[r].patterned.emplace_back();
            for (std::size_t p = 0; p < truth.close.size(); ++p) {
                const ViewBenchPlace& place = truth.close[p];
                const Picture drawn = scene.render(place.view, size, renderers[r]);
                error.add(drawn.color.view(), place.exact_color.view(), place.patterned.view());
                const std::string name = "close" + std::to_string(p) + "_";
                write(pictures, name + "exact", place.exact_color);
                write(pictures, name + renderers[r] + kind.picture, drawn.color);
            }
        }
        progress("drawing patterns", double(&kind - color_kinds + 1) / std::size(color_kinds));
    }
    if (context.errors() > 0)
        throw Error("The graphics driver reports an error: " + context.first_error());

    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t r = 0; r < renderers.size(); ++r) {
        const Figures& f = figures[r];
        rows.push_back({{"name", renderers[r]},
                        {"psnr_db", f.seen.psnr_db()},
                        {"psnr_overlap_db", f.overlap.psnr_db()},
                        {"ssim", f.similarity.mean()},
                        {"holes_percent", f.holes.percent()},
                        {"silhouette_px", f.outline.mean_px()},
                        {"flicker_overlap", f.flicker.root_mean_square()}});
        for (std::size_t k = 0; k < std::size(color_kinds); ++k)
            rows.back()[color_kinds[k].key] = f.patterned[k].psnr_db();
    }
    return {{"gl_renderer", context.renderer_name()},
            {"cameras", truth.cameras.size()},
            {"views", truth.places.size()},
            {"width", size.width},
            {"height", size.height},
            {"renderers", rows}};
}

}  // namespace theatron::bench
