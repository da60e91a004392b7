// SPDX-License-Identifier: Apache-2.0
#include "base/log.h"

#include <atomic>
#include <cstdio>
#include <ctime>

namespace theatron::log {
namespace {

std::atomic<Level> lowest_level{Level::info};

constexpr const char* names[] = {"debug", "info", "warning", "error"};

}  // namespace

void set_level(Level lowest) {
    lowest_level = lowest;
}

void write(Level level, std::string_view area, std::string_view what,
           std::initializer_list<Field> fields) {
    if (level < lowest_level.load(std::memory_order_relaxed))
        return;
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char clock[16];
    std::strftime(clock, sizeof(clock), "%H:%M:%S", &local);

    std::string line = std::string(clock) + " " + names[int(level)] + " " + std::string(area) +
                       ": " + std::string(what);
    for (const Field& field : fields) {
        line += " " + std::string(field.key) + "=";
        const bool plain = field.value.find_first_of(" \"\n\r") == std::string::npos;
        if (plain) {
            line += field.value;
            continue;
        }
        line += '"';
        for (const char c : field.value)
            line += c == '"' ? '\'' : (c == '\n' || c == '\r') ? ' ' : c;
        line += '"';
    }
    line += '\n';
    // One write per line, so that lines of several threads never mix.
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace theatron::log
