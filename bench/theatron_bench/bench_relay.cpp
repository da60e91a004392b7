// SPDX-License-Identifier: Apache-2.0
#include "bench_relay.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "bench_report.h"
#include "child_process.h"
#include "cli/camera_option.h"
#include "cli/number_check.h"
#include "cli/progress.h"
#include "client/participant.h"
#include "net/certificate.h"
#include "process_usage.h"
#include "temporary_folder.h"
#include "this_machine.h"

namespace theatron::bench {
namespace {

struct RelayFlags {
    std::vector<std::string> cameras;
    std::vector<int> receivers = {1, 60};
    double seconds = 10;
    std::string color_codec = "auto", json;
};

// A receiver that decodes nothing. A picture from a relay is opened, and so checked whole.
class StubReceiver {
public:
    explicit StubReceiver(const net::Link& link, const std::string& color_codec, bool by_relay) {
        client::Participant::Options options;
        options.link = link;
        options.name = "stub";
        options.color_codec = color_codec;
        options.by_relay = by_relay;
        options.person = net::random_bytes(wire::person_id_size);
        options.delivery.target_latency_ms = 0;
        options.media = [this](const wire::MediaHeader& header, ByteView message) {
            on_media(header, message.size());
        };
        begun_ = steady_now();
        participant_ = std::make_unique<client::Participant>(options);
    }

    struct Figures {
        std::vector<double> ages_ms;
        std::uint64_t frames = 0, bytes = 0;
    };
    Figures take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(figures_, {});
    }
    // From the call of the constructor until each of the streams has come; nullopt: not yet.
    std::optional<double> complete_after(std::size_t streams) const {
        const std::lock_guard lock(mutex_);
        return streams_.size() < streams ? std::nullopt : std::optional(complete_);
    }
    bool is_by_relay() const { return !participant_->relayed_streams().empty(); }

private:
    void on_media(const wire::MediaHeader& header, std::size_t size) {
        const TimePoint now = participant_ ? participant_->now() : TimePoint();
        const std::lock_guard lock(mutex_);
        if (streams_.insert(header.stream).second)
            complete_ = to_seconds(steady_now() - begun_);
        ++figures_.frames;
        figures_.bytes += size;
        figures_.ages_ms.push_back(to_ms(now - header.captured));
    }

    mutable std::mutex mutex_;
    Figures figures_;             // guarded by mutex_, as are the next
    std::set<StreamId> streams_;  // that have come
    double complete_ = 0;
    TimePoint begun_;
    std::unique_ptr<client::Participant> participant_;  // its thread uses all above
};

double percentile(std::vector<double>& values, double share) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[std::size_t(share * double(values.size() - 1))];
}

// Bytes that all sockets at this port have sent, those that are gone left out.
double sent_from(std::uint16_t port) {
    const std::string command = "ss -tinH 'sport = :" + std::to_string(port) + "'";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    if (!pipe)
        throw Error("'ss' of the package iproute2 is needed.");
    double sum = 0;
    char line[4096];
    while (std::fgets(line, sizeof(line), pipe.get())) {
        const std::string text = line;
        if (const auto at = text.find("bytes_sent:"); at != std::string::npos)
            sum += std::stod(text.substr(at + 11));
    }
    return sum;
}

// Processor time for a gigabyte of AES-128-GCM in records of 16 KiB, as TLS has it.
double aes_seconds_per_gb() {
    const std::unique_ptr<EVP_CIPHER_CTX, void (*)(EVP_CIPHER_CTX*)> cipher(EVP_CIPHER_CTX_new(),
                                                                            EVP_CIPHER_CTX_free);
    unsigned char key[16] = {1}, nonce[12] = {2};
    std::vector<unsigned char> in(16384), out(16384 + 16);
    constexpr int records = 16384;  // 268 MB
    const TimePoint begun = steady_now();
    for (int i = 0; i < records; ++i) {
        int written = 0;
        nonce[0] = static_cast<unsigned char>(i);
        if (EVP_EncryptInit_ex(cipher.get(), EVP_aes_128_gcm(), nullptr, key, nonce) != 1 ||
            EVP_EncryptUpdate(cipher.get(), out.data(), &written, in.data(), int(in.size())) != 1)
            throw Error("OpenSSL cannot encrypt here.");
    }
    return to_seconds(steady_now() - begun) / (records * 16384e-9);
}

