// SPDX-License-Identifier: Apache-2.0
#include "bench_view.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "files/png_file.h"
#include "render/cloud_scene.h"
#include "render/offscreen_context_native.h"
#include "render/picture_quality.h"

namespace theatron::app {
namespace {

using render::CloudScene;
using render::Picture;

constexpr int before_last = ViewBenchCamera::frames - 2;

struct Figures {
    render::SquaredError seen, overlap, flicker, patterned, patterned_depth_sized;
    render::Similarity similarity;
    render::OutlineError outline;
    render::Holes holes;
};

void show(CloudScene& scene, const std::vector<ViewBenchCamera>& cameras, int frame) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const ViewBenchCamera& camera = cameras[i];
        scene.set_camera(CameraId(i), camera.calibration);
        if (scene.upload(CameraId(i), camera.depth[frame].view(), camera.color[frame].view()) !=
            Status::ok)
            throw Error("A generated camera's images do not have the size of its calibration.");
    }
}

void show_depth_sized(CloudScene& scene, const std::vector<ViewBenchCamera>& cameras, int frame) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const ViewBenchCamera& camera = cameras[i];
        const DepthSizedColor sized = depth_sized_color(
            camera.calibration, camera.depth[frame].view(), camera.color[frame].view());
        scene.set_camera(CameraId(i), sized.calibration);
        if (scene.upload(CameraId(i), camera.depth[frame].view(), sized.color.view()) != Status::ok)
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
        // Renderers may take the frames before into account: they see all of them.
        CloudScene scene, depth_sized;
        for (int frame = 0; frame < before_last; ++frame) {
            show(scene, truth.cameras, frame);
            show_depth_sized(depth_sized, truth.cameras, frame);
            for (const std::string& renderer : renderers) {
                (void)scene.render(truth.places[0].view, size, renderer);
                (void)depth_sized.render(truth.places[0].view, size, renderer);
            }
        }
        std::vector<std::vector<ColorImage>> before;
        show(scene, truth.cameras, before_last);
        for (const ViewBenchPlace& place : truth.places) {
            auto& pictures_here = before.emplace_back();
            for (const std::string& renderer : renderers)
                pictures_here.push_back(scene.render(place.view, size, renderer).color);
            progress("drawing", double(before.size()) / double(truth.places.size()));
        }
        show(scene, truth.cameras, before_last + 1);
        show_depth_sized(depth_sized, truth.cameras, before_last + 1);
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
        for (std::size_t p = 0; p < truth.close.size(); ++p) {
            const ViewBenchPlace& place = truth.close[p];
            const ColorView exact = place.exact_color.view();
            write(pictures, "close" + std::to_string(p) + "_exact", place.exact_color);
            for (std::size_t r = 0; r < renderers.size(); ++r) {
                const Picture fine = scene.render(place.view, size, renderers[r]);
                const Picture coarse = depth_sized.render(place.view, size, renderers[r]);
                figures[r].patterned.add(fine.color.view(), exact, place.patterned.view());
                figures[r].patterned_depth_sized.add(coarse.color.view(), exact,
                                                     place.patterned.view());
                const std::string name = "close" + std::to_string(p) + "_" + renderers[r];
                write(pictures, name, fine.color);
                write(pictures, name + "_depth_sized", coarse.color);
            }
        }
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
                        {"flicker_overlap", f.flicker.root_mean_square()},
                        {"psnr_patterned_db", f.patterned.psnr_db()},
                        {"psnr_patterned_depth_sized_db", f.patterned_depth_sized.psnr_db()}});
    }
    return {{"gl_renderer", context.renderer_name()},
            {"cameras", truth.cameras.size()},
            {"views", truth.places.size()},
            {"width", size.width},
            {"height", size.height},
            {"renderers", rows}};
}

}  // namespace theatron::app
