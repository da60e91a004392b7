// SPDX-License-Identifier: Apache-2.0
// Events that a person can act on, one line each on standard error:
// `12:01:07 info net: participant joined id=3 address=127.0.0.1`.
//
// Anything per frame or per packet is a counter, never a log line. Safe from
// any thread, and never blocks: a thread of its own writes the lines, and lines
// that it cannot write in time are left out and counted. Pure folders do not log.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/time.h"

namespace theatron::log {

enum class Level { debug, info, warning, error };

// Longer values are cut. Outside text is what another program or machine wrote.
inline constexpr std::size_t max_field_characters = 300, max_outside_characters = 80;

// One `key=value` of a line; text with spaces is quoted, control characters become spaces.
struct Field {
    Field(std::string_view k, std::string_view v) : key(k), value(v) {}
    Field(std::string_view k, const char* v) : key(k), value(v) {}
    Field(std::string_view k, std::integral auto v) : key(k), value(std::to_string(v)) {}
    Field(std::string_view k, double v) : key(k), value(std::to_string(v)) {}

    std::string_view key;
    std::string value;
    std::size_t max_characters = max_field_characters;
};

inline Field outside(std::string_view key, std::string_view value) {
    Field field(key, value);
    field.max_characters = max_outside_characters;
    return field;
}

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

// A sentence for the person at the terminal, without time and area; a very long
// one is cut.
void say(std::string_view sentence);

// Waits until all logged lines are written, at most `patience`. Also called at exit.
void flush(Duration patience);

// From now on abort() and std::terminate() wait for the lines, at most half a second.
void flush_before_abort();

}  // namespace theatron::log
