// SPDX-License-Identifier: Apache-2.0
// theatron join
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "camera_lines.h"
#include "case_lines.h"
#include "chat_lines.h"
#include "cli/choice_check.h"
#include "cli/number_check.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "client/participant.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/png_file.h"
#include "input_lines.h"
#include "join_flags.h"
#include "join_pictures.h"
#include "join_window.h"
#include "link_argument.h"
#include "mark_lines.h"
#include "participant_json.h"
#include "people_lines.h"
#include "phrases/language.h"
#include "picture_options.h"
#include "playback_lines.h"
#include "published_cameras.h"
#include "room_lines.h"
#include "session/renderer_choice.h"
#include "study_lines.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer/head_text.h"
#include "viewer/offscreen_view_native.h"
#include "viewer/renderer_text.h"
#include "viewer_window.h"
#include "visit/stay.h"

namespace theatron::app {
namespace {

// A picture is drawn when the command ends, which takes long where no graphics card draws.
constexpr Duration picture_patience = std::chrono::seconds(60);

ViewPicture view_picture(const JoinFlags& flags) {
    ViewPicture picture;
    picture.size = parse_size(flags.size);
    picture.view = viewer::parse_view(flags.view);
    picture.renderer = flags.renderer.value_or(viewer::automatic);
    picture.room = parse_room(flags);
    picture.people = viewer::parse_seen_people(flags.people, flags.myself);
    picture.color_file = flags.offscreen;
    picture.depth_file = flags.depth_file;
    picture.stereo = flags.stereo;
    return picture;
}

void choose_delivery(client::Participant& participant, bool latency, double value) {
    wire::ChooseDelivery goal = participant.status().goal;
    if (latency)
        goal.target_latency_ms = std::uint32_t(std::min(value, 60'000.0));
    else
        goal.max_kbit_per_s = to_kbit(value);
    participant.choose_delivery(goal);
}

// For one camera, by number from 0 or name; `camera` empty: for all.
void choose_codec(client::Participant& participant, bool depth, const std::string& codec,
                  const std::string& camera) {
    const std::string none;
    if (camera.empty())
        return participant.choose_codecs(depth ? codec : none, depth ? none : codec);
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    std::vector<std::string> names;
    for (const auto& known : cameras)
        names.push_back(known.description.name);
    try {
        participant.choose_codecs(cameras[find_camera(camera, names)].description.id,
                                  depth ? codec : none, depth ? none : codec);
    } catch (const Error& e) {
        log::say(e.what());
    }
}

// Carries out a line of standard input: "depth rvl", "depth rvl 2", "latency 200". False after
// "quit".
bool obey(visit::Stay& stay, RoomLines& room, const std::string& line) {
    client::Participant& participant = stay.participant();
    if (const auto command = visit::stay_command(line)) {
        if (const std::string sentence = stay.obey(*command); !sentence.empty())
            log::say(sentence);
        return true;
    }
    if (obey_people_line(participant, line) || obey_look_back_line(participant, line) ||
        refuse_looking_back(participant, line) || obey_camera_line(participant, line) ||
        obey_playback_line(participant, line) || obey_case_line(participant, line) ||
        obey_mark_line(participant, line) || obey_chat_line(participant, line) ||
        obey_study_line(participant, line) || room.obey(line, participant))
        return true;
    std::istringstream words(line);
    std::string what, value, camera;
    words >> what >> value >> camera;
    if (what == "quit")
        return false;
    if ((what == "depth" || what == "color") && !value.empty())
        choose_codec(participant, what == "depth", value, camera);
    else if (double number = 0; (what == "latency" || what == "ceiling") &&
                                std::sscanf(value.c_str(), "%lf", &number) == 1 && number >= 0)
        choose_delivery(participant, what == "latency", number);
    else if (!what.empty())
        output::print(
            "Say 'depth CODEC [CAMERA]', 'color CODEC [CAMERA]', 'latency MS', 'ceiling MBIT', "
            "'quit', in the room " +
                std::string(RoomLines::help()) + ", on cases " + case_lines_help() + ", on marks " +
                mark_lines_help() + ", on a recording that the host plays " +
                playback_lines_help() + ", in a study " + study_lines_help() + ", to the others " +
                chat_lines_help() + ", on the last minute " + look_back_help() +
                ", or as an operator " + people_help() + ", " + camera_lines_help() + ".\n",
            output::Stream::error);
    return true;
}

// Executes the lines that were typed so far. False if one of them ends the program.
bool obey(visit::Stay& stay, RoomLines& room, InputLines& input) {
    for (const std::string& line : input.take())
        if (!obey(stay, room, line))
            return false;
    return !input.closed_by_person();
}

bool has_no_camera(const client::Participant& participant) {
    std::uint64_t generation = 0;
    return participant.cameras(generation).empty();
}

nlohmann::json json_of(const visit::Stay& stay, const JoinPicture* picture) {
    const client::Participant& participant = stay.participant();
    nlohmann::json json = participant_json(participant);
    json["room"] = room_json(participant);
    json["cases"] = case_json(participant);
    json["study"] = study_json(participant);
    json["chat"] = chat_json(participant);
    json["voice"] = stay.ports().voice->json();
    json["voice"]["may_record"] = participant.voice_may_record();
    if (const auto* const face = stay.ports().expression)
        json["face"] = face->json();
    if (const auto* const webcam = stay.ports().face)
        json["webcam"] = {{"state", publish::text_of(webcam->state())},
                          {"problem", participant.status().face_problem}};
    if (picture)
        picture->add_to(json);
    return json;
}

void list_devices(bool as_json) {
    const sound::DeviceList found = sound::devices();
    if (as_json) {
        return output::result(files::json_text({{"microphones", found.microphones},
                                                {"loudspeakers", found.loudspeakers},
                                                {"problem", found.problem}}) +
                              "\n");
    }
    if (!found.problem.empty())
        return output::result(found.problem + "\n");
    const auto list = [](const std::string& kind, const std::vector<std::string>& names) {
        std::string lines = kind + ":" + (names.empty() ? " none" : "") + "\n";
        for (const std::string& name : names)
            lines += "  " + name + "\n";
        output::result(lines);
    };
    list("microphones", found.microphones);
    list("loudspeakers", found.loudspeakers);
}

}  // namespace

void run_join(const JoinFlags& flags) {
    if (flags.list_devices)
        return list_devices(flags.json);
    refuse_unused(flags);
    set_language(parse_language(flags.language).value_or(Language::english));
    if (flags.window() && !flags.or_screen)
        return join_in_window(flags);
    if (flags.link.empty())
        throw Error("Name the link that the host printed: theatron join LINK.");
    if (flags.window())
        return join_as_or_screen(flags);
    client::Participant::Options options = participant_options(flags);
    options.link = parse_link_argument(flags.link);
    options.name = flags.name.value_or("guest");
    visit::VoiceLine voice({flags.microphone, flags.speaker, flags.voice_frame_ms,
                            flags.push_to_talk, parse_cleaning(flags.echo_cancellation),
                            parse_spatial(flags.spatial_voices)});
    const auto publisher = open_own_cameras(flags, options);
    const auto face_line = open_face(flags);
    std::optional<publish::OwnFace> own_face;
    if (!flags.webcam.empty())
        own_face.emplace(flags.webcam).show(true);

    std::unique_ptr<JoinPicture> picture;
    check_picture_file(flags.offscreen);
    check_picture_file(flags.depth_file);
    if (flags.or_screen && !flags.offscreen.empty())
        picture = std::make_unique<OrScreenPicture>(parse_size(flags.size), flags.offscreen, voice);
    else if (!flags.offscreen.empty() || !flags.depth_file.empty())
        picture = std::make_unique<OffscreenPicture>(view_picture(flags));

    cli::catch_stop_signals();
    std::optional<cli::Saving> saving;
    if (picture)
        saving.emplace(picture_patience);
    visit::Stay stay(options,
                     {&voice, own_face ? &*own_face : nullptr, face_line.get(), publisher.get()});
    client::Participant& participant = stay.participant();
    const bool live_line = !flags.json && flags.every <= 0 && isatty(STDOUT_FILENO);
    const bool has_end = flags.seconds > 0 || picture;
    const Duration length = seconds_to_duration(flags.seconds > 0 ? flags.seconds : 3);
    const Duration warmup = seconds_to_duration(flags.warmup);
    TimePoint started = steady_now(), first_frame{}, next_line{};
    bool warm = flags.warmup <= 0;
    InputLines input;
    RoomLines room;
    StudyLines study;

    while (!cli::stop_requested()) {
        if (participant.wait_for_frame(50ms) && first_frame == TimePoint{})
            first_frame = steady_now();
        if (picture)
            picture->take(participant, room);
        else
            (void)participant.take_frames();

        const auto status = participant.status();
        if (status.phase == client::Participant::Phase::refused)
            throw Error(status.problem);
        if (status.phase == client::Participant::Phase::ended)
            break;
        if (!obey(stay, room, input))
            break;
        visit::say(stay.tick(steady_now()));
        voice.hold(false, steady_now());
        room.on_tick(participant);
        if (const auto& head = room.head())
            voice.place(*head, participant);
        print_managed(participant);
        const TimePoint now = steady_now();
        // Nothing more is to come from a host without cameras.
        if (first_frame == TimePoint{} && status.phase == client::Participant::Phase::joined &&
            has_no_camera(participant))
            first_frame = now;
        if (!warm && first_frame != TimePoint{} && now - first_frame >= warmup) {
            participant.reset_figures();
            warm = true;
        }
        if (has_end && first_frame != TimePoint{} && now - first_frame >= warmup + length)
            break;
        if (status.phase == client::Participant::Phase::waiting)
            started = now;  // a person decides, who may need a while
        constexpr Duration join_patience = std::chrono::seconds(10);
        if (has_end && first_frame == TimePoint{} && now - started >= length + join_patience)
            throw Error(status.problem.empty() ? "The host sent no picture." : status.problem);
        if (flags.every > 0)
            study.on_tick(participant);
        if (flags.every > 0 && now >= next_line) {
            output::print(files::json_text(json_of(stay, picture.get())) + "\n");
            next_line = now + seconds_to_duration(flags.every);
        } else if (live_line && now >= next_line) {
            output::status_line(status_line(participant));
            next_line = now + 500ms;
        }
    }
    output::end_status_line();
    const nlohmann::json figures = json_of(stay, picture.get());
    if (picture)
        picture->write();
    saving.reset();
    cli::begin_end();
    if (flags.json)
        output::result(files::json_text(figures) + "\n");
    else if (!live_line)
        output::print(status_line(participant) + "\n");
}

void add_join_command(CLI::App& app) {
    const auto flags = std::make_shared<JoinFlags>();
    CLI::App* command = app.add_subcommand("join", "Join a session with the link of its host");
    command->footer(
        "Depth codecs: " + join_names(video::depth_codec_names()) +
        "\nColour codecs: " + join_names(video::color_codec_names()) +
        ", auto (H.264, or JPEG of at most 20 Mbit/s a camera, whichever suits the host; "
        "see\n'theatron status')"
        "\n\nA window opens unless a file (--offscreen, --depth) or figures (--json, --every) are "
        "asked for.\nIn it, F1 shows the keys. Without one, lines on standard input change what "
        "is sent:\n'depth rvl', 'color jpeg:quality=60', 'latency 200', 'ceiling 20', "
        "or act in the shared room\n(docs/room.md):\n" +
        RoomLines::help() + ".\nOn the case in the room (docs/cases.md):\n" + case_lines_help() +
        ".\nOn a recording that the host plays (docs/views.md):\n" + playback_lines_help() +
        ".\nAt the last minute of the session, you alone (docs/views.md):\n" + look_back_help() +
        ".\nTo all others (docs/room.md):\n" + chat_lines_help() +
        ".\nIn a study that you take part in (docs/studies.md):\n" + study_lines_help() +
        ".\nOperators decide on people (docs/room.md):\n" + people_help() +
        ".\nThey adjust cameras for all (docs/registration.md):\n" + camera_lines_help() +
        ".\n"
        "\nExamples:\n"
        "  theatron join\n"
        "  theatron join LINK\n"
        "  theatron join LINK --offscreen view.png --renderer mesh --size 1280x720 --seconds 3\n"
        "  theatron join LINK --depth-codec zstd --color-codec jpeg:quality=60 --seconds 10 "
        "--json\n"
        "  theatron join LINK --target-latency 250 --max-mbit 15\n"
        "  theatron join --list-devices\n"
        "  theatron join LINK --microphone default --speaker default\n"
        "  theatron join LINK --publish k4a:0\n"
        "  theatron join LINK --face 9001 --own-face me.face\n"
        "  theatron join LINK --person 1=0.2:1.65:-0.4,reach=1 --myself 0=0:1.7:0.5,yaw=180");
    command->add_option("link", flags->link,
                        "The link that the host printed, or @FILE with it. In a window it can be "
                        "left out: a form asks for it");
    command->add_option("--name", flags->name, "Your name, shown to the others")
        ->default_str("that of your last window, else guest");
    add_picture_options(*command, *flags);
    command->add_option("--depth-codec", flags->depth_codec, "How the host sends depth to you")
        ->capture_default_str();
    command->add_option("--color-codec", flags->color_codec, "How the host sends colour to you")
        ->capture_default_str();
    command
        ->add_option("--publish", flags->cameras,
                     "A camera of yours that the others see, spelt as for theatron host --camera; "
                     "needs the host's link for those who may. Repeat for more")
        ->allow_extra_args(false);
    add_share_option(*command, flags->shared);
    command
        ->add_option("--relay", flags->relay,
                     "on: pictures come from a relay where the host names one ('theatron relay'); "
                     "off: from the host only")
        ->capture_default_str()
        ->check(cli::one_of({"on", "off"}));
    command->add_flag("--may-record", flags->may_record,
                      "Agree that other participants record your cameras and screens; without it "
                      "the host sends them to no recorder");
    command
        ->add_option("--person", flags->people,
                     "CAMERA=X:Y:Z, a person seen by that camera (number from 0 or name) and where "
                     "in the room their head is, in metres: of this camera only what is near them "
                     "is drawn. Behind it ,yaw=DEGREES (0 looks along -z, 90 along -x), "
                     "pitch=DEGREES (up) and reach=METRES from the body's middle (1.1). Repeat for "
                     "more cameras")
        ->allow_extra_args(false);
    command
        ->add_option("--myself", flags->myself,
                     "The same for a camera that sees yourself: also your head and what is right "
                     "before your eyes is left out; hands stay")
        ->allow_extra_args(false);
    cli::add_seconds_option(*command, flags->warmup, "Leave these first seconds out of the figures",
                            "--warmup");
    cli::add_seconds_option(*command, flags->every,
                            "Print the figures as a JSON line at this interval, in seconds",
                            "--every");
    command
        ->add_option(
            "--target-latency", flags->target_latency_ms,
            "Age in milliseconds that the host should aim at; on a slow link it leaves out "
            "frames, then makes colour coarser, last depth outside the region of interest. 0: "
            "nothing is left out on purpose")
        ->capture_default_str()
        ->check(CLI::Range(0, 60'000));
    command
        ->add_option("--max-mbit", flags->max_mbit,
                     "Most megabits a second that the host sends to you; 0: no ceiling")
        // The host is told whole kilobits.
        ->check(cli::number_check(
            [](double value) { return std::isfinite(value) && (value == 0 || value >= 0.001); },
            "is not a number of megabits: 0, or 0.001 and more"));
    command->add_option("--microphone", flags->microphone,
                        "Speak to the others: default, the name of a microphone, or a WAV file. "
                        "Without it you only listen. In the window L closes and opens it, "
                        "elsewhere the lines 'microphone off' and 'microphone on'");
    command->add_flag("--list-devices", flags->list_devices,
                      "Print the microphones and loudspeakers of this machine, and end");
    command
        ->add_option("--echo-cancellation", flags->echo_cancellation,
                     "Take echo of the loudspeaker, noise and differences of loudness out of your "
                     "microphone: on, off, or auto, which is on for devices and off for files")
        ->capture_default_str()
        ->check(cli::one_of({"auto", "on", "off"}));
    command
        ->add_option("--spatial-voices", flags->spatial_voices,
                     "Hear people from where they stand, as with headphones (HRTF): on, off, or "
                     "auto, which is on for devices and off for files. A file is stereo then")
        ->capture_default_str()
        ->check(cli::one_of({"auto", "on", "off"}));
    command->add_option("--webcam", flags->webcam,
                        "Show your face, small on your avatar: a video device (/dev/video0), a "
                        "video file, or test for a generated picture. In the window F4, elsewhere "
                        "the lines 'webcam on' and 'webcam off' change it");
    command->add_option("--face", flags->face,
                        "Send what your face shows, as six emotions, jaw and lids; no picture: the "
                        "UDP port where the OSC packets of your headset's face tracker arrive, "
                        "voice for a mouth that your microphone moves, or actor for a scripted "
                        "face. The lines 'face on' and 'face off' change it");
    command->add_option("--face-model", flags->face_model,
                        "The network that tells the emotions, of 'theatron face train'; without it "
                        "one learns from synthetic persons at first, for some seconds");
    command->add_flag("--face-channels", flags->face_channels,
                      "Send all 52 channels of your face, so that it moves as it was tracked");
    command->add_option("--own-face", flags->own_face,
                        "Your own face, of 'theatron face enrol': the others see it in place of "
                        "the usual head, moved by --face. The host forgets it when you leave, or "
                        "at the line 'face off'; it is in no recording");
    command->add_option("--passphrase-file", flags->passphrase_file,
                        "A file with its passphrase in the first line, which only you may read "
                        "(default: asked for)");
    command->add_flag("--push-to-talk", flags->push_to_talk,
                      "Speak only while a key is held: Enter in the window, where F7 switches, "
                      "elsewhere between the lines 'talk on' and 'talk off'");
    command->add_flag("--voice-may-record", flags->voice_may_record,
                      "Agree that other participants record your voice; without it the host sends "
                      "it to no recorder. In the window F8, elsewhere the lines "
                      "'voice-recording on' and 'voice-recording off' change it");
    command->add_option("--speaker", flags->speaker,
                        "Hear the others: default, the name of a loudspeaker, or a WAV file that "
                        "is written");
    command
        ->add_option("--voice-frame", flags->voice_frame_ms,
                     "Milliseconds of voice in a packet, 10 or 20; 10 arrives sooner and needs "
                     "more of the link")
        ->capture_default_str()
        ->check(cli::one_of({"10", "20"}));
    command->add_flag(
        "--or-screen", flags->or_screen,
        "For a monitor in the operating room, full screen and without keyboard: who "
        "is here and speaks, and what they point at in the picture of the camera that "
        "sees it best. With @FILE as the link it begins and comes back by itself; "
        "with --offscreen it is a picture");
    command->add_flag("--no-window", flags->no_window,
                      "Receive and tell the figures, draw nothing");
    command->callback([flags, command] {
        note_given(*command, *flags);
        run_join(*flags);
    });
}

}  // namespace theatron::app
