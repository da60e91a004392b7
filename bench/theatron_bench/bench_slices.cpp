// SPDX-License-Identifier: Apache-2.0
#include "bench_slices.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/statistics.h"
#include "bench_report.h"
#include "cases/case_folder.h"
#include "render/gl.h"
#include "render/offscreen_context_native.h"
#include "render/render_target.h"
#include "render/room_picture.h"
#include "viewer/monitor.h"
#include "window/font.h"

namespace theatron::bench {
namespace {

constexpr Size picture_size{1280, 720};
constexpr const char* orientation_names[] = {"axial", "coronal", "sagittal"};

// The screen of a case before an eye, as a window draws it, without clouds and room.
class ScreenBench {
public:
    explicit ScreenBench(const std::string& folder) {
        cases::LoadedCase loaded = cases::read_case(folder);
        if (loaded.volumes.empty())
            throw Error("The case '" + folder + "' has no images.");
        content_.description.emplace();
        content_.description->series.resize(1);
        content_.volumes = {
            std::make_shared<const medical::Volume>(std::move(loaded.volumes.front()))};
        room_.emplace();
        room_->screen = session::CaseInRoom::Screen{};
        room_->screen->object.room_from_object = {{}, {0, 1.5, 0}};
    }

    // Draws every slice, from the first to the last.
    nlohmann::json run(int orientation) {
        const medical::Volume& volume = *content_.volumes[0];
        const medical::SliceRange range =
            medical::slice_range(volume.grid, medical::Orientation(orientation));
        session::CaseScreen& screen = room_->screen->facts;
        screen.orientation = std::uint8_t(orientation);
        SampleWindow all_ms{std::size_t(range.count) + 1}, made_ms = all_ms;
        // The first picture makes the textures.
        for (int i = -1; i < range.count; ++i) {
            screen.position_mm = range.first_mm + std::max(i, 0) * range.step_mm;
            const Times times = draw();
            if (i <= 0)
                continue;
            all_ms.add(times.all_ms);
            made_ms.add(times.made_ms);
        }
        return {{"orientation", orientation_names[orientation]},
                {"slices", range.count},
                {"made_p50_ms", made_ms.percentile(0.5)},
                {"p50_ms", all_ms.percentile(0.5)},
                {"p99_ms", all_ms.percentile(0.99)}};
    }
    std::string renderer_name() const { return gl_.renderer_name(); }

private:
    struct Times {
        double made_ms = 0;  // the slice, as a texture
        double all_ms = 0;
    };
    Times draw() {
        Times times;
        glFinish();
        const auto start = std::chrono::steady_clock::now();
        const auto since_ms = [&] {
            const auto time = std::chrono::steady_clock::now() - start;
            return std::chrono::duration<double, std::milli>(time).count();
        };
        monitor_.take(room_, &content_);
        render::SceneFrame frame;
        frame.quality = render::SceneQuality::low;
        monitor_.add_to(frame, *room_, {}, view_);
        times.made_ms = since_ms();
        target_.clear({});
        render::draw({&frame, {}, {{view_, target_.target()}}}, &passes_);
        glFinish();
        times.all_ms = since_ms();
        return times;
    }

    render::OffscreenContext gl_;
    render::RenderTarget target_{picture_size};
    render::FontAtlas font_ = render::load_font_atlas(window::text_font());
    render::ScenePasses passes_{&font_};
    const render::CameraView view_ =
        render::view_towards({0, 1.5, 0.7}, {0, 1.5, 0}, 60, picture_size);
    client::OpenCase content_;
    std::optional<session::CaseInRoom> room_;
    viewer::Monitor monitor_;
};

}  // namespace

void add_slices_bench(CLI::App& bench) {
    struct Flags {
        std::string folder, json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand(
        "slices", "A case's images: time from another slice to its finished picture");
    command->footer("Example: theatron bench slices my-case --json -");
    command->add_option("CASE", flags->folder, "A case's folder")->required();
    add_json_option(*command, flags->json);
    command->callback([flags] {
        ScreenBench screen(flags->folder);
        nlohmann::json r{{"gl_renderer", screen.renderer_name()},
                         {"width", picture_size.width},
                         {"height", picture_size.height}};
        for (int orientation = 0; orientation < 3; ++orientation)
            r["orientations"].push_back(screen.run(orientation));
        report(r, flags->json, [&] {
            std::printf("%s, %dx%d, the screen alone\n",
                        r["gl_renderer"].get<std::string>().c_str(), picture_size.width,
                        picture_size.height);
            for (const auto& one : r["orientations"])
                std::printf(
                    "  %-9s %4d slices: made in %5.2f ms, drawn after %6.2f ms, 99 of 100 within "
                    "%6.2f ms\n",
                    one["orientation"].get<std::string>().c_str(), one["slices"].get<int>(),
                    one["made_p50_ms"].get<double>(), one["p50_ms"].get<double>(),
                    one["p99_ms"].get<double>());
        });
    });
}

}  // namespace theatron::bench
