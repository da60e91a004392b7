// SPDX-License-Identifier: Apache-2.0
#include "bench_voice.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_case.h"
#include "bench_network.h"
#include "bench_report.h"
#include "child_process.h"
#include "cli/camera_option.h"
#include "cli/number_check.h"
#include "client/participant.h"
#include "files/file_bytes.h"
#include "process_usage.h"
#include "sound/wav_bytes.h"
#include "voice/opus_codec.h"
#include "voice/packet.h"

namespace theatron::bench {
namespace {

using client::Participant;
using std::numbers::pi;

constexpr std::size_t click_period = voice::sample_rate / 2, click_samples = 480;

// A quiet tone, so that the voice never pauses, with a loud burst each half second.
std::vector<std::int16_t> clicks(double seconds) {
    std::vector<std::int16_t> samples(std::size_t(seconds * voice::sample_rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = double(i) / voice::sample_rate;
        const bool is_click = i % click_period < click_samples;
        samples[i] = std::int16_t(32767 * (is_click ? 0.8 * std::sin(2 * pi * 1000 * t + pi / 2)
                                                    : 0.03 * std::sin(2 * pi * 220 * t)));
    }
    return samples;
}

// Numbers of the samples with which clicks begin.
std::vector<std::size_t> onsets(const std::vector<std::int16_t>& samples) {
    constexpr int loud = 8000;
    std::vector<std::size_t> found;
    std::size_t last_loud = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (std::abs(int(samples[i])) < loud)
            continue;
        if (found.empty() || i - last_loud > click_period / 4)
            found.push_back(i);
        last_loud = i;
    }
    return found;
}

class Folder {
public:
    Folder()
        : path_(std::filesystem::temp_directory_path() /
                ("theatron_voice_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string file(const char* name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

struct Links {
    std::string expert, operator_;
};

std::unique_ptr<ChildProcess> start_host(const Folder& folder, const VoiceBench& bench,
                                         Links& links) {
    const bool is_shaped = !bench.host_namespace.empty();
    std::vector<std::string> arguments = {
        "host",   "--listen", is_shaped ? "10.77.0.1:0" : "127.0.0.1:0",
        "--json", "--state",  folder.file("state")};
    for (const std::string& camera : bench.cameras)
        arguments.insert(arguments.end(), {"--camera", camera});
    if (!bench.cases.empty())
        arguments.insert(arguments.end(), {"--cases", bench.cases});
    auto host = std::make_unique<ChildProcess>(arguments);
    const auto greeting = nlohmann::json::parse(host->read_line(), nullptr, false);
    if (!greeting.is_object())
        throw Error("The host did not start; its message is above.");
    links = {greeting["link"].get<std::string>(), greeting["links"]["operator"].get<std::string>()};
    return host;
}

// Reads the lines of a participant until this time. Returns the newest one.
nlohmann::json follow(ChildProcess& member, TimePoint end) {
    nlohmann::json newest;
    while (steady_now() < end) {
        const auto line = nlohmann::json::parse(member.read_line(), nullptr, false);
        if (!line.is_object())
            throw Error("A participant ended; its message is above.");
        newest = line;
    }
    return newest;
}

// Sound that the listener's decoder made up, since it began.
nlohmann::json concealed_of(const nlohmann::json& voices) {
    double seconds = 0, concealed_ms = 0, longest_ms = 0;
    for (const nlohmann::json& voice : voices) {
        seconds += voice["seconds"].get<double>();
        concealed_ms += voice["concealed_ms"].get<double>();
        longest_ms = std::max(longest_ms, voice["longest_concealed_ms"].get<double>());
    }
    return {{"percent", seconds > 0 ? concealed_ms / (10 * seconds) : 0},
            {"longest_ms", longest_ms}};
}

double us_of(const nlohmann::json& voice, const char* key) {
    if (!voice.contains(key) || !voice[key].is_number())
        throw Error("A participant did not open its sound file; its message is above.");
    return voice[key].get<double>();
}

}  // namespace

nlohmann::json mouth_to_ear(const VoiceBench& bench) {
    constexpr double settling_seconds = 4;
    const Folder folder;
    files::write_file(folder.file("said.wav"),
                      sound::wav_bytes(clicks(bench.seconds + settling_seconds + 20)));
    enter_namespace(bench.host_namespace);
    Links links;
    const auto host = start_host(folder, bench, links);
    enter_namespace(bench.listener_namespace);
    ChildProcess listener({"join", links.expert, "--no-window", "--name", "listener", "--every",
                           "0.2", "--speaker", folder.file("heard.wav")});
    enter_namespace(bench.host_namespace);
    // Only operators and publishers may send cameras.
    std::vector<std::string> speaking = {"join",
                                         bench.own_camera.empty() ? links.expert : links.operator_,
                                         "--no-window",
                                         "--name",
                                         "speaker",
                                         "--every",
                                         "0.2",
                                         "--max-mbit",
                                         "0.1",
                                         "--microphone",
                                         folder.file("said.wav"),
                                         "--voice-frame",
                                         std::to_string(bench.frame_ms)};
    if (!bench.own_camera.empty())
        speaking.insert(speaking.end(), {"--publish", bench.own_camera});
    ChildProcess speaker(speaking);
    std::unique_ptr<Participant> opener;  // opens the case, so that everybody fetches it
    if (!bench.cases.empty()) {
        Participant::Options options;
        options.link = net::parse_link(links.expert);
        options.name = "opener";
        options.delivery = {0, 100};
        options.keeps_room = options.keeps_cases = true;
        options.media = [](const wire::MediaHeader&, ByteView) {};
        opener = std::make_unique<Participant>(std::move(options));
        open_offered_case(*opener);
    }
    const TimePoint begin = steady_now();
    const auto length = seconds_to_duration(bench.seconds + settling_seconds);
    nlohmann::json said, heard;
    std::jthread other([&] { said = follow(speaker, begin + length); });
    heard = follow(listener, begin + length);
    other.join();
    listener.interrupt();
    speaker.interrupt();
    listener.wait();
    speaker.wait();

    const double mouth_us = us_of(said["voice"], "microphone_began_us"),
                 ear_us = us_of(heard["voice"], "speaker_began_us");
    const double us_per_sample = 1e6 / voice::sample_rate;
    std::vector<double> delays;
    for (const std::size_t onset :
         onsets(sound::samples_of_wav(files::read_file(folder.file("heard.wav"))))) {
        const double since_us = ear_us + double(onset) * us_per_sample - mouth_us;
        if (since_us < settling_seconds * 1e6)
            continue;
        const double period_us = double(click_period) * us_per_sample;
        delays.push_back(std::fmod(since_us, period_us) / 1000);
    }
    if (double(delays.size()) < bench.seconds)
        throw Error("Only " + std::to_string(delays.size()) + " clicks were heard.");
    nlohmann::json result{{"p50", percentile(delays, 0.5)},
                          {"p95", percentile(delays, 0.95)},
                          {"max", percentile(delays, 1)},
                          {"count", delays.size()},
                          {"concealed", concealed_of(heard["voice"]["voices"])}};
    if (!bench.own_camera.empty()) {
        const auto own =
            std::find_if(heard["cameras"].begin(), heard["cameras"].end(),
                         [](const nlohmann::json& camera) { return camera["publisher"] != 0; });
        if (own == heard["cameras"].end())
            throw Error("The speaker's camera did not reach the listener.");
        const double age_ms = (*own)["color_age_ms"]["p50"];
        result["color_age_p50"] = age_ms;
        result["after_color"] = percentile(delays, 0.5) - age_ms;
    }
    return result;
}

nlohmann::json host_cores_of_24(double seconds) {
    constexpr int participants = 24, speakers = 4, frame_ms = 20;
    const Folder folder;
    Links links;
    const auto host = start_host(folder, {}, links);
    std::atomic<std::uint64_t> heard = 0;
    std::vector<std::unique_ptr<Participant>> people;
    for (int i = 0; i < participants; ++i) {
        Participant::Options options;
        options.link = net::parse_link(links.expert);
        options.name = "person " + std::to_string(i);
        options.voice = [&heard](ParticipantId, ByteView) { ++heard; };
        people.push_back(std::make_unique<Participant>(std::move(options)));
    }
    const TimePoint patience = steady_now() + 20s;
    for (const auto& one : people)
        while (one->status().phase != Participant::Phase::joined) {
            if (steady_now() > patience)
                throw Error("A participant did not join: " + one->status().problem);
            std::this_thread::sleep_for(10ms);
        }
    const auto cores_while = [&](const auto& work) {
        const double before = usage_of(host->pid()).cpu_seconds;
        const TimePoint begin = steady_now();
        work(begin);
        return (usage_of(host->pid()).cpu_seconds - before) / to_seconds(steady_now() - begin);
    };
    const double idle =
        cores_while([&](TimePoint) { std::this_thread::sleep_for(seconds_to_duration(seconds)); });

    voice::Encoder encoder(frame_ms);
    std::vector<float> frame(encoder.frame_samples());
    for (std::size_t i = 0; i < frame.size(); ++i)
        frame[i] = float(0.3 * std::sin(2 * pi * 300 * double(i) / voice::sample_rate));
    Bytes opus, packet_bytes;
    const double speaking = cores_while([&](TimePoint begin) {
        const int frames = int(seconds * 1000 / frame_ms);
        for (int n = 0; n < frames; ++n) {
            (void)encoder.encode(frame, opus);
            voice::Packet packet;
            packet.number = std::uint32_t(n);
            packet.time = steady_now();
            packet.frame_ms = frame_ms;
            packet.level_db = -20;
            packet.opus = opus;
            voice::write_packet(packet, packet_bytes);
            for (int s = 0; s < speakers; ++s)
                people[std::size_t(s)]->send_voice(packet_bytes);
            std::this_thread::sleep_until(
                std::chrono::steady_clock::now() +
                (begin + n * std::chrono::milliseconds(frame_ms) - steady_now()));
        }
    });
    const double expected = seconds * 1000 / frame_ms * speakers * (participants - 1);
    return {{"cores", speaking}, {"idle_cores", idle}, {"arrived_share", double(heard) / expected}};
}

void add_voice_bench(CLI::App& bench) {
    struct Flags {
        VoiceBench bench;
        std::string json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand(
        "voice", "Voice from a mouth to an ear through real processes, the host's cost, losses");
    command->footer(
        "Example: theatron bench voice --json -\n"
        "tests/end_to_end/voice_run.py puts a slow link between host and listener.");
    cli::add_camera_option(*command, flags->bench.cameras);
    command->add_option("--seconds", flags->bench.seconds, "Measured time")
        ->capture_default_str()
        ->check(cli::number_from_to(2.0, 3600.0));
    command->add_option("--voice-frame", flags->bench.frame_ms, "Milliseconds of a packet")
        ->capture_default_str()
        ->check(CLI::IsMember({10, 20}));
    command->add_option("--host-namespace", flags->bench.host_namespace,
                        "Network namespace of host and speaker; only mouth to ear is measured");
    command
        ->add_option("--listener-namespace", flags->bench.listener_namespace,
                     "Network namespace of the listener")
        ->needs("--host-namespace");
    command->add_option("--own-camera", flags->bench.own_camera,
                        "The speaker's camera, with whose colour the voice is compared");
    command->add_option("--cases", flags->bench.cases,
                        "A folder of cases, of which the listener fetches the first meanwhile");
    add_json_option(*command, flags->json);
    command->callback([flags] {
        const VoiceBench& b = flags->bench;
        nlohmann::json r{{"frame_ms", b.frame_ms},
                         {"device_period_ms", 10},
                         {"cameras", b.cameras.size()},
                         {"mouth_to_ear_ms", mouth_to_ear(b)}};
        if (b.host_namespace.empty()) {
            const nlohmann::json cores = host_cores_of_24(b.seconds);
            r["host_cores_24_participants"] = cores["cores"];
            r["host_idle_cores"] = cores["idle_cores"];
            r["arrived_share"] = cores["arrived_share"];
            r["lost_5_percent"] = lost_5_percent(b.frame_ms);
            r["callback_under_load"] = callback_under_load(b.seconds);
        }
        report(r, flags->json, [&] {
            const auto& delay = r["mouth_to_ear_ms"];
            std::printf("mouth to ear, packets of %d ms: p50 %.1f ms, p95 %.1f ms, max %.1f ms\n",
                        b.frame_ms, delay["p50"].get<double>(), delay["p95"].get<double>(),
                        delay["max"].get<double>());
            std::printf("  concealed: %.2f %%, at most %.0f ms in a row\n",
                        delay["concealed"]["percent"].get<double>(),
                        delay["concealed"]["longest_ms"].get<double>());
            if (delay.contains("after_color"))
                std::printf("the speaker's colour: age p50 %.1f ms, the voice is %.1f ms later\n",
                            delay["color_age_p50"].get<double>(),
                            delay["after_color"].get<double>());
            if (!r.contains("lost_5_percent"))
                return;
            std::printf("host, 24 participants: %.3f cores with 4 speakers, %.3f without\n",
                        r["host_cores_24_participants"].get<double>(),
                        r["host_idle_cores"].get<double>());
            const auto& lost = r["lost_5_percent"];
            std::printf("5 %% lost, 30 ms of jitter: longest gap %.0f ms, %.2f %% concealed\n",
                        lost["longest_gap_ms"].get<double>(),
                        lost["concealed_percent"].get<double>());
            const auto& callback = r["callback_under_load"];
            std::printf(
                "callback of 4 speakers on a busy machine: p50 %.1f us, p99 %.1f us, max "
                "%.1f us of %d us; %.0f ms of sound were missing\n",
                callback["p50_us"].get<double>(), callback["p99_us"].get<double>(),
                callback["max_us"].get<double>(), callback["period_us"].get<int>(),
                callback["missing_ms"].get<double>());
        });
    });
}

}  // namespace theatron::bench
