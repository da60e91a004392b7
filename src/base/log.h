// SPDX-License-Identifier: Apache-2.0
// Events that a person can act on, one line each on standard error:
// `12:01:07 info net: participant joined id=3 address=127.0.0.1`.
//
// Anything per frame or per packet is a counter, never a log line. Safe from
// any thread. Pure folders do not log.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>

namespace theatron::log {

enum class Level { debug, info, warning, error };

// One `key=value` of a line; text with spaces is quoted.
struct Field {
    Field(std::string_view k, std::string_view v) : key(k), value(v) {}
    Field(std::string_view k, const char* v) : key(k), value(v) {}
    Field(std::string_view k, std::integral auto v) : key(k), value(std::to_string(v)) {}
    Field(std::string_view k, double v) : key(k), value(std::to_string(v)) {}

    std::string_view key;
    std::string value;
};

// Lines below this level are dropped; info at start.
void set_level(Level lowest);

void write(Level level, std::string_view area, std::string_view what,
           std::initializer_list<Field> fields = {});

inline void info(std::string_view area, std::string_view what,
                 std::initializer_list<Field> fields = {}) {
    write(Level::info, area, what, fields);
}
inline void warning(std::string_view area, std::string_view what,
                    std::initializer_list<Field> fields = {}) {
    write(Level::warning, area, what, fields);
}
inline void error(std::string_view area, std::string_view what,
                  std::initializer_list<Field> fields = {}) {
    write(Level::error, area, what, fields);
}

}  // namespace theatron::log
