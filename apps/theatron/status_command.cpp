// SPDX-License-Identifier: Apache-2.0
// theatron status
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "commands.h"
#include "host_figures.h"
#include "net/https_get.h"

namespace theatron::app {

void add_status_command(CLI::App& app) {
    struct Flags {
        std::string link;
        bool json = false;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("status", "How a running host and its cameras are");
    command->footer("Example: theatron status 'https://HOST:PORT/#join=...&cert=...'");
    command->add_option("link", flags->link, "The link that the host printed")->required();
    command->add_flag("--json", flags->json, "Print everything as one JSON line");
    command->callback([flags] {
        const net::HttpsAnswer answer = net::https_get(net::parse_link(flags->link), "/status");
        if (answer.status == 401)
            throw Error("The host does not know the link's token; ask for its current link.");
        const auto figures = nlohmann::json::parse(answer.body, nullptr, false);
        if (answer.status != 200 || !figures.is_object())
            throw Error("The host does not tell its status; it may be of an older version.");
        if (flags->json)
            std::printf("%s\n", figures.dump().c_str());
        else
            std::printf("%s", to_table(figures).c_str());
    });
}

}  // namespace theatron::app
