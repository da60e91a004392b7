// SPDX-License-Identifier: Apache-2.0
// theatron face listen, record and act
//
// Values of a face go to the recording that its owner asked for, and nowhere else: what is printed
// are counts, the tracker's state and, with a network, the emotion that it tells.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "face/emotion_reader.h"
#include "face/synthetic_faces.h"
#include "face_command.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/private_file.h"
#include "visit/tracked_face.h"

namespace theatron::app {
namespace {

nlohmann::json listen_json(const face::FaceNow& face, const face::OscCounts& counts) {
    return {{"tracking", face::to_text(face.tracking)},
            {"channels", face.present.count()},
            {"packets", counts.packets},
            {"refused", counts.refused},
            {"used", counts.used},
            {"unknown", counts.unknown},
            {"no_number", counts.no_number},
            {"flooded", counts.flooded}};
}

std::string listen_text(const nlohmann::json& figures) {
    std::string text = figures["tracking"].get<std::string>();
    for (const auto& [key, words] :
         {std::pair("channels", " channels of 52"), std::pair("packets", " packets"),
          std::pair("refused", " damaged"), std::pair("unknown", " values without use"),
          std::pair("flooded", " beyond the limit")})
        text += ", " + std::to_string(figures[key].get<std::uint64_t>()) + words;
    if (figures.contains("emotion"))
        text += "; told: " + figures["emotion"].get<std::string>() +
                (figures["calibrated"].get<bool>() ? "" : " (rest your face: calibrating)");
    return text + "\n";
}

// Throws Error if the person stopped meanwhile.
void wait_for_tracker(visit::TrackedFace& tracked) {
    while (tracked.next(steady_now() + visit::face_step).tracking != face::Tracking::tracked)
        if (cli::stop_requested())
            throw Error("Stopped before the tracker sent anything; no recording was written.");
}

// Takes what arrives meanwhile, and throws it away.
void wait(visit::TrackedFace& tracked, Duration time) {
    const TimePoint end = steady_now() + time;
    while (steady_now() < end && !cli::stop_requested())
        tracked.next(steady_now() + visit::face_step);
}

// A take of this emotion, from now on. Nullopt if the tracker fell silent; throws Error if the
// person stopped.
std::optional<face::Take> recorded_take(visit::TrackedFace& tracked, face::Emotion prompt,
                                        face::Source source, double seconds) {
    face::Take take;
    take.label = prompt;
    take.present.set();
    const TimePoint begin = steady_now();
    for (TimePoint now = begin; now - begin < seconds_to_duration(seconds); now = steady_now()) {
        const face::FaceNow face = tracked.next(now + visit::face_step);
        if (cli::stop_requested())
            throw Error("Stopped before the last take; no recording was written.");
        if (face.tracking != face::Tracking::tracked)
            return std::nullopt;
        take.present &= face.present & face::table_of(source).mask;
        take.samples.push_back({float(to_seconds(now - begin)), face.values});
    }
    return take;
}

}  // namespace

void run_face_listen(const FaceListen& wanted) {
    std::optional<face::EmotionReader> reader;
    bool is_synthetic = false;
    if (!wanted.model.empty()) {
        const face::Network network = visit::read_face_network(wanted.model);
        is_synthetic = network.is_synthetic_only;
        reader.emplace(network);
    }
    visit::TrackedFace tracked(wanted.at);
    cli::catch_stop_signals();
    if (!wanted.json)
        output::result(
            "listening on " + wanted.at.address + ", port " + std::to_string(wanted.at.port) +
            (is_synthetic ? "; the network learned from synthetic persons alone\n" : "\n"));
    const TimePoint begin = steady_now();
    TimePoint due = begin, report_due = begin + 1s;
    bool has_begun = false;
    nlohmann::json figures;
    while (!cli::stop_requested() &&
           (wanted.seconds <= 0 || due - begin < seconds_to_duration(wanted.seconds))) {
        due = std::max(due + visit::face_step, steady_now());
        const face::FaceNow face = tracked.next(due);
        figures = listen_json(face, tracked.counts());
        if (reader) {
            if (!has_begun && face.tracking == face::Tracking::tracked) {
                reader->calibrate(due);
                has_begun = true;
            }
            const face::EmotionNow told = reader->put(face, due);
            figures["emotion"] = face::to_text(told.told);
            figures["calibrated"] = told.is_calibrated;
            figures["synthetic_only"] = is_synthetic;
        }
        if (due < report_due)
            continue;
        report_due += 1s;
        output::print(wanted.json ? files::json_text(figures) + "\n" : listen_text(figures));
    }
    output::result(wanted.json ? files::json_text(figures) + "\n" : listen_text(figures));
}

void run_face_record(const FaceRecord& wanted) {
    face::Recording recording;
    recording.source = visit::face_source(wanted.source);
    if (std::error_code ignored; !wanted.overwrite && std::filesystem::exists(wanted.out, ignored))
        throw Error("'" + wanted.out + "' exists already; name another file, or give --overwrite.");
    files::require_writable(wanted.out);
    visit::TrackedFace tracked(wanted.at);
    cli::catch_stop_signals();
    output::result("waiting for the tracker's packets on port " + std::to_string(wanted.at.port) +
                   "\n");
    // The neutral take comes first: it is the one that calibrates.
    constexpr face::Emotion prompts[] = {face::Emotion::neutral, face::Emotion::happiness,
                                         face::Emotion::sadness, face::Emotion::surprise,
                                         face::Emotion::disgust, face::Emotion::anger};
    constexpr Duration get_ready = 2s;
    for (int round = 1; round <= wanted.rounds; ++round)
        for (const face::Emotion prompt : prompts) {
            std::optional<face::Take> take;
            while (!take) {
                wait_for_tracker(tracked);
                output::result("round " + std::to_string(round) + " of " +
                               std::to_string(wanted.rounds) + ": show " +
                               std::string(face::to_text(prompt)) + "\n");
                wait(tracked, get_ready);
                take = recorded_take(tracked, prompt, recording.source, wanted.take_s);
                if (!take)
                    output::result("the tracker fell silent; this take is made again\n");
            }
            recording.takes.push_back(std::move(*take));
        }
    files::write_private_file(wanted.out, face::recording_text(recording));
    output::result(wanted.out + ": " + std::to_string(recording.takes.size()) + " takes\n");
}

void run_face_act(const FaceAct& wanted) {
    const face::ChannelMask mask = face::table_of(visit::face_source(wanted.source)).mask;
    visit::FaceSocket socket = visit::FaceSocket::to(wanted.to.address, wanted.to.port);
    cli::catch_stop_signals();
    const TimePoint begin = steady_now();
    TimePoint due = begin;
    while (!cli::stop_requested() &&
           (wanted.seconds <= 0 || due - begin < seconds_to_duration(wanted.seconds))) {
        socket.send(face::osc_packet(face::actor_channels(to_seconds(due - begin)), mask));
        due += seconds_to_duration(1 / wanted.rate_hz);
        std::this_thread::sleep_for(std::max(due - steady_now(), Duration::zero()));
    }
}

}  // namespace theatron::app
