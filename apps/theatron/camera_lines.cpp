// SPDX-License-Identifier: Apache-2.0
#include "camera_lines.h"

#include <cmath>
#include <optional>
#include <sstream>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/log.h"
#include "capture/crop.h"

namespace theatron::app {
namespace {

using session::CameraAdjustment;

[[noreturn]] void say_how() {
    throw Error(
        "Say 'nudge CAMERA X Y Z [TILT TURN ROLL]' in millimetres and degrees, or 'nudge "
        "CAMERA none'.");
}

[[noreturn]] void say_how_to_crop() {
    throw Error("Say 'crop CAMERA X:Y:WxH' in pixels of its depth picture, or 'crop CAMERA none'.");
}

// The words behind the command; a camera's name may have spaces, numbers and "none" have not.
std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;)
        words.push_back(word);
    return words;
}

std::optional<double> number_in(const std::string& word) {
    std::size_t used = 0;
    try {
        const double value = std::stod(word, &used);
        if (used == word.size() && std::isfinite(value))
            return value;
    } catch (const std::exception&) {
    }
    return std::nullopt;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : " ") + word;
    return text;
}

AdjustLine parse_crop_line(std::vector<std::string> words, const std::vector<std::string>& names,
                           const std::vector<CameraAdjustment>& now) {
    if (words.size() < 3)
        say_how_to_crop();
    const std::string what = words.back();
    words.pop_back();
    words.erase(words.begin());
    AdjustLine result;
    result.camera = find_camera(joined(words), names);
    result.adjustment = now.at(result.camera);
    result.adjustment.region.reset();
    if (what == "none")
        return result;
    const auto crop = capture::parse_crop(what);
    constexpr int most = 0xffff;
    if (!crop || crop->size.width <= 0 || crop->size.height <= 0 || crop->x > most ||
        crop->y > most || crop->size.width > most || crop->size.height > most)
        say_how_to_crop();
    result.adjustment.region =
        session::PictureBox{crop->x, crop->y, crop->size.width, crop->size.height};
    return result;
}

}  // namespace

const char* camera_lines_help() {
    return "'nudge CAMERA X Y Z [TILT TURN ROLL]' (mm along the room's axes and degrees about "
           "them,\nfrom where the camera is registered), 'nudge CAMERA none', 'crop CAMERA "
           "X:Y:WxH' "
           "(the part of its\ndepth that is sent), 'crop CAMERA none'";
}

std::optional<AdjustLine> parse_adjust_line(const std::string& line,
                                            const std::vector<std::string>& names,
                                            const std::vector<CameraAdjustment>& now) {
    std::vector<std::string> words = words_of(line);
    if (!words.empty() && words[0] == "crop")
        return parse_crop_line(std::move(words), names, now);
    if (words.empty() || words[0] != "nudge")
        return std::nullopt;
    words.erase(words.begin());
    std::vector<double> numbers;
    const bool none = words.size() > 1 && words.back() == "none";
    if (none)
        words.pop_back();
    while (!none && words.size() > 1 && numbers.size() < 6) {
        const auto number = number_in(words.back());
        if (!number)
            break;
        numbers.insert(numbers.begin(), *number);
        words.pop_back();
    }
    if (words.empty() || (!none && numbers.size() != 3 && numbers.size() != 6))
        say_how();
    AdjustLine result;
    result.camera = find_camera(joined(words), names);
    result.adjustment = now.at(result.camera);
    result.adjustment.moved_m = result.adjustment.turned_deg = {};
    if (none)
        return result;
    result.adjustment.moved_m = Vec3{numbers[0], numbers[1], numbers[2]} * 0.001;
    if (numbers.size() == 6)
        result.adjustment.turned_deg = {numbers[3], numbers[4], numbers[5]};
    if (length(result.adjustment.moved_m) > CameraAdjustment::max_moved_m ||
        length(result.adjustment.turned_deg) > CameraAdjustment::max_turned_deg)
        throw Error(
            "A camera can be moved by 0.3 m and turned by 15 degrees; beyond that, register it "
            "anew.");
    return result;
}

bool obey_camera_line(client::Participant& participant, const std::string& line) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    std::vector<std::string> names;
    std::vector<CameraAdjustment> now;
    for (const auto& camera : cameras) {
        names.push_back(camera.description.name);
        const auto adjustment = session::decode_adjustment(camera.description.adjustment);
        now.push_back(adjustment ? *adjustment : CameraAdjustment{});
    }
    try {
        const auto wish = parse_adjust_line(line, names, now);
        if (wish && participant.adjust(cameras[wish->camera].description.id, wish->adjustment) == 0)
            throw Error("You have not joined yet, or this host is too old to adjust cameras.");
        return wish.has_value();
    } catch (const Error& error) {
        log::say(error.what());
        return true;
    }
}

bool obey_camera_line(host::Host& host, const std::string& line) {
    try {
        const auto wish = parse_adjust_line(line, host.camera_names(), host.adjustments());
        if (wish)
            host.adjust(wish->camera, wish->adjustment);
        return wish.has_value();
    } catch (const Error& error) {
        log::say(error.what());
        return true;
    }
}

}  // namespace theatron::app
