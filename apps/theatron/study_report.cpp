// SPDX-License-Identifier: Apache-2.0
#include "study_report.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/private_file.h"
#include "study/tables.h"
#include "study_folder.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* script_name = "study_report/study_report.py";
// Debian's interpreter has Debian's SciPy, also where another one comes first in PATH.
constexpr const char* interpreter = "/usr/bin/python3";

// Beside the program where it was built, else where it was installed.
fs::path script_path() {
    std::error_code error;
    const auto program = fs::read_symlink("/proc/self/exe", error).parent_path();
    const fs::path built = program / script_name;
    const fs::path installed = program.parent_path() / "share/theatron" / script_name;
    const fs::path found = fs::exists(built, error) ? built : installed;
    if (!fs::exists(found, error))
        throw Error("The script of the report, '" + found.string() +
                    "', is missing; install Theatron again.");
    return found;
}

// The exit code; what the script says goes to this program's outputs.
int run_script(const fs::path& script, const fs::path& folder) {
    std::string words[] = {interpreter, "-B", script.string(), folder.string()};
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    if (const int error =
            posix_spawn(&child, interpreter, nullptr, nullptr, arguments.data(), environ);
        error != 0)
        throw Error("The report needs " + std::string(interpreter) +
                    "; install it with: sudo apt install python3 python3-scipy python3-pandas "
                    "python3-matplotlib");
    int state = 0;
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(state) ? WEXITSTATUS(state) : 1;
}

}  // namespace

void write_study_report(const std::string& folder, bool json) {
    const Study study = load_study(folder);
    std::vector<std::string> others;
    const auto journals = load_journals(study, others);
    for (const std::string& other : others)
        std::fprintf(stderr,
                     "%s began with another text of the protocol or its questionnaires and is "
                     "left out.\n",
                     other.c_str());
    if (journals.empty())
        throw Error("'" + study.folder.string() +
                    "' has no participant of this protocol yet; 'theatron study run' makes one.");
    const fs::path report = study.folder / "report";
    files::open_private_folder(report);
    const study::Tables tables = study::tables_of(study.protocol, study.questionnaires, journals);
    const std::pair<const char*, const std::string&> all[] = {
        {"participants.csv", tables.participants},
        {"replies.csv", tables.replies},
        {"scores.csv", tables.scores},
        {"tasks.csv", tables.tasks},
        {"items.csv", tables.items}};
    for (const auto& [name, text] : all)
        files::write_file(report / name, as_bytes(text));
    nlohmann::ordered_json about{
        {"title", study.protocol.title},
        {"seed", study.protocol.seed},
        {"order", study.protocol.order == study::Order::random         ? "random"
                  : study.protocol.order == study::Order::latin_square ? "Latin square"
                                                                       : "as written"},
        {"left_out", others}};
    for (const study::Condition& condition : study.protocol.conditions)
        about["conditions"].push_back(
            {{"name", condition.id}, {"values", study::values_text(condition)}});
    for (const study::Questionnaire& one : study.questionnaires.all)
        about["sources"][one.id] = one.source;
    files::write_file(report / "study.json", as_bytes(files::json_text(about, 1)));
    if (!json)
        std::printf("%zu participants; statistics and figures follow ...\n", journals.size());
    std::fflush(stdout);
    if (run_script(script_path(), report) != 0)
        throw Error("The report was not made; the tables are in '" + report.string() + "'.");
    if (json)
        std::cout << files::json_text(
                         nlohmann::ordered_json{{"report", (report / "report.html").string()},
                                                {"participants", journals.size()},
                                                {"left_out", others}})
                  << std::endl;
    else
        std::printf("%s\n", (report / "report.html").c_str());
}

}  // namespace theatron::app
