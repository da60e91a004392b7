// SPDX-License-Identifier: Apache-2.0
#include "capture/folder_files.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>

#include "base/error.h"
#include "base/log.h"
#include "base/small_letters.h"
#include "capture/time_pairing.h"

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;

// Largest difference of time stamps of depth and colour in folders, as their publishers pair them.
constexpr Duration most_apart = std::chrono::milliseconds(20);

constexpr std::string_view digits = "0123456789";

bool is_digit(char c) {
    return digits.find(c) != std::string_view::npos;
}

// The number at the beginning of `text`, without its leading zeros; `text` goes on behind it.
std::string_view take_number(std::string_view& text) {
    std::string_view number = text.substr(0, text.find_first_not_of(digits));
    text.remove_prefix(number.size());
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    return number;
}

// The only number in a name, or empty.
std::string number_in_name(std::string_view stem) {
    const auto begin = stem.find_first_of(digits);
    if (begin == std::string_view::npos)
        return "";
    stem.remove_prefix(begin);
    const std::string_view number = take_number(stem);
    if (stem.find_first_of(digits) != std::string_view::npos)
        return "";
    return number.empty() ? "0" : std::string(number);
}

std::vector<fs::path> pictures(const fs::path& folder,
                               std::initializer_list<std::string_view> endings) {
    std::vector<fs::path> found;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder, problem)) {
        // macOS writes one beside each picture on a disc of another system, as "._00000.png".
        if (entry.path().filename().string().starts_with('.'))
            continue;
        const std::string ending = in_small_letters(entry.path().extension().string());
        if (std::find(endings.begin(), endings.end(), ending) != endings.end())
            found.push_back(entry.path());
    }
    if (problem)
        throw Error("Cannot read the folder '" + folder.string() + "': " + problem.message() + ".");
    std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
        if (a.stem() != b.stem())
            return precedes_naturally(a.stem().string(), b.stem().string());
        return a.filename().string() < b.filename().string();
    });
    return found;
}

std::vector<fs::path> color_pictures(const fs::path& folder) {
    return pictures(folder, {".jpg", ".jpeg", ".png"});
}

// Pairs those that have the same key; an empty key has no partner.
template <class Key>
PairedFrames pair_by(const std::vector<fs::path>& depth, const std::vector<fs::path>& color,
                     Key key) {
    std::map<std::string, const fs::path*> colors;
    for (const fs::path& path : color)
        colors.emplace(key(path.stem().string()), &path);
    PairedFrames paired;
    for (const fs::path& path : depth) {
        const auto same = colors.find(key(path.stem().string()));
        if (same == colors.end() || same->first.empty()) {
            paired.frames.push_back({path, {}});
            ++paired.without_color;
            continue;
        }
        paired.frames.push_back({path, *same->second});
        colors.erase(same);
    }
    paired.unused_colors = color.size() - (depth.size() - paired.without_color);
    return paired;
}

std::optional<PairedFrames> pair_by_time(const std::vector<fs::path>& depth,
                                         const std::vector<fs::path>& color) {
    using Pairing = TimePairing<fs::path>;
    Pairing pairing(most_apart, color.size() + 1);
    const auto add = [](const std::vector<fs::path>& paths, auto put) {
        std::vector<Pairing::Picture> pictures;
        for (const fs::path& path : paths) {
            const auto time = time_in_name(path.stem().string());
            if (!time)
                return false;
            pictures.push_back({*time, path});
        }
        std::stable_sort(pictures.begin(), pictures.end(),
                         [](const auto& a, const auto& b) { return a.time < b.time; });
        for (Pairing::Picture& picture : pictures)
            put(std::move(picture));
        return true;
    };
    if (!add(depth, [&](Pairing::Picture p) { pairing.add_depth(std::move(p)); }) ||
        !add(color, [&](Pairing::Picture p) { pairing.add_color(std::move(p)); }))
        return std::nullopt;
    pairing.finish();
    PairedFrames paired;
    while (auto pair = pairing.take()) {
        paired.without_color += !pair->color;
        paired.frames.push_back(
            {std::move(pair->depth.payload), pair->color ? pair->color->payload : fs::path()});
    }
    paired.unused_colors = color.size() - (depth.size() - paired.without_color);
    return paired;
}

// The folder of this name in `folder`, also in capital letters; empty: there is none.
fs::path folder_named(const fs::path& folder, std::string_view name) {
    if (fs::is_directory(folder / name))
        return folder / name;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_directory(ignored) &&
            in_small_letters(entry.path().filename().string()) == name)
            return entry.path();
    return {};
}

