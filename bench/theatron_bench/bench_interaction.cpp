// SPDX-License-Identifier: Apache-2.0
#include "bench_interaction.h"

#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_case.h"
#include "bench_grabs.h"
#include "bench_network.h"
#include "child_process.h"
#include "client/participant.h"
#include "process_usage.h"

namespace theatron::bench {
namespace {

using client::Participant;

// Threads of decoders share core 0 with busy ones.
class Crowd {
public:
    explicit Crowd(int threads) {
        if (threads == 0)
            return;
        for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
            std::string name;
            std::getline(std::ifstream(task.path() / "comm"), name);
            if (name == "decode")
                pin(pid_t(std::stoi(task.path().filename().string())));
        }
        for (int i = 0; i < threads; ++i)
            threads_.emplace_back([this] {
                pin(0);
                while (!stopping_) {
                }
            });
    }
    ~Crowd() {
        stopping_ = true;
        for (std::thread& thread : threads_)
            thread.join();
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

private:
    static void pin(pid_t thread) {
        cpu_set_t core;
        CPU_ZERO(&core);
        CPU_SET(0, &core);
        sched_setaffinity(thread, sizeof(core), &core);
    }
    std::atomic<bool> stopping_ = false;
    std::vector<std::thread> threads_;
};

// A participant with a window, whose settings are not those of the person who measures.
class Drawing {
public:
    Drawing(const net::Link& link, const std::filesystem::path& folder)
        : child_({"join", net::format_link(link), "--name", "window", "--size", "1280x720"},
                 folder) {}
    // Ends it. Returns the number of its pictures. Throws Error.
    int end() {
        child_.interrupt();
        int pictures = 0;
        for (std::string line = child_.read_line(); !line.empty(); line = child_.read_line())
            (void)std::sscanf(line.c_str(), "drew %d pictures", &pictures);
        if (child_.wait().exit_code != 0 || pictures == 0)
            throw Error("The window has drawn nothing; its message is above.");
        return pictures;
    }

private:
    ChildProcess child_;
};

// Written by a participant's network thread.
class Ages {
public:
    void note(const wire::PersonPose& pose) {
        // One machine has one clock, which is the session's.
        const double age = to_ms(steady_now() - pose.time);
        const std::lock_guard lock(mutex_);
        ms_.push_back(age);
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        ms_.clear();
    }
    std::vector<double> all() {
        const std::lock_guard lock(mutex_);
        return ms_;
    }

private:
    std::mutex mutex_;
    std::vector<double> ms_;
};

enum class Part { mover, viewer, actor };

std::unique_ptr<Participant> join(const InteractionBench& bench, const net::Link& link, Ages& ages,
                                  Grabs& grabs, Part part) {
    Participant::Options options;
    options.link = link;
    options.name = part == Part::viewer ? "viewer" : part == Part::actor ? "actor" : "mover";
    options.depth_codec = bench.depth_codec;
    options.color_codec = bench.color_codec;
    if (part == Part::actor) {
        options.delivery = {std::uint32_t(bench.target_latency_ms), 0};
        options.pose = [&ages](ParticipantId, const wire::PersonPose& pose) { ages.note(pose); };
        grabs.prepare_actor(options);
    } else if (part == Part::viewer) {
        grabs.prepare_partner(options);
        options.keeps_cases = !bench.cases.empty();
        options.delivery = {std::uint32_t(bench.target_latency_ms), 0};
        options.pose = [&ages](ParticipantId, const wire::PersonPose& pose) { ages.note(pose); };
    } else {
        constexpr std::uint32_t hardly_any_kbit = 100;
        options.delivery = {0, hardly_any_kbit};
        options.media = [](const wire::MediaHeader&, ByteView) {};
    }
    return std::make_unique<Participant>(std::move(options));
}

void wait_for(const Participant& participant) {
    const TimePoint end = steady_now() + 20s;
    while (participant.status().phase != Participant::Phase::joined) {
        if (steady_now() > end)
            throw Error("A participant did not join: " + participant.status().problem);
        std::this_thread::sleep_for(10ms);
    }
}

wire::PersonPose pose_now(int person) {
    wire::PersonPose pose;
    pose.time = steady_now();
    const auto angle = float(to_seconds(pose.time.time_since_epoch()));
    for (auto* part : {&pose.head, &pose.left_hand, &pose.right_hand})
        *part = wire::PartPose{{std::sin(angle), 1.5F, float(person)}, {1, 0, 0, 0}};
    return pose;
}

nlohmann::json percentiles(const std::vector<double>& values, double less = 0) {
    return {{"p50", percentile(values, 0.5) - less},
            {"p99", percentile(values, 0.99) - less},
            {"max", percentile(values, 1) - less}};
}

}  // namespace

nlohmann::json bench_interaction(const InteractionBench& bench) {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("theatron_interaction_" + std::to_string(getpid()));
    const std::shared_ptr<void> removed(nullptr, [&](void*) {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    });
    const bool shaped = !bench.host_namespace.empty();
    std::vector<std::string> arguments = {
        "host",   "--listen", shaped ? "10.77.0.1:0" : "127.0.0.1:0",
        "--json", "--state",  folder.string()};
    for (const std::string& camera : bench.cameras)
        arguments.insert(arguments.end(), {"--camera", camera});
    if (!bench.cases.empty())
        arguments.insert(arguments.end(), {"--cases", bench.cases});
    enter_namespace(bench.host_namespace);
    ChildProcess host(arguments);
    const auto greeting = nlohmann::json::parse(host.read_line(), nullptr, false);
    if (!greeting.is_object())
        throw Error("The host did not start; its message is above.");
    const net::Link link = net::parse_link(greeting["link"].get<std::string>());

    Ages ages, ages_of_actor;
    Grabs grabs;  // longer than the participants
    std::vector<std::unique_ptr<Participant>> people;
    for (int i = 0; i < bench.people; ++i)
        people.push_back(join(bench, link, ages, grabs, Part::mover));
    enter_namespace(bench.viewer_namespace);
    const auto viewer = join(bench, link, ages, grabs, Part::viewer);
    const auto actor = join(bench, link, ages_of_actor, grabs, Part::actor);
    for (const auto& person : people)
        wait_for(*person);
    wait_for(*viewer);
    wait_for(*actor);
    grabs.begin(*actor, *viewer);
    if (!bench.cases.empty())
        open_offered_case(*viewer);
    const Crowd crowd(bench.crowd);
    std::optional<Drawing> drawing;
    if (bench.draws)
        drawing.emplace(link, folder / "window");

    const TimePoint begin = steady_now() + seconds_to_duration(bench.warmup_seconds);
    const TimePoint end = begin + seconds_to_duration(bench.seconds);
    const Duration period = seconds_to_duration(1 / bench.poses_per_second);
    std::vector<double> round_trips;
    int pongs = 0;
    bool measuring = false;
    double host_cpu = 0;
    session::ContentFetch::Progress fetched;
    for (TimePoint next = steady_now(); next < end; next += period) {
        std::this_thread::sleep_until(std::chrono::steady_clock::now() +
                                      std::max(next - steady_now(), Duration(0)));
        for (std::size_t i = 0; i < people.size(); ++i)
            people[i]->send_pose(pose_now(int(i)));
        for (Participant* one : {viewer.get(), actor.get()})
            one->send_pose(pose_now(bench.people + (one == actor.get())));
        grabs.act();
        const Participant::Status status = viewer->status();
        if (!measuring && next >= begin) {
            measuring = true;
            viewer->reset_figures();
            grabs.reset();
            fetched = case_progress(*viewer);
            host_cpu = usage_of(host.pid()).cpu_seconds;
            ages.clear();
            ages_of_actor.clear();
        } else if (measuring && status.pongs != pongs) {
            round_trips.push_back(to_ms(status.newest_round_trip));
        }
        pongs = status.pongs;
    }
    host_cpu = usage_of(host.pid()).cpu_seconds - host_cpu;
    // The first call asks the decoders' threads for the figures of this moment, and returns older
    // ones.
    (void)viewer->figures();
    std::this_thread::sleep_for(50ms);
    const auto figures = viewer->figures();
    const std::vector<double> ages_ms = ages.all(), actor_ms = ages_of_actor.all();
    if (ages_ms.empty() || actor_ms.empty() || round_trips.empty() || figures.empty())
        throw Error("Nothing came to the viewer.");
    double fps = 1e9, mbit = 0, age_p50 = 0, age_p99 = 0;
    for (const auto& stream : figures) {
        fps = std::min(fps, double(stream.frames) / bench.seconds);
        mbit += double(stream.bytes) * 8e-6 / bench.seconds;
        age_p50 = std::max(age_p50, stream.age_p50_ms);
        age_p99 = std::max(age_p99, stream.age_p99_ms);
    }
    nlohmann::json of_case;
    if (const auto now = case_progress(*viewer); !bench.cases.empty())
        of_case = {{"mbit_per_s", double(now.got - fetched.got) * 8e-6 / bench.seconds},
                   {"got", now.got},
                   {"all", now.all}};
    nlohmann::json drawn;
    if (drawing)
        drawn = drawing->end();
    const nlohmann::json late = percentiles(ages_ms, bench.link_delay_ms);
    return {{"p50_ms", late["p50"]},
            {"p99_ms", late["p99"]},
            {"max_ms", late["max"]},
            {"participants", bench.people + 2 + bench.draws},
            {"grabs", grabs.result()},
            {"host_cores", host_cpu / bench.seconds},
            {"cameras", bench.cameras.size()},
            {"poses", ages_ms.size()},
            {"poses_without_pictures_ms", percentiles(actor_ms, bench.link_delay_ms)},
            {"link_delay_ms", bench.link_delay_ms},
            {"crowd", bench.crowd},
            {"round_trip_ms", percentiles(round_trips, 2 * bench.link_delay_ms)},
            {"pictures",
             {{"fps_min", fps},
              {"mbit_per_s", mbit},
              {"age_ms", {{"p50", age_p50}, {"p99", age_p99}}}}},
            {"case", of_case},
            {"drawn", drawn}};
}

}  // namespace theatron::bench
