// SPDX-License-Identifier: Apache-2.0
// theatron case
#include <cstdio>
#include <memory>

#include "cases/case_folder.h"
#include "commands.h"

namespace theatron::app {
namespace {

void check(const std::string& folder) {
    const cases::CheckReport report = cases::check_case(folder);
    for (const std::string& problem : report.problems)
        std::printf("problem: %s\n", problem.c_str());
    for (const std::string& remark : report.remarks)
        std::printf("remark: %s\n", remark.c_str());
    if (!report.problems.empty())
        throw CLI::RuntimeError(1);
    std::printf("The case can be shown.\n");
}

void add_check(CLI::App& group) {
    const auto folder = std::make_shared<std::string>();
    CLI::App* command = group.add_subcommand("check", "Says what is wrong with a case.");
    command->add_option("FOLDER", *folder, "The case's folder")->required();
    command->callback([folder] { check(*folder); });
}

}  // namespace

void add_case_command(CLI::App& app) {
    CLI::App* group = app.add_subcommand(
        "case", "The patient's organs and images that a session shows, as folders.");
    group->require_subcommand(1);
    add_check(*group);
}

}  // namespace theatron::app
