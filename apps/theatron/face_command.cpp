// SPDX-License-Identifier: Apache-2.0
// theatron face
#include "face_command.h"

#include <memory>

#include "cli/seconds_option.h"
#include "commands.h"

namespace theatron::app {
namespace {

constexpr const char* synthetic_remark =
    "Figures of synthetic persons say how well the network learned a model of faces, and not how "
    "well\nit reads real ones. docs/face.md tells more.\n";

void add_port_options(CLI::App& command, visit::FacePort& port, const char* what) {
    command.add_option("--port", port.port, what)
        ->capture_default_str()
        ->check(CLI::Range(1, 65535));
    command
        .add_option("--address", port.address,
                    "This machine's address there; 0.0.0.0 for all: packets are not encrypted")
        ->capture_default_str();
}

void add_train(CLI::App& face) {
    const auto wanted = std::make_shared<FaceTrain>();
    CLI::App* command = face.add_subcommand(
        "train", "Train the network that tells six emotions, and show how well it does");
    command->footer(std::string(synthetic_remark) +
                    "\nExamples:\n"
                    "  theatron face train --source xr_fb --out face.net\n"
                    "  theatron face train --source unified --own me.csv --out me.net");
    command
        ->add_option("--source", wanted->source,
                     "The tracker: arkit, unified (VRCFaceTracking), xr_fb or xr_htc")
        ->capture_default_str();
    command->add_option("--own", wanted->own,
                        "Your own takes, of 'theatron face record'; of the same source");
    command->add_option("--out", wanted->out, "The network's file, which only you may read")
        ->required();
    command->add_option("--seed", wanted->seed, "Seed of the synthetic persons")
        ->capture_default_str();
    command->add_flag("--overwrite", wanted->overwrite, "Replace a file that is there");
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_face_train(*wanted); });
}

void add_test(CLI::App& face) {
    const auto wanted = std::make_shared<FaceTest>();
    CLI::App* command = face.add_subcommand(
        "test", "Show how well a network tells the emotions of recordings that it did not learn");
    command->footer(
        "A data set of XR_FB_face_tracking needs three lines before its columns; "
        "docs/face.md has them.\n"
        "\nExample:\n"
        "  theatron face test face.net others.csv");
    command->add_option("model", wanted->model, "The network, of 'theatron face train'")
        ->required();
    command->add_option("recordings", wanted->recordings, "Recordings, as CSV")->required();
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_face_test(*wanted); });
}

void add_listen(CLI::App& face) {
    const auto wanted = std::make_shared<FaceListen>();
    CLI::App* command = face.add_subcommand(
        "listen", "Show whether a face tracker's packets arrive, and what the network tells");
    command->footer(
        "VRCFaceTracking sends to port 9000: set it to 9001, or listen on 9000.\n"
        "With a model, rest your face for the first two seconds. What is told is a guess about a "
        "face's\nmuscles, not about what a person feels.\n"
        "\nExamples:\n"
        "  theatron face listen\n"
        "  theatron face listen --port 9000 --model face.net");
    add_port_options(*command, wanted->at, "UDP port on which the tracker's packets arrive");
    command->add_option("--model", wanted->model, "The network, of 'theatron face train'");
    cli::add_seconds_option(*command, wanted->seconds, "End after this long (default: Ctrl-C)");
    command->add_flag("--json", wanted->json, "Print a JSON line each second, and one at the end");
    command->callback([wanted] { run_face_listen(*wanted); });
}

void add_record(CLI::App& face) {
    const auto wanted = std::make_shared<FaceRecord>();
    CLI::App* command =
        face.add_subcommand("record", "Record your own takes of the six emotions, by prompts");
    command->footer(
        "The recording identifies you. It stays on this machine, in a file that only you may "
        "read.\n"
        "\nExample:\n"
        "  theatron face record --out me.csv");
    add_port_options(*command, wanted->at, "UDP port on which the tracker's packets arrive");
    command->add_option("--source", wanted->source, "The tracker, as for 'theatron face train'")
        ->capture_default_str();
    command->add_option("--rounds", wanted->rounds, "Takes of each emotion")
        ->capture_default_str()
        ->check(CLI::Range(1, 20));
    cli::add_seconds_option(*command, wanted->take_s, "Length of a take (default: 4)", "--take");
    command->add_option("--out", wanted->out, "The recording to write, as CSV")->required();
    command->add_flag("--overwrite", wanted->overwrite, "Replace a file that is there");
    command->callback([wanted] { run_face_record(*wanted); });
}

void add_act(CLI::App& face) {
    const auto wanted = std::make_shared<FaceAct>();
    CLI::App* command =
        face.add_subcommand("act", "Send a scripted face's packets, where there is no tracker");
    command->footer(
        "Each emotion is shown for three seconds: neutral, happiness, surprise, neutral, sadness, "
        "disgust,\nanger.\n"
        "\nExample:\n"
        "  theatron face act --port 9001 --seconds 21");
    add_port_options(*command, wanted->to, "UDP port to which it sends");
    command
        ->add_option("--source", wanted->source,
                     "The tracker whose channels it sends, as for 'theatron face train'")
        ->capture_default_str();
    cli::add_seconds_option(*command, wanted->seconds, "End after this long (default: Ctrl-C)");
    command->callback([wanted] { run_face_act(*wanted); });
}

}  // namespace

void add_face_command(CLI::App& app) {
    CLI::App* face = app.add_subcommand(
        "face",
        "The face under a headset: trackers, the network that tells six emotions, your own face");
    face->require_subcommand(1);
    face->footer("docs/face.md tells what is measured, what is guessed and what stays private.");
    add_train(*face);
    add_test(*face);
    add_listen(*face);
    add_record(*face);
    add_act(*face);
    add_own_face_commands(*face);
}

}  // namespace theatron::app
