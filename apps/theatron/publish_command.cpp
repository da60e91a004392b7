// SPDX-License-Identifier: Apache-2.0
// theatron publish
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "base/utc.h"
#include "cli/camera_option.h"
#include "cli/choice_check.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "client/participant_figures.h"
#include "client/person_id.h"
#include "commands.h"
#include "files/json_text.h"
#include "files/state_folder.h"
#include "host/host_figures.h"
#include "link_argument.h"
#include "participant_json.h"
#include "published_cameras.h"
#include "visit/source_remarks.h"
#include "wire/condition_text.h"

namespace theatron::app {
namespace {

struct PublishFlags {
    std::string link;
    std::string name = "cameras";
    std::vector<std::string> cameras, shared, filters;
    std::string places;
    double seconds = 0, every = 0;
    bool may_record = false;
};

nlohmann::json camera_json(const publish::CameraPublisher::Figures& camera) {
    std::uint64_t left_out = 0;
    for (const send::EncoderFigures& encoder : camera.lane.encoders)
        left_out += encoder.left_out;
    return {{"id", camera.number ? nlohmann::json(int(*camera.number)) : nlohmann::json()},
            {"name", camera.lane.name},
            {"state", wire::text_of(camera.lane.camera.condition)},
            {"share_ended", camera.has_ended},
            {"problem", wire::english(camera.lane.camera.problem)},
            {"filter", camera.lane.filter},
            {"filter_device", camera.lane.filter_device},
            {"sync_offset_ms", camera.lane.sync_offset_seconds * 1000},
            {"fps", camera.lane.frames_per_second},
            {"frames", camera.lane.frames},
            {"dropped_newest", camera.lane.dropped_newest},
            {"left_out", left_out},
            {"encoders", camera.lane.encoders.size()}};
}

nlohmann::json figures_json(const publish::CameraPublisher& publisher,
                            const client::Participant::Status& status) {
    nlohmann::json cameras = nlohmann::json::array();
    for (const auto& camera : publisher.figures())
        cameras.push_back(camera_json(camera));
    return {{"utc", utc_text(utc_now())},
            {"host", status.host_name},
            {"phase", client::text_of(status.phase)},
            {"joins", status.joins},
            {"dropped_slow", status.media_dropped},
            {"skew_ms", host::skew_json(publisher.moments())},
            {"unpaired", publisher.moments().unpaired},
            {"cameras", cameras}};
}

std::string status_line(const publish::CameraPublisher& publisher,
                        const client::Participant::Status& status) {
    std::string line = client::text_of(status.phase);
    if (!status.problem.empty())
        line += ": " + status.problem;
    for (const auto& camera : publisher.figures()) {
        char text[160];
        std::snprintf(text, sizeof(text), "  %s %.1f fps%s", camera.lane.name.c_str(),
                      camera.lane.frames_per_second,
                      camera.lane.encoders.empty() ? ", nobody sees it" : "");
        line += text;
    }
    if (const std::string moments = moments_part(publisher.moments()); !moments.empty())
        line += "  " + moments;
    return line;
}

void run(const PublishFlags& flags) {
    const std::vector<std::string> cameras = with_shared(flags.cameras, flags.shared);
    if (cameras.empty())
        throw Error("Name what is sent: --camera CAMERA, or --share SOURCE for a screen.");
    client::Participant::Options options;
    options.link = parse_link_argument(flags.link);
    options.name = flags.name;
    options.sends_only = true;
    options.person = client::load_or_make_person_id(files::state_folder());
    options.remark = [](const std::string& text) { log::say(text); };
    const auto publisher = open_published(cameras, flags.filters, flags.places,
                                          {flags.may_record, wire::CameraKind::room});
    options.publishing = publisher->events();

    cli::catch_stop_signals();
    client::Participant participant(options);
    const publish::Publishing publishing(*publisher, participant);
    const bool live_line = flags.every <= 0 && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line{};
    visit::SourceRemarks remarks;
    while (!cli::stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(50ms);
        const client::Participant::Status status = participant.status();
        if (status.phase == client::Participant::Phase::refused)
            throw Error(status.problem);
        if (!status.publish_problem.empty())
            throw Error(status.publish_problem);
        if (status.phase == client::Participant::Phase::ended)
            break;
        // Others have ended all that it shared.
        if (publisher->has_ended())
            break;
        visit::say(remarks.take(*publisher, steady_now()));
        if (steady_now() < next_line)
            continue;
        if (flags.every > 0)
            output::print(files::json_text(figures_json(*publisher, status)) + "\n");
        else if (live_line)
            output::status_line(status_line(*publisher, status));
        next_line = steady_now() + (flags.every > 0 ? seconds_to_duration(flags.every) : 500ms);
    }
    cli::begin_end();
    output::end_status_line();
}

}  // namespace

void add_publish_command(CLI::App& app) {
    const auto flags = std::make_shared<PublishFlags>();
    CLI::App* command =
        app.add_subcommand("publish", "Send cameras of this machine to a session of another");
    command->footer(
        "The host prints the link for that. Nothing is received; 'theatron join --publish' sends "
        "cameras\nand shows the session.\n"
        "\nExamples:\n"
        "  theatron publish LINK --camera k4a:0\n"
        "  theatron publish LINK --camera k4a:0 --camera k4a:1 --places places.json\n"
        "  theatron publish LINK --share endoscope.mp4,loop=1,width=1.2,place=0:1.9:-1.8\n"
        "  theatron publish LINK --share x11:endoscope --share rtsp://tower.local/live");
    command->add_option("link", flags->link, "The link for publishers, or @FILE with it")
        ->required();
    cli::add_camera_option(*command, flags->cameras);
    add_share_option(*command, flags->shared);
    command
        ->add_option(
            "--filter", flags->filters,
            "Filters of depth: off, paper, default, stereo (for cameras that have few distinct "
            "depths), a line of filters or a JSON file; "
            "CAMERA=... for one camera, by number from 0 or name. At its end @cuda filters on an "
            "NVIDIA GPU and @auto on whichever is quicker, that or the processor: default@cuda")
        ->allow_extra_args(false);
    command->add_option("--places", flags->places,
                        "Where the cameras are in the room: a file that 'theatron register' wrote");
    command->add_flag("--may-record", flags->may_record,
                      "Agree that other participants record these cameras; without it the host "
                      "sends them to no recorder");
    command->add_option("--name", flags->name, "Name shown in the session")->capture_default_str();
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    cli::add_seconds_option(*command, flags->every,
                            "Print figures as a JSON line this often, in seconds", "--every");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
