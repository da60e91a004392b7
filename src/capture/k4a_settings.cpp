// SPDX-License-Identifier: Apache-2.0
#include "capture/k4a_settings.h"

#include <charconv>

#include "base/lasting_error.h"

namespace theatron::capture::k4a {
namespace {

template <class T>
struct Choice {
    const char* name;
    T value;
    Size picture = {};
    int max_fps = 30;
};

constexpr Choice<DepthMode> depth_modes[] = {
    {"nfov", DepthMode::nfov, {640, 576}},
    {"nfov2x2", DepthMode::nfov_2x2, {320, 288}},
    {"wfov2x2", DepthMode::wfov_2x2, {512, 512}},
    {"wfov", DepthMode::wfov, {1024, 1024}, 15},
};
constexpr Choice<ColorResolution> color_modes[] = {
    {"720", ColorResolution::p720, {1280, 720}},
    {"off", ColorResolution::off},
    {"1080", ColorResolution::p1080, {1920, 1080}},
    {"1440", ColorResolution::p1440, {2560, 1440}},
    {"1536", ColorResolution::p1536, {2048, 1536}},
    {"2160", ColorResolution::p2160, {3840, 2160}},
    {"3072", ColorResolution::p3072, {4096, 3072}, 15},
};
constexpr Choice<FrameRate> frame_rates[] = {
    {"30", FrameRate::fps30, {}, 30},
    {"15", FrameRate::fps15, {}, 15},
    {"5", FrameRate::fps5, {}, 5},
};
constexpr Choice<SyncRole> sync_roles[] = {
    {"standalone", SyncRole::standalone},
    {"master", SyncRole::master},
    {"subordinate", SyncRole::subordinate},
};
// 1 and 2 are the interface's numbers for the mains frequencies.
constexpr Choice<std::int32_t> powerlines[] = {{"", 0}, {"50", 1}, {"60", 2}};

// The first choice is the default.
template <class T, std::size_t N>
const Choice<T>& take_choice(Options& options, const char* key, const Choice<T> (&choices)[N]) {
    const std::string wanted = options.take(key, choices[0].name);
    std::string names;
    for (const Choice<T>& choice : choices) {
        if (wanted == choice.name)
            return choice;
        if (*choice.name)
            names += (names.empty() ? "" : ", ") + std::string(choice.name);
    }
    throw LastingError("The camera 'k4a' has no " + std::string(key) + "=" + wanted +
                       "; there are " + names + ".");
}

std::optional<int> read_int(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

// Parses `key`=auto, or a number from `min` to `max`.
ControlSetting take_control(Options& options, const char* key, ColorControl control, int min,
                            int max) {
    const std::string wanted = options.take(key, "");
    ControlSetting setting{.control = control, .option = key, .asked_for = !wanted.empty()};
    if (wanted.empty() || wanted == "auto")
        return setting;
    const std::optional<int> value = read_int(wanted);
    if (!value || *value < min || *value > max)
        throw LastingError("The camera 'k4a' takes " + std::string(key) +
                           "=auto or a number from " + std::to_string(min) + " to " +
                           std::to_string(max) + ", not '" + wanted + "'.");
    setting.mode = ControlMode::manual;
    setting.value = *value;
    return setting;
}

std::uint32_t read_index(const std::string& text) {
    constexpr int max_index = 255;
    const std::optional<int> index = text.empty() ? 0 : read_int(text);
    if (!index || *index < 0 || *index > max_index)
        throw LastingError("The camera 'k4a' takes a number, as in k4a:0, not '" + text + "'.");
    return std::uint32_t(*index);
}

// Reports combinations that devices refuse without a reason.
void check_together(const Settings& settings, int max_fps, const char* limiting) {
    const Configuration& c = settings.configuration;
    if (settings.frames_per_second > max_fps)
        throw LastingError("The camera 'k4a' gives at most " + std::to_string(max_fps) +
                           " fps with " + limiting + "; write fps=15 or fps=5.");
    if (c.sync == SyncRole::master && c.color == ColorResolution::off)
        throw LastingError(
            "A master gives the beat with its colour camera, so sync=master needs colour other "
            "than off.");
    if (c.sync != SyncRole::subordinate && c.delay_off_master_us != 0)
        throw LastingError(
            "delay_us is the distance from the master, so it needs sync=subordinate.");
    if (Duration(c.delay_off_master_us) > settings.period())
        throw LastingError("delay_us may not be longer than from one frame to the next.");
}

}  // namespace

std::string Settings::name() const {
    return serial.empty() ? "k4a:" + std::to_string(index) : "k4a:serial=" + serial;
}

Settings take_settings(Options& options) {
    Settings settings;
    settings.index = read_index(options.value());
    settings.serial = options.take("serial");

    const auto& depth = take_choice(options, "depth", depth_modes);
    const auto& color = take_choice(options, "color", color_modes);
    const auto& rate = take_choice(options, "fps", frame_rates);
    settings.depth = depth.picture;
    settings.color = color.picture;
    settings.frames_per_second = rate.max_fps;

    Configuration& c = settings.configuration;
    c.depth = depth.value;
    c.color = color.value;
    c.frame_rate = rate.value;
    c.sync = take_choice(options, "sync", sync_roles).value;
    c.delay_off_master_us = std::uint32_t(options.take_int("delay_us", 0, 0, 200'000));
    const bool has_color = c.color != ColorResolution::off;
    c.synchronized_only = options.take_flag("synchronized") && has_color;

    const ControlSetting exposure =
        take_control(options, "exposure_us", ColorControl::exposure_us, 100, 200'000);
    ControlSetting white =
        take_control(options, "white_balance", ColorControl::white_balance_kelvin, 2500, 12'500);
    white.value -= white.value % 10;  // the interface accepts multiples of 10 kelvin
    const auto& powerline = take_choice(options, "powerline_hz", powerlines);
    options.require_no_problem();

    if (has_color) {
        settings.controls = {exposure, white};
        if (powerline.value != 0)
            settings.controls.push_back({.control = ColorControl::powerline,
                                         .mode = ControlMode::manual,
                                         .value = powerline.value,
                                         .option = "powerline_hz",
                                         .asked_for = true});
    }
    const bool depth_limits = depth.max_fps < 30;
    check_together(settings, std::min(depth.max_fps, color.max_fps),
                   depth_limits ? "depth=wfov" : "color=3072");
    return settings;
}

}  // namespace theatron::capture::k4a
