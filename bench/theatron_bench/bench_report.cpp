// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
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
    std::ofstream out(file);
    out << files::json_text(result, 2) << "\n";
    if (!out.flush())
        throw Error("Cannot write " + file + ".");
}

}  // namespace theatron::bench
