// SPDX-License-Identifier: Apache-2.0
#include "base/log.h"

#include <atomic>
#include <ctime>
#include <utility>

#include "base/log_format.h"
#include "base/log_output.h"
#include "base/log_scope.h"
#include "base/outside_text.h"
#include "base/utc.h"

namespace theatron::log {
namespace {

std::atomic<Level> lowest_level{Level::info};
std::atomic<bool> is_json{false};

// Longer sentences are cut.
constexpr std::size_t max_sentence_characters = 1000;

constexpr const char* names[] = {"debug", "info", "warning", "error"};

thread_local const std::string* session = nullptr;  // of the newest SessionScope

void add_field(std::string& line, const Field& field) {
    line += " " + std::string(field.key) + "=";
    const std::string value = clean_text(field.value, field.max_characters);
    if (value.find_first_of(" \"") == std::string::npos) {
        line += value;
        return;
    }
    line += '"';
    for (const char c : value)
        line += c == '"' ? '\'' : c;
    line += '"';
}

// `text` is clean: UTF-8 without control characters.
std::string json_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

std::string json_begin(Level level) {
    return "{\"time\":" + json_string(utc_text(utc_now())) + ",\"level\":\"" + names[int(level)] +
           "\"";
}

std::string json_end() {
    return session
               ? ",\"session\":" + json_string(clean_text(*session, max_outside_characters)) + "}\n"
               : "}\n";
}

std::string json_line(Level level, std::string_view area, std::string_view what,
                      std::initializer_list<Field> fields) {
    std::string values;
    for (const Field& field : fields)
        values += (values.empty() ? "" : ",") + json_string(field.key) + ":" +
                  json_string(clean_text(field.value, field.max_characters));
    return json_begin(level) + ",\"area\":" + json_string(area) +
           ",\"event\":" + json_string(what) + ",\"fields\":{" + values + "}" + json_end();
}

}  // namespace

SessionScope::SessionScope(const std::string& name)
    : name_(name), outer_(std::exchange(session, name.empty() ? nullptr : &name_)) {}

SessionScope::~SessionScope() {
    session = outer_;
}

void set_level(Level lowest) {
    lowest_level = lowest;
}

void write(Level level, std::string_view area, std::string_view what,
           std::initializer_list<Field> fields) {
    if (level < lowest_level.load(std::memory_order_relaxed))
        return;
    if (is_json)
        return output_line(json_line(level, area, what, fields));
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char clock[16];
    std::strftime(clock, sizeof(clock), "%H:%M:%S", &local);

    std::string line = std::string(clock) + " " + names[int(level)] + " " + std::string(area) +
                       ": " + std::string(what);
    for (const Field& field : fields)
        add_field(line, field);
    if (session)
        add_field(line, outside("session", *session));
    output_line(line + '\n');
}

void set_json_lines(bool on) {
    is_json = on;
}

std::string sentence_line(std::string_view sentence) {
    const std::string clean = clean_text(sentence, max_sentence_characters);
    if (is_json)
        return json_begin(Level::info) + ",\"event\":" + json_string(clean) + json_end();
    const std::string of =
        session ? clean_text(*session, max_outside_characters) + ": " : std::string();
    return of + clean + '\n';
}

void say(std::string_view sentence) {
    output_line(sentence_line(sentence));
}

}  // namespace theatron::log
