// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "files/file_bytes.h"
#include "files/json_text.h"

namespace theatron::bench {

void report(const nlohmann::json& result, const std::string& file,
            const std::function<void()>& print_table) {
    if (file == "-") {
        std::cout << files::json_text(result, 2) << std::endl;
        return;
    }
    print_table();
    if (file.empty())
        return;
    files::write_file(file, as_bytes(files::json_text(result, 2) + "\n"));
}

void add_json_option(CLI::App& command, std::string& file) {
    command.add_option("--json", file,
                       "Write the result to this file; - prints it instead of the table");
}

void require_outputs(std::initializer_list<std::string> files) {
    for (const std::string& file : files)
        if (!file.empty() && file != "-")
            files::require_writable(file);
}

}  // namespace theatron::bench
