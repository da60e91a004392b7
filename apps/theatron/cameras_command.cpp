// SPDX-License-Identifier: Apache-2.0
// theatron cameras
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "capture/camera.h"
#include "capture/k4a_device.h"
#include "capture/x11_windows.h"
#include "commands.h"
#include "files/json_text.h"

namespace theatron::app {
namespace {

using capture::k4a::FoundDevice;
using capture::k4a::FoundDevices;

struct FoundWindows {
    std::vector<capture::X11Window> windows;
    std::string problem;  // why there are none
};

FoundWindows find_windows() {
    try {
        return {capture::list_windows(), ""};
    } catch (const Error& problem) {
        return {{}, problem.what()};
    }
}

std::string specification(const FoundDevice& device) {
    return "k4a:" + std::to_string(device.index);
}

nlohmann::json to_json(const FoundWindows& found) {
    nlohmann::json windows = nlohmann::json::array();
    for (const capture::X11Window& window : found.windows)
        windows.push_back({{"camera", "x11:" + capture::number_text(window.number)},
                           {"title", window.title},
                           {"program", window.program},
                           {"size", {window.size.width, window.size.height}}});
    return windows;
}

void print(const FoundWindows& found) {
    std::puts("\nWindows of this display, as given to --share (x11:display is all of it):");
    for (const capture::X11Window& window : found.windows)
        std::printf("  x11:%-10s  %dx%d  %s: %s\n", capture::number_text(window.number).c_str(),
                    window.size.width, window.size.height, window.program.c_str(),
                    window.title.c_str());
    if (!found.problem.empty())
        std::printf("  %s\n", found.problem.c_str());
    else if (found.windows.empty())
        std::puts("  none is visible");
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
        app.add_subcommand("cameras",
                           "List the kinds of camera, the live ones that are there, and the "
                           "windows that can be shared");
    command->add_flag("--json", *json, "Print as JSON");
    command->footer("Example: theatron cameras");
    command->callback([json] {
        const FoundDevices found = capture::k4a::find_devices();
        const FoundWindows windows = find_windows();
        if (*json) {
            nlohmann::json all = to_json(found);
            all["windows"] = to_json(windows);
            all["windows_problem"] = windows.problem;
            std::cout << files::json_text(all, 2) << std::endl;
        } else {
            print(found);
            print(windows);
        }
    });
}

}  // namespace theatron::app
