// SPDX-License-Identifier: Apache-2.0
// theatron photon
#include <memory>

#include "cli/number_check.h"
#include "cli/seconds_option.h"
#include "commands.h"
#include "join_pictures.h"
#include "photon_check.h"
#include "photon_film.h"
#include "photon_read.h"
#include "photon_show.h"

namespace theatron::app {
namespace {

struct ShowFlags {
    PhotonShow show;
    std::string size = "1280x560";
};

void add_photon_show(CLI::App& photon) {
    const auto flags = std::make_shared<ShowFlags>();
    CLI::App* command = photon.add_subcommand("show", "Show this computer's time as a strip");
    command->footer(
        "Escape closes the window.\n"
        "\nExamples:\n"
        "  theatron photon show --full-screen");
    command->add_flag("--full-screen", flags->show.full_screen, "Fill the screen");
    command->add_option("--size", flags->size, "Size of the window")->capture_default_str();
    cli::add_seconds_option(*command, flags->show.seconds, "End after this long");
    command->callback([flags] {
        flags->show.size = parse_size(flags->size);
        run_photon_show(flags->show);
    });
}

void add_read(CLI::App& photon) {
    const auto wanted = std::make_shared<PhotonRead>();
    CLI::App* command = photon.add_subcommand(
        "read", "Tell how old the strip is that pictures of a session or a camera show");
    command->footer(
        "The strip must be shown on this computer, by 'theatron photon show' or the camera "
        "'strip':\nits age is then known from one clock.\n"
        "\nExamples:\n"
        "  theatron photon read LINK --plot stages.svg\n"
        "  theatron photon read x11:Theatron --seconds 30\n"
        "  theatron photon read v4l2:/dev/video0\n"
        "  theatron photon read picture.png");
    command
        ->add_option("source", wanted->sources,
                     "A session's link (or @FILE with it), whose pictures are drawn here; a "
                     "camera, kind:value, for example a window of this display; or pictures, "
                     "of which the times are told")
        ->required();
    cli::add_seconds_option(*command, wanted->seconds, "Read for this long (default: 10)");
    command->add_option("--view", wanted->view, "Of a session: as for 'theatron join'")
        ->capture_default_str();
    command->add_option("--size", wanted->size, "Of a session: size of the pictures")
        ->capture_default_str();
    command->add_option("--renderer", wanted->renderer, "Of a session: as for 'theatron join'")
        ->capture_default_str();
    command
        ->add_option("--depth-codec", wanted->depth_codec, "Of a session: how the host sends depth")
        ->capture_default_str();
    command
        ->add_option("--color-codec", wanted->color_codec,
                     "Of a session: how the host sends colour")
        ->capture_default_str();
    command->add_option("--save", wanted->save, "Write the last picture into this PNG file");
    command->add_option("--plot", wanted->plot,
                        "Of a session: draw the stages of the age into this SVG file");
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_photon_read(*wanted); });
}

void add_film(CLI::App& photon) {
    const auto wanted = std::make_shared<PhotonFilm>();
    CLI::App* command = photon.add_subcommand(
        "film", "Measure motion to photon from a film of the scene's screen and the display");
    command->footer(
        "The film shows the screen of 'theatron photon show' and, beside it, the display on which "
        "a\nparticipant sees that screen. A phone's slow motion is best; the strip tells its "
        "speed.\n"
        "\nExamples:\n"
        "  theatron photon film phone.mp4\n"
        "  theatron photon film phone.mp4 --plot latency.svg --json");
    command->add_option("film", wanted->film, "The film: any file that FFmpeg reads")->required();
    command
        ->add_option("--refresh", wanted->refresh_hz,
                     "Refreshes a second of the scene's screen, which a film with fewer frames "
                     "cannot tell")
        ->capture_default_str()
        ->check(cli::number_from_to(20.0, 1000.0));
    command->add_option("--plot", wanted->plot, "Draw all latencies into this SVG file");
    command->add_flag("--overwrite", wanted->overwrite, "Replace a plot that is there");
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_photon_film(*wanted); });
}

void add_photon_check(CLI::App& photon) {
    const auto wanted = std::make_shared<PhotonCheck>();
    CLI::App* command = photon.add_subcommand(
        "check", "Tell how wrong 'photon film' is, by films with known delays");
    command->footer(
        "The films are drawn by this program: 20 to 200 ms, with blur, noise, perspective and "
        "rolling\nexposure. It takes some minutes.\n"
        "\nExample:\n"
        "  theatron photon check --films 4");
    command->add_option("--films", wanted->films, "Films at each of 240, 60 and 30 frames a second")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_photon_check(*wanted); });
}

}  // namespace

void add_photon_command(CLI::App& app) {
    CLI::App* photon = app.add_subcommand(
        "photon", "Measure the time from a change in the scene to the light of the display");
    photon->require_subcommand(1);
    photon->footer("docs/measuring.md tells what each figure means.");
    add_photon_show(*photon);
    add_read(*photon);
    add_film(*photon);
    add_photon_check(*photon);
}

}  // namespace theatron::app
