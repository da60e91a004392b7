// SPDX-License-Identifier: Apache-2.0
// theatron cameras
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "capture/camera.h"
#include "capture/k4a_device.h"
#include "commands.h"
#include "files/json_text.h"

namespace theatron::app {
namespace {

using capture::k4a::FoundDevice;
using capture::k4a::FoundDevices;

std::string specification(const FoundDevice& device) {
    return "k4a:" + std::to_string(device.index);
}

nlohmann::json to_json(const FoundDevices& found) {
    nlohmann::json devices = nlohmann::json::array();
    for (const FoundDevice& device : found.devices)
        devices.push_back({{"camera", specification(device)},
                           {"serial", device.serial},
                           {"problem", device.problem}});
    return {{"kinds", capture::camera_kinds()},
            {"devices", std::move(devices)},
            {"problem", found.problem}};
}

void print(const FoundDevices& found) {
    std::puts("Kinds of camera, as given to --camera:");
    for (const std::string& line : capture::camera_kinds())
        std::printf("  %s\n", line.c_str());
    std::puts("\nLive cameras:");
    for (const FoundDevice& device : found.devices)
        std::printf(
            "  %-8s  %s\n", specification(device).c_str(),
            device.problem.empty() ? ("serial " + device.serial).c_str() : device.problem.c_str());
    if (!found.problem.empty())
        std::printf("  %s\n", found.problem.c_str());
    else if (found.devices.empty())
        std::puts("  none is plugged in");
}

}  // namespace

void add_cameras_command(CLI::App& app) {
    const auto json = std::make_shared<bool>(false);
    CLI::App* command =
        app.add_subcommand("cameras", "List the kinds of camera and the live ones that are there");
    command->add_flag("--json", *json, "Print as JSON");
    command->footer("Example: theatron cameras");
    command->callback([json] {
        const FoundDevices found = capture::k4a::find_devices();
        if (*json)
            std::cout << files::json_text(to_json(found), 2) << std::endl;
        else
            print(found);
    });
}

}  // namespace theatron::app
