// SPDX-License-Identifier: Apache-2.0
// theatron background
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/steady_clock.h"
#include "capture/camera.h"
#include "cli/progress.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "filter/background.h"

namespace theatron::app {
namespace {

struct BackgroundFlags {
    std::string camera, out;
    int frames = 90;
    bool overwrite = false;
    bool json = false;
};

// A camera without a picture for this time is treated as ended.
constexpr Duration patience = std::chrono::seconds(12);

filter::Background record(const BackgroundFlags& flags) {
    const capture::Progress progress = cli::show_progress();
    const auto camera = capture::open_camera(flags.camera, progress);
    filter::Background background;
    background.depth_unit_mm = camera->info().calibration.depth_unit_mm;
    TimePoint last = steady_now();
    while (background.frames < flags.frames) {
        const capture::Capture got = camera->next(std::chrono::milliseconds(100));
        using Kind = capture::Capture::Kind;
        if (got.kind == Kind::failed)
            throw Error(got.problem);
        if (got.kind == Kind::end)
            throw Error("The recording ends after " + std::to_string(background.frames) +
                        " frames; ask for fewer with --frames, or add loop=1 to the camera.");
        if (got.kind == Kind::frame) {
            last = steady_now();
            if (!filter::add_frame(background, got.frame->depth.view()))
                throw Error("The camera changed the size of its depth pictures.");
            progress("recording the empty scene", double(background.frames) / flags.frames);
        } else if (steady_now() - last > patience) {
            throw Error("The camera gives no pictures.");
        }
    }
    return background;
}

void run(const BackgroundFlags& flags) {
    if (std::filesystem::exists(flags.out) && !flags.overwrite)
        throw Error("'" + flags.out + "' is there already; --overwrite replaces it.");
    const filter::Background background = record(flags);
    files::write_file(flags.out, filter::encode_background(background));

    const auto& pixels = background.nearest.pixels;
    const auto unknown = std::count(pixels.begin(), pixels.end(), std::uint16_t(0));
    const double measured = 1 - double(unknown) / double(pixels.size());
    if (flags.json) {
        std::printf("%s\n", files::json_text({{"path", flags.out},
                                              {"frames", background.frames},
                                              {"width", background.nearest.size.width},
                                              {"height", background.nearest.size.height},
                                              {"measured", measured}})
                                .c_str());
        return;
    }
    std::printf("%s: %d frames, %.1f %% of the pixels measured\n", flags.out.c_str(),
                background.frames, 100 * measured);
}

}  // namespace

void add_background_command(CLI::App& app) {
    CLI::App* background =
        app.add_subcommand("background", "Record the empty scene, to leave it out of streams");
    background->require_subcommand(1);
    const auto flags = std::make_shared<BackgroundFlags>();
    CLI::App* command = background->add_subcommand("record", "Record the empty scene of a camera");
    command->footer(
        "For each pixel the nearest that was measured is kept. Nobody may be in the picture.\n"
        "\nExample:\n"
        "  theatron background record --camera k4a:0 --out left.background\n"
        "then the filters default+background:file=left.background leave it out.");
    command->add_option("--camera", flags->camera, "The camera, kind:value,key=value")->required();
    command->add_option("--out", flags->out, "The file to write")->required();
    command->add_option("--frames", flags->frames, "Number of frames")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    command->add_flag("--overwrite", flags->overwrite, "Replace a file that is there");
    command->add_flag("--json", flags->json, "Print the figures as one JSON line");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
