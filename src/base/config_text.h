// SPDX-License-Identifier: Apache-2.0
// The text of a configuration file: lines "KEY = VALUE". In that of a host, KEY is an option of
// 'theatron host' without its hyphens.
//
//   # the operating room at the end of the corridor
//   session = OR 3
//   camera = k4a:0
//   link-hours = 12
//
// A line that begins with # is a comment, also after spaces; elsewhere # is a part of the value.
// Spaces around key and value do not count; a value in "..." keeps its own. Lines hold in their
// order, and a key may stand again, as options may.
//
// Pure and safe for any bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace theatron {

// A longer text is refused as a whole.
inline constexpr std::size_t max_config_bytes = 64 * 1024;

struct ConfigLine {
    int line = 0;  // from 1
    std::string key, value;
    bool operator==(const ConfigLine&) const = default;
};

struct ConfigMistake {
    int line = 0;      // from 1; 0: the whole file
    std::string key;   // empty: the line has none
    std::string text;  // without full stop, fit to be shown (base/outside_text.h)
    bool operator==(const ConfigMistake&) const = default;
};

struct ConfigText {
    std::vector<ConfigLine> lines;
    std::vector<ConfigMistake> mistakes;  // all that there are; their lines are not in `lines`
};

ConfigText parse_config(std::string_view text);

// "or-3.conf:12: camera: there is no value.", a line each.
std::string mistakes_text(const std::string& file, const std::vector<ConfigMistake>& mistakes);

}  // namespace theatron