// A host, a relay and some receivers.
nlohmann::json run_once(const RelayFlags& flags, int receivers, bool by_relay) {
    const TemporaryFolder folder;
    const std::string state = (folder.path / "state").string();
    std::vector<std::string> words = {"host",   "--listen", "127.0.0.1:0",
                                      "--json", "--state",  state};
    for (const std::string& camera : flags.cameras)
        words.insert(words.end(), {"--camera", camera});
    ChildProcess host(words);
    const auto greeting = nlohmann::json::parse(host.read_line(), nullptr, false);
    if (!greeting.is_object())
        throw Error("The host did not start; its message is above.");
    const net::Link link = net::parse_link(greeting["link"].get<std::string>());
    std::unique_ptr<ChildProcess> relay;
    std::string relay_link;
    const auto relay_figures = [&] {
        nlohmann::json figures;
        do
            figures = nlohmann::json::parse(relay->read_line(), nullptr, false);
        while (figures.is_object() && figures["phase"] == "connecting");
        if (!figures.is_object())
            throw Error("The relay ended; its message is above.");
        return figures;
    };
    if (by_relay) {
        ChildProcess maker({"link", "--role", "relay", "--state", state});
        relay_link = maker.read_line();
        (void)maker.wait();
        relay = std::make_unique<ChildProcess>(
            std::vector<std::string>{"relay", relay_link, "--listen", "127.0.0.1:0", "--address",
                                     "127.0.0.1", "--every", "0.2"});
        (void)relay_figures();
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    // One first, so that its coming costs the others nothing; then all within two seconds.
    const std::size_t streams = 2 * flags.cameras.size();
    std::vector<std::unique_ptr<StubReceiver>> stubs;
    for (int i = 0; i < receivers; ++i) {
        stubs.push_back(std::make_unique<StubReceiver>(link, flags.color_codec, by_relay));
        std::this_thread::sleep_for(i == 0 ? std::chrono::milliseconds(3000)
                                           : std::chrono::milliseconds(2000 / receivers));
    }
    std::this_thread::sleep_for(std::chrono::seconds(8));
    std::vector<double> complete;
    int relayed = 0;
    for (std::size_t i = 1; i < stubs.size(); ++i)
        complete.push_back(stubs[i]->complete_after(streams).value_or(99) * 1000);
    for (auto& stub : stubs) {
        relayed += stub->is_by_relay();
        (void)stub->take();
    }
    nlohmann::json first = relay ? relay_figures() : nlohmann::json();
    // Lines of the time before lie in the pipe.
    const auto newest = [&] {
        nlohmann::json figures = first;
        const TimePoint until = steady_now() + std::chrono::milliseconds(100);
        while (relay && steady_now() < until)
            figures = relay_figures();
        return figures;
    };
    first = newest();
    const ProcessUsage host_before = usage_of(host.pid());
    const ProcessUsage relay_before = relay ? usage_of(relay->pid()) : ProcessUsage();
    const double sent_before = sent_from(link.port);
    const TimePoint begun = steady_now();
    std::this_thread::sleep_for(seconds_to_duration(flags.seconds));
    const double seconds = to_seconds(steady_now() - begun);
    const ProcessUsage host_after = usage_of(host.pid());
    const ProcessUsage relay_after = relay ? usage_of(relay->pid()) : ProcessUsage();
    const double sent = sent_from(link.port) - sent_before;
    std::vector<double> ages;
    double bytes = 0, fewest = 1e18, most = 0;
    for (auto& stub : stubs) {
        StubReceiver::Figures figures = stub->take();
        ages.insert(ages.end(), figures.ages_ms.begin(), figures.ages_ms.end());
        bytes += double(figures.bytes);
        fewest = std::min(fewest, double(figures.frames));
        most = std::max(most, double(figures.frames));
    }
    nlohmann::json result = {
        {"receivers", receivers},
        {"by_relay", by_relay},
        {"relayed", relayed},
        {"mbit_per_s_receiver", bytes * 8e-6 / seconds / receivers},
        {"host_cores", (host_after.cpu_seconds - host_before.cpu_seconds) / seconds},
        {"host_mbit_per_s_out", sent * 8e-6 / seconds},
        {"age_ms", {{"p50", percentile(ages, 0.5)}, {"p99", percentile(ages, 0.99)}}},
        {"frames_fewest", fewest},
        {"frames_most", most},
        {"complete_ms", {{"p50", percentile(complete, 0.5)}, {"p95", percentile(complete, 0.95)}}}};
    if (relay) {
        const nlohmann::json last = newest();
        const double cpu = relay_after.cpu_seconds - relay_before.cpu_seconds;
        result["relay_cores"] = cpu / seconds;
        result["relay_cpu_s_per_gb"] = bytes > 0 ? cpu / (bytes * 1e-9) : 0;
        result["relay_memory_mb"] = relay_after.memory_mb;
        result["keys_asked"] = last["keys_asked"];
        result["dropped"] = last["dropped"];
    }
    stubs.clear();
    if (relay) {
        relay->interrupt();
        (void)relay->wait();
    }
    host.interrupt();
    (void)host.wait();
    return result;
}

nlohmann::json measure(const RelayFlags& flags) {
    const capture::Progress progress = cli::show_progress();
    require_outputs({flags.json});
    nlohmann::json runs = nlohmann::json::array();
    const double aes = aes_seconds_per_gb();
    std::size_t done = 0;
    for (const bool by_relay : {false, true})
        for (const int receivers : flags.receivers) {
            // The host alone for a few: many would fill the machine with its copies.
            if (!by_relay && receivers != flags.receivers.front())
                continue;
            progress("measuring host and relay",
                     double(done++) / double(flags.receivers.size() + 1));
            runs.push_back(run_once(flags, receivers, by_relay));
        }
    progress("measuring host and relay", 1);
    return {{"processor", processor_name()},
            {"cores", std::thread::hardware_concurrency()},
            {"aes_128_gcm_s_per_gb", aes},
            {"runs", runs}};
}

void print_relay(const nlohmann::json& r) {
    std::printf("%s, %d cores; AES-128-GCM %.2f s a GB\n\n",
                r["processor"].get<std::string>().c_str(), r["cores"].get<int>(),
                r["aes_128_gcm_s_per_gb"].get<double>());
    std::printf("  %9s %6s %13s %10s %14s %11s %11s %8s %8s %13s %5s\n", "receivers", "way",
                "Mbit/s each", "host cores", "host Mbit/s", "relay cores", "relay s/GB", "age p50",
                "age p99", "complete p95", "keys");
    for (const auto& run : r["runs"])
        std::printf("  %9d %6s %13.1f %10.2f %14.1f %11.2f %11.2f %8.1f %8.1f %13.0f %5d\n",
                    run["receivers"].get<int>(), run["by_relay"].get<bool>() ? "relay" : "host",
                    run["mbit_per_s_receiver"].get<double>(), run["host_cores"].get<double>(),
                    run["host_mbit_per_s_out"].get<double>(), run.value("relay_cores", 0.0),
                    run.value("relay_cpu_s_per_gb", 0.0), run["age_ms"]["p50"].get<double>(),
                    run["age_ms"]["p99"].get<double>(), run["complete_ms"]["p95"].get<double>(),
                    run.value("keys_asked", 0));
}

}  // namespace

