// SPDX-License-Identifier: Apache-2.0
#include "base/options.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/shown_address.h"

namespace theatron {
namespace {

std::string in_quotes(std::string_view text) {
    return "'" + std::string(text) + "'";
}

}  // namespace

Options Options::parse(std::string_view text) {
    Options options;
    options.text_ = shown_address(text);
    const auto colon = text.find(':');
    options.kind_ = text.substr(0, colon);
    if (options.kind_.empty())
        options.note("The specification " + in_quotes(options.text_) +
                     " names no kind; write it as kind:value,key=value.");
    if (colon == std::string_view::npos)
        return options;

    std::string_view rest = text.substr(colon + 1);
    // A path may hold commas; only ",key=" ends the value.
    bool first = true;
    while (!rest.empty()) {
        auto end = rest.find(',');
        if (first) {
            while (end != std::string_view::npos) {
                const auto next = rest.substr(end + 1);
                const auto equals = next.find_first_of("=,/");
                if (equals != std::string_view::npos && next[equals] == '=')
                    break;
                end = rest.find(',', end + 1);
            }
        }
        const std::string_view part = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);

        const auto equals = part.find('=');
        const bool is_key = equals != std::string_view::npos && part.find('/') > equals;
        if (first && !is_key) {
            options.value_ = part;
        } else if (!is_key || equals == 0) {
            // It may be the rest of an address.
            options.note("In " + in_quotes(options.text_) + ", " +
                         (options.text_ == text ? in_quotes(part) : "the end") +
                         " is not a key=value pair.");
        } else if (!options.keys_.emplace(part.substr(0, equals), part.substr(equals + 1)).second) {
            options.note("In " + in_quotes(options.text_) + ", the key " +
                         in_quotes(part.substr(0, equals)) + " is given twice.");
        }
        first = false;
    }
    return options;
}

std::string Options::take(std::string_view key, std::string_view fallback) {
    const auto found = keys_.find(key);
    if (found == keys_.end())
        return std::string(fallback);
    std::string value = std::move(found->second);
    keys_.erase(found);
    return value;
}

double Options::take_number(std::string_view key, double fallback, double min, double max) {
    if (!keys_.contains(key))
        return fallback;
    const std::string value = take(key);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (!value.empty() && *end == '\0' && number >= min && number <= max)
        return number;
    char range[64];
    std::snprintf(range, sizeof(range), "%g to %g", min, max);
    note("In " + in_quotes(text_) + ", " + std::string(key) + "=" + value +
         " is not a number from " + range + ".");
    return fallback;
}

int Options::take_int(std::string_view key, int fallback, int min, int max) {
    const double number = take_number(key, fallback, min, max);
    if (number == std::floor(number))
        return int(number);
    note("In " + in_quotes(text_) + ", " + std::string(key) + " must be a whole number.");
    return fallback;
}

bool Options::take_flag(std::string_view key, bool fallback) {
    return take_int(key, fallback, 0, 1) != 0;
}

std::string Options::problem() const {
    if (problem_.empty() && !keys_.empty())
        return "In " + in_quotes(text_) + ", the key " + in_quotes(keys_.begin()->first) +
               " is unknown.";
    return problem_;
}

void Options::require_no_problem() const {
    if (const std::string wrong = problem(); !wrong.empty())
        throw LastingError(wrong);
}

void Options::note(std::string problem) {
    if (problem_.empty())
        problem_ = std::move(problem);
}

}  // namespace theatron
