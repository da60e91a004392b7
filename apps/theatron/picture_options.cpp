// SPDX-License-Identifier: Apache-2.0
#include "picture_options.h"

#include "cli/choice_check.h"
#include "cli/seconds_option.h"
#include "phrases/language.h"
#include "viewer/renderer_text.h"

namespace theatron::app {

std::string join_names(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

namespace {

std::vector<std::string> language_codes() {
    std::vector<std::string> codes;
    for (const LanguageFacts& language : languages)
        codes.emplace_back(language.code);
    return codes;
}

// "en (English), de (German)".
std::string named_languages() {
    std::vector<std::string> names;
    for (const LanguageFacts& language : languages)
        names.push_back(std::string(language.code) + " (" + std::string(language.name) + ")");
    return join_names(names);
}

}  // namespace

void add_language_option(CLI::App& command, std::string& language) {
    command
        .add_option("--language", language,
                    "Language of the texts in the window, and of news: " + named_languages())
        ->check(cli::one_of(language_codes()))
        ->capture_default_str();
}

void add_picture_options(CLI::App& command, JoinFlags& flags) {
    add_language_option(command, flags.language);
    command.add_option("--offscreen", flags.offscreen,
                       "Without a window: draw the last picture into this PNG file");
    command.add_option("--depth", flags.depth_file,
                       "Write the clouds' depth in that picture, in millimetres, into this 16-bit "
                       "PNG file");
    command
        .add_option(
            "--renderer", flags.renderer,
            join_names(viewer::renderer_choices()) +
                "; auto is blend for two cameras and more, in a window whatever keeps up. The "
                "host may set another")
        ->default_str("that of your last window, else auto");
    command.add_option("--size", flags.size, "Size of the window or of the picture")
        ->capture_default_str();
    command
        .add_option("--view", flags.view,
                    "camera:N, or camera:N,yaw=DEGREES,pitch=DEGREES to look from beside it")
        ->capture_default_str();
    command
        .add_option("--room", flags.room,
                    "on: floor, walls and the cameras' names around the clouds, where the cameras' "
                    "places in the room are known; off: the clouds alone")
        ->capture_default_str()
        ->check(cli::one_of({"on", "off"}));
    command
        .add_option("--quality", flags.quality,
                    "How carefully that room is lit: low, high, or auto, which is low where no "
                    "graphics card draws. The clouds are the same in both")
        ->default_str("that of your last window, else auto")
        ->check(cli::one_of({"auto", "low", "high"}));
    command
        .add_option("--save-to", flags.save_to,
                    "The folder into which F9 and F10 in the window save pictures and points")
        ->capture_default_str()
        ->check(CLI::ExistingDirectory);
    command.add_flag("--stereo", flags.stereo,
                     "With --offscreen: what the left and the right eye see, beside each other");
    cli::add_seconds_option(command, flags.seconds,
                            "End this long after the first picture (default with --offscreen: 3)");
    command.add_flag("--json", flags.json, "Print the figures as one JSON line at the end");
    command
        .add_option("--render-scale", flags.render_scale,
                    "Share of the window's pixels that is drawn on each side: auto, or 0.1 to 1")
        ->capture_default_str();
}

void note_given(const CLI::App& command, JoinFlags& flags) {
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0)
            flags.given.insert(option->get_name());
}

}  // namespace theatron::app
