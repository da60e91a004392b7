// SPDX-License-Identifier: Apache-2.0
// theatron demo: a host and a viewer in one program, with cameras that need no
// hardware, in a window or as pictures of what the viewer sees.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/camera_option.h"
#include "cli/progress.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "client/participant.h"
#include "commands.h"
#include "files/png_file.h"
#include "host/host.h"
#include "host/page.h"
#include "or_screen_window.h"
#include "participant_json.h"
#include "scripted_people.h"
#include "viewer/offscreen_view_native.h"
#include "viewer_window.h"

namespace theatron::app {
namespace {

struct DemoFlags {
    std::string program;  // as it was called, for commands to copy
    std::vector<std::string> cameras = {"synthetic:camera=0,cameras=2,wait=off",
                                        "synthetic:camera=1,cameras=2,wait=off"};
    std::string out = "demo";
    std::string listen = "127.0.0.1:0";
    double seconds = 0;
    bool no_window = false;
};

// In a window, the user stands where both people and the table are in view.
constexpr viewer::ViewChoice window_view{CameraId{0}, -65, 8};
constexpr Size window_size{1280, 720};

struct View {
    const char* file;
    const char* renderer;
    viewer::ViewChoice choice;
};

client::Participant::Options viewer_options(const net::Link& link) {
    client::Participant::Options join;
    join.link = link;
    join.name = "demo viewer";
    join.remark = [](const std::string& text) { log::say(text); };
    join.keeps_room = true;
    join.takes_faces = true;
    join.takes_own_faces = true;
    join.shows_chat = true;
    return join;
}

// The people of the script, on a thread of their own.
class Meeting {
public:
    explicit Meeting(const net::Link& link)
        : thread_([people = std::make_unique<ScriptedPeople>(link)](const std::stop_token& stop) {
              while (!stop.stop_requested()) {
                  people->on_tick();
                  std::this_thread::sleep_for(10ms);
              }
          }) {}

private:
    std::jthread thread_;
};

void show_pictures(const DemoFlags& flags, const std::filesystem::path& folder,
                   const net::Link& link) {
    client::Participant viewer(viewer_options(link));
    constexpr Size size{1280, 720}, screen_size{1920, 1080};
    viewer::OffscreenView scene;
    client::Participant::Options screen_options = viewer_options(link);
    screen_options.name = or_screen_name;
    client::Participant screen_viewer(std::move(screen_options));
    const visit::VoiceLine silence({});  // the scripted people do not speak
    OrScreenPicture screen(screen_size, (folder / "or_screen.png").string(), silence);
    const View views[] = {{"from_camera.png", "blend", {CameraId{0}, 0, 0}},
                          {"from_between.png", "blend", {CameraId{0}, -45, 5}},
                          {"as_mesh.png", "mesh", {CameraId{0}, -45, 5}},
                          {"as_splats.png", "splat", {CameraId{0}, -45, 5}}};

    output::print("Pictures of what the viewer sees are written to " + folder.string() + "/ :\n");
    const TimePoint begin = steady_now();
    TimePoint next_line{}, next_views = begin + 1s;
    // The newest picture of a camera is as old as it took to draw the views, so the screen follows
    // some pictures later.
    std::optional<TimePoint> next_screen;
    bool announced = false;
    const auto has_time = [&] {
        return flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds);
    };
    while (!cli::stop_requested() && (has_time() || next_screen)) {
        viewer.wait_for_frame(20ms);
        scene.take(viewer);
        screen.take(screen_viewer);
        const TimePoint now = steady_now();
        const bool can_draw =
            screen.has_picture() &&
            std::all_of(std::begin(views), std::end(views),
                        [&](const View& view) { return scene.can_draw(view.choice); });
        if (can_draw && !next_screen && now >= next_views) {
            for (const View& view : views)
                files::write_png(folder / view.file,
                                 scene.picture({view.choice, size, view.renderer, {}}).view());
            next_screen = steady_now() + 1s;
        } else if (next_screen && now >= *next_screen) {
            screen.write();
            next_screen.reset();
            next_views = steady_now() + 5s;
            if (!std::exchange(announced, true)) {
                for (const View& view : views)
                    output::print("  " + (folder / view.file).string() + "\n");
                output::print("  " + (folder / "or_screen.png").string() +
                              ", the screen in the operating room\n");
            }
        }
        if (announced && now >= next_line) {
            if (isatty(STDOUT_FILENO))
                output::status_line(status_line(viewer));
            else
                output::print(status_line(viewer) + "\n");
            next_line = now + (isatty(STDOUT_FILENO) ? Duration(500ms) : Duration(2s));
        }
    }
    cli::begin_end(announced ? 0 : 1);
    if (!announced)
        throw Error("The demo ended before the first picture; give it more time with --seconds.");
}

// `make demo` compiles the other commands while the demo is shown.
bool is_compiled_later(const std::string& program) {
    return program.find('/') != program.npos && !std::filesystem::exists(program);
}

// Null where none can be opened, for whatever reason: the demo then writes pictures.
std::unique_ptr<window::DesktopWindow> open_window(const DemoFlags& flags) {
    if (flags.no_window || !has_display())
        return nullptr;
    try {
        return std::make_unique<window::DesktopWindow>("Theatron", window_size);
    } catch (const Error&) {
        log::say("No window can be opened on this display.");
        return nullptr;
    }
}

void run(const DemoFlags& flags) {
    cli::catch_stop_signals();
    const std::filesystem::path folder = flags.out;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Error("Cannot make the folder '" + flags.out + "': " + error.message() + ".");

    host::HostOptions options;
    options.cameras = flags.cameras;
    options.listen = net::parse_endpoint(flags.listen);
    options.state = folder / "host";
    options.name = "demo operating room";
    options.page = host::usual_page_folder();
    // Objects that an earlier demo left there.
    std::filesystem::remove(options.state / "room", error);
    host::Host host(options, cli::show_progress());
    const net::Link link = net::parse_link(host.link());
    const auto window = open_window(flags);
    const auto watch = window ? std::make_unique<WindowWatch>(*window) : nullptr;
    const Meeting meeting(link);

    output::print(
        std::string("\nThe demo room is open. Join it from another terminal") +
        (is_compiled_later(flags.program) ? " once the other commands are compiled" : "") +
        ", or open the link in a browser" +
        (host::has_page(options.page) ? "" : " once the browser client is built") + ":\n\n  " +
        flags.program + " join '" + host.link() +
        "'\n\nTwo scripted people are in it, who point, hold a brick and hand it over.\n");
    if (window) {
        output::print(
            "You meet them in the window: F1 shows its keys, Esc, twice, ends the demo.\n");
        ViewerWindow shown{.join = viewer_options(link)};
        shown.viewer.view = window_view;
        shown.greeting =
            "You are in a generated operating room, with two scripted people. F1: keys";
        shown.seconds = flags.seconds;
        shown.watch = watch.get();
        show(*window, std::move(shown));
    } else {
        show_pictures(flags, folder, link);
    }
    output::end_status_line();
    output::print("\nThe demo has ended. Next, try your own camera:\n  " + flags.program +
                  " host --camera mkv:RECORDING.mkv,loop=1\n  " + flags.program + " host --help\n");
}

}  // namespace

void add_demo_command(CLI::App& app) {
    const auto flags = std::make_shared<DemoFlags>();
    CLI::App* command = app.add_subcommand(
        "demo",
        "See it work: a generated room with two scripted people, in a window or as pictures");
    command->footer("Example: theatron demo --seconds 20 --out pictures");
    cli::add_camera_option(*command, flags->cameras,
                           "Other cameras than the generated ones; repeat for more");
    command->add_option("--out", flags->out, "Folder for the pictures")->capture_default_str();
    command->add_option("--listen", flags->listen, "ADDRESS:PORT of the demo's host")
        ->capture_default_str();
    command->add_flag("--no-window", flags->no_window,
                      "Write pictures even where there is a display");
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    command->callback([flags, &app] {
        flags->program = app.get_name();
        run(*flags);
    });
}

}  // namespace theatron::app
