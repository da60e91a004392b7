// SPDX-License-Identifier: Apache-2.0
// theatron view: a camera, recording or case without a host and a link. A session of this program
// alone shows it, so all that a session's window can do is there.
#include <cstdlib>

#include "base/error.h"
#include "base/output.h"
#include "cli/progress.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "host/host.h"
#include "join_flags.h"
#include "picture_options.h"
#include "view_source.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

// A folder that is there as long as this object, for its owner only.
class OwnFolder {
public:
    OwnFolder() {
        std::error_code problem;
        const fs::path folder = fs::temp_directory_path(problem);
        std::string name = (folder / "theatron-view-XXXXXX").string();
        if (problem || !mkdtemp(name.data()))
            throw Error("No folder can be made in '" +
                        (problem ? std::string(std::getenv("TMPDIR")) : folder.string()) +
                        "'; TMPDIR names another place.");
        path_ = name;
    }
    ~OwnFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

struct ViewFlags {
    std::string what;
    JoinFlags join;
};

host::HostOptions host_options(const ViewSource& source, const fs::path& folder) {
    host::HostOptions options;
    options.cameras = source.cameras;
    options.name = source.name;
    options.listen = net::parse_endpoint("127.0.0.1:0");
    options.state = folder / "state";
    options.is_audited = false;
    if (!source.case_folder.empty()) {
        options.cases = folder / "cases";
        fs::create_directories(options.cases);
        fs::create_directory_symlink(source.case_folder,
                                     options.cases / source.case_folder.filename());
    }
    return options;
}

void run(ViewFlags flags) {
    const ViewSource source = view_source(flags.what);
    cli::catch_stop_signals();
    const OwnFolder folder;
    const host::Host host(host_options(source, folder.path()), cli::show_progress());
    // The person at this machine decides.
    flags.join.link = host.link(wire::Role::operator_);
    flags.join.is_alone = true;
    if (!source.case_folder.empty() && flags.join.window())
        output::print("Open the case with the button Case of the window.\n");
    run_join(flags.join);
}

}  // namespace

void add_view_command(CLI::App& app) {
    const auto flags = std::make_shared<ViewFlags>();
    CLI::App* command = app.add_subcommand(
        "view", "Look at a camera, a recording or a case, without a host and a link");
    command->footer(
        "A recording is played again and again; its bar moves through it. Nobody else can come:\n"
        "the session of this window has no link.\n"
        "\nExamples:\n"
        "  theatron view operation.mkv\n"
        "  theatron view k4a:0\n"
        "  theatron view cases/liver\n"
        "  theatron view synthetic:room,quality=quick\n"
        "  theatron view operation.mkv --offscreen picture.png --view camera:0,yaw=-45");
    command
        ->add_option("what", flags->what,
                     "A recording, an Azure Kinect's file, a video, a folder of pictures, a case, "
                     "or a camera as of 'theatron host --camera'")
        ->required();
    add_picture_options(*command, flags->join);
    command->callback([flags, command] {
        note_given(*command, flags->join);
        run(*flags);
    });
}

}  // namespace theatron::app