// The folder with the colour pictures; empty: there is none.
fs::path color_folder(const fs::path& folder) {
    for (const char* name : {"color", "rgb", "colour", "image"})
        if (const fs::path found = folder_named(folder, name); !found.empty())
            return found;
    return {};
}

void warn_of_other_folders(const fs::path& folder) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_directory(ignored) &&
            in_small_letters(entry.path().filename().string()) != "depth" &&
            !color_pictures(entry.path()).empty())
            log::warning("capture",
                         "the folder is not read; colour pictures belong into a folder 'color'",
                         {{"folder", entry.path().string()}});
}

}  // namespace

bool precedes_naturally(const std::string& a, const std::string& b) {
    std::string_view x = a, y = b;
    while (!x.empty() && !y.empty()) {
        if (is_digit(x[0]) != is_digit(y[0]))
            return is_digit(x[0]);
        if (is_digit(x[0])) {
            const std::string_view m = take_number(x), n = take_number(y);
            if (m != n)
                return std::pair(m.size(), m) < std::pair(n.size(), n);
            continue;
        }
        if (x[0] != y[0])
            return x[0] < y[0];
        x.remove_prefix(1);
        y.remove_prefix(1);
    }
    if (x.empty() != y.empty())
        return x.empty();
    // Equal but for leading zeros.
    return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
}

std::optional<Duration> time_in_name(const std::string& stem) {
    // "0000001-000000033369": a number, and microseconds since the beginning.
    constexpr std::size_t us_since_begin = 12;
    if (const auto dash = stem.find_first_not_of(digits);
        dash != std::string::npos && dash > 0 && stem[dash] == '-' &&
        stem.size() == dash + 1 + us_since_begin &&
        stem.find_first_not_of(digits, dash + 1) == std::string::npos)
        return seconds_to_duration(std::strtod(stem.c_str() + dash + 1, nullptr) * 1e-6);
    const auto end = stem.find_first_not_of(digits);
    const bool has_fraction = end != std::string::npos && stem[end] == '.' &&
                              end + 1 < stem.size() &&
                              stem.find_first_not_of(digits, end + 1) == std::string::npos;
    if (end == 0 || (end != std::string::npos && !has_fraction))
        return std::nullopt;
    const std::size_t whole = end == std::string::npos ? stem.size() : end;
    // So long since 1970: 10 digits of seconds, 13, 16 or 19 of their thousandths and so on.
    constexpr std::size_t ms = 13, us = 16, ns = 19;
    double unit = 0;
    if (whole == ms || whole == us || whole == ns)
        unit = whole == ms ? 1e-3 : whole == us ? 1e-6 : 1e-9;
    else if (has_fraction && whole <= 10)
        unit = 1;
    if (unit == 0)
        return std::nullopt;
    return seconds_to_duration(std::strtod(stem.c_str(), nullptr) * unit);
}

PairedFrames pair_frames(const std::vector<fs::path>& depth, const std::vector<fs::path>& color) {
    PairedFrames paired = pair_by(depth, color, [](const std::string& stem) { return stem; });
    if (paired.without_color < depth.size())
        return paired;
    if (auto by_time = pair_by_time(depth, color))
        return std::move(*by_time);
    return pair_by(depth, color, [](const std::string& stem) { return number_in_name(stem); });
}

std::vector<FramePaths> folder_frames(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw Error("There is no folder '" + folder.string() + "'.");
    const fs::path depths = folder_named(folder, "depth");
    if (depths.empty())
        throw Error("'" + folder.string() + "' holds no folder 'depth' with 16-bit PNG pictures.");
    const auto depth = pictures(depths, {".png"});
    if (depth.empty())
        throw Error("'" + depths.string() + "' holds no PNG pictures.");

    const fs::path colors = color_folder(folder);
    if (colors.empty())
        warn_of_other_folders(folder);
    PairedFrames paired =
        pair_frames(depth, colors.empty() ? std::vector<fs::path>() : color_pictures(colors));
    if (!colors.empty() && paired.without_color > 0)
        log::warning("capture", "frames have no colour picture of the same name, number or time",
                     {{"folder", folder.string()},
                      {"without", paired.without_color},
                      {"frames", paired.frames.size()}});
    if (paired.unused_colors > 0)
        log::warning("capture", "colour pictures have no depth and are left out",
                     {{"folder", colors.string()}, {"pictures", paired.unused_colors}});
    return std::move(paired.frames);
}

}  // namespace theatron::capture
