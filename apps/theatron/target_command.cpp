// SPDX-License-Identifier: Apache-2.0
// theatron target
#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "board_option.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "registration/target_drawing.h"

namespace theatron::app {
namespace {

struct TargetFlags {
    BoardFlags board;
    std::string out;
    bool overwrite = false;
};

void run(const TargetFlags& flags) {
    const registration::LatticeTarget target = board_of(flags.board);
    const std::string ending = std::filesystem::path(flags.out).extension().string();
    if (ending != ".svg" && ending != ".dxf")
        throw Error("'" + flags.out + "' ends neither in .svg nor in .dxf.");
    files::require_new(flags.out, flags.overwrite);
    const std::string drawing =
        ending == ".svg" ? registration::svg_drawing(target) : registration::dxf_drawing(target);
    files::write_file(flags.out, std::as_bytes(std::span(drawing)));
    std::printf("%s: %.0f x %.0f mm, bars %.0f mm, at true scale\n", flags.out.c_str(),
                target.width_m * 1000, target.height_m * 1000, target.bar_m * 1000);
}

}  // namespace

void add_target_command(CLI::App& app) {
    const auto flags = std::make_shared<TargetFlags>();
    CLI::App* command =
        app.add_subcommand("target", "Draw the board that 'theatron register' looks for");
    command->footer(
        "Cut it from a flat, light, matt material, holes and outline. Depth cameras see the "
        "holes,\n"
        "so a print on a plate that is not cut is of no use.\n"
        "\nExamples:\n"
        "  theatron target --out board.dxf\n"
        "  theatron target --board a2 --thickness 5 --out board.svg");
    add_board_options(*command, flags->board);
    command->add_option("--out", flags->out, "The drawing to write: FILE.svg or FILE.dxf")
        ->required();
    command->add_flag("--overwrite", flags->overwrite, "Replace a drawing that is there");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
