// SPDX-License-Identifier: Apache-2.0
// theatron relay
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "base/utc.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "files/json_text.h"
#include "link_argument.h"
#include "relay/relay.h"
#include "session/ipv4_network.h"

namespace theatron::app {
namespace {

using Phase = relay::Upstream::Phase;

struct RelayFlags {
    std::string link, listen = "0.0.0.0:0", name = "relay";
    std::vector<std::string> addresses, networks;
    double seconds = 0, every = 0;
};

// Bytes in and out since the last call, as megabits a second.
class Rates {
public:
    void note(const relay::RelayServer::Figures& figures, TimePoint now) {
        const double seconds = to_seconds(now - at_);
        if (seconds > 0 && has_begun_) {
            in = double(figures.bytes_in - in_) * 8e-6 / seconds;
            out = double(figures.bytes_out - out_) * 8e-6 / seconds;
        }
        has_begun_ = true;
        at_ = now;
        in_ = figures.bytes_in;
        out_ = figures.bytes_out;
    }
    double in = 0, out = 0;

private:
    bool has_begun_ = false;
    TimePoint at_;
    std::uint64_t in_ = 0, out_ = 0;
};

nlohmann::json figures_json(const relay::Relay& relay, const Rates& rates) {
    const auto status = relay.status();
    const auto figures = relay.figures();
    return {{"utc", utc_text(utc_now())},
            {"phase", relay::text_of(status.phase)},
            {"problem", status.problem},
            {"host", status.host_name},
            {"joins", status.joins},
            {"addresses", relay.addresses()},
            {"port", relay.port()},
            {"receivers", figures.receivers},
            {"named", figures.named},
            {"mbit_per_s_in", rates.in},
            {"mbit_per_s_out", rates.out},
            {"frames_in", figures.frames_in},
            {"bytes_in", figures.bytes_in},
            {"bytes_out", figures.bytes_out},
            {"dropped", figures.dropped},
            {"keys_asked", figures.keys_asked},
            {"lost", figures.lost},
            {"strangers", figures.strangers},
            {"cached_bytes", figures.cached_bytes}};
}

std::string status_line(const relay::Relay& relay, const Rates& rates) {
    const auto status = relay.status();
    const auto figures = relay.figures();
    char text[160];
    std::snprintf(text, sizeof(text), "  %zu receivers, %.1f Mbit/s in, %.1f Mbit/s out",
                  figures.receivers, rates.in, rates.out);
    return relay::text_of(status.phase) +
           (status.problem.empty() ? std::string() : ": " + status.problem) + text;
}

void check(const RelayFlags& flags) {
    if (flags.addresses.size() > wire::max_relay_addresses)
        throw Error("A relay has at most " + std::to_string(wire::max_relay_addresses) +
                    " addresses.");
    for (const std::string& address : flags.addresses)
        if (!net::can_be_linked(address))
            throw Error("'" + clean_text(address, 80) +
                        "' is no name or address of a machine; the port is that of --listen.");
    if (flags.networks.size() > wire::max_relay_networks)
        throw Error("A relay is for at most " + std::to_string(wire::max_relay_networks) +
                    " networks.");
    for (const std::string& network : flags.networks)
        if (!session::parse_ipv4_network(network))
            throw Error("'" + clean_text(network, 80) +
                        "' is no IPv4 network; 10.2.0.0/16 is one, and 10.2.3.4 is one machine.");
}

void run(const RelayFlags& flags) {
    check(flags);
    relay::Relay::Options options;
    options.link = parse_link_argument(flags.link);
    options.listen = net::parse_endpoint(flags.listen);
    options.addresses = flags.addresses;
    options.networks = flags.networks;
    options.name = flags.name;
    options.remark = [](const std::string& text) { log::say(text); };
    cli::catch_stop_signals();
    relay::Relay relay(std::move(options));
    log::info("relay", "listening",
              {{"port", int(relay.port())}, {"address", relay.addresses().front()}});
    const bool live_line = flags.every <= 0 && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line{};
    Rates rates;
    bool said = false;
    while (!cli::stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(50ms);
        const auto status = relay.status();
        if (status.phase == Phase::refused)
            throw Error(status.problem);
        if (status.phase == Phase::ended)
            break;
        if (status.phase == Phase::joined && !std::exchange(said, true))
            log::say("Relay of '" + status.host_name + "': receivers come to " +
                     net::host_and_port(relay.addresses().front(), relay.port()) + ".");
        if (steady_now() < next_line)
            continue;
        rates.note(relay.figures(), steady_now());
        if (flags.every > 0)
            output::print(files::json_text(figures_json(relay, rates)) + "\n");
        else if (live_line)
            output::status_line(status_line(relay, rates));
        next_line = steady_now() + (flags.every > 0 ? seconds_to_duration(flags.every) : 1000ms);
    }
    cli::begin_end();
    output::end_status_line();
}

}  // namespace

void add_relay_command(CLI::App& app) {
    const auto flags = std::make_shared<RelayFlags>();
    CLI::App* command = app.add_subcommand(
        "relay",
        "Send a session's pictures on to many receivers, so that the host sends them once");
    command->footer(
        "The host makes the link with 'theatron link --role relay'. Receivers open the host's "
        "links "
        "as ever:\nthe host names them this relay, and sends by itself where it cannot be reached. "
        "The relay sees no\npicture, since they are sealed for the people of the session, and "
        "keeps "
        "nothing on a disk.\n"
        "\nExamples:\n"
        "  theatron relay @relay.link --listen 0.0.0.0:7850\n"
        "  theatron relay @relay.link --listen 0.0.0.0:7850 --address relay.ward3.example --for "
        "10.3.0.0/16\n"
        "  theatron relay @relay.link --every 1");
    command->add_option("link", flags->link, "The link for relays, or @FILE with it")->required();
    command
        ->add_option("--listen", flags->listen,
                     "ADDRESS:PORT for receivers; port 0 lets the system choose")
        ->capture_default_str();
    command
        ->add_option("--address", flags->addresses,
                     "Name or address under which receivers reach this machine; by default its own "
                     "IPv4 addresses. Repeat for more, to be tried in this order")
        ->allow_extra_args(false);
    command
        ->add_option("--for", flags->networks,
                     "Only for receivers that the host sees in this IPv4 network, 10.2.0.0/16; by "
                     "default for all that have no relay of their network. Repeat for more")
        ->allow_extra_args(false);
    command->add_option("--name", flags->name, "Name shown in the host's figures")
        ->capture_default_str();
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    cli::add_seconds_option(*command, flags->every,
                            "Print figures as a JSON line this often, in seconds", "--every");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