void add_relay_bench(CLI::App& bench) {
    const auto flags = std::make_shared<RelayFlags>();
    CLI::App* command = bench.add_subcommand(
        "relay", "What a host and its relay need for one receiver and for many");
    command->footer(
        "Host, relay and receivers run on this machine. The receivers decode nothing; what comes "
        "from the relay\nis opened, and so checked whole.\n"
        "Example: theatron bench relay\n"
        "Example: theatron bench relay --receivers 1 --receivers 100 --seconds 30 --json "
        "relay.json");
    cli::add_camera_option(*command, flags->cameras,
                           "A camera or recording, kind:value,key=value; one of the generated room "
                           "without it");
    command->add_option("--receivers", flags->receivers, "Receivers of a run; repeat for more runs")
        ->allow_extra_args(false)
        ->check(CLI::Range(1, 120));
    command->add_option("--color-codec", flags->color_codec, "Colour of the receivers")
        ->capture_default_str();
    command->add_option("--seconds", flags->seconds, "Measured time of a run")
        ->capture_default_str()
        ->check(cli::number_from_to(2, 3600));
    add_json_option(*command, flags->json);
    command->callback([flags] {
        if (flags->cameras.empty())
            flags->cameras = {"synthetic:room,seconds=2,camera=0"};
        const nlohmann::json result = measure(*flags);
        report(result, flags->json, [&] { print_relay(result); });
    });
}

}  // namespace theatron::bench
