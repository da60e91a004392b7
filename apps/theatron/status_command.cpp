// SPDX-License-Identifier: Apache-2.0
// theatron status
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "files/json_text.h"
#include "host/host_figures.h"
#include "host/host_http.h"
#include "link_argument.h"

namespace theatron::app {

void add_status_command(CLI::App& app) {
    struct Flags {
        std::string link;
        bool json = false;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("status", "How a running host and its cameras are");
    command->footer("Example: theatron status 'https://HOST:PORT/#join=...&cert=...'");
    command->add_option("link", flags->link, "The link that the host printed, or @FILE with it")
        ->required();
    command->add_flag("--json", flags->json, "Print everything as one JSON line");
    command->callback([flags] {
        const nlohmann::json figures = host::status_of_host(parse_link_argument(flags->link));
        if (flags->json)
            std::printf("%s\n", files::json_text(figures).c_str());
        else
            std::printf("%s", host::to_table(figures).c_str());
    });
}

}  // namespace theatron::app
