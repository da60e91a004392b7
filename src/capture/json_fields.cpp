// SPDX-License-Identifier: Apache-2.0
#include "capture/json_fields.h"

#include <algorithm>
#include <cmath>

namespace theatron::capture {
namespace {

const JsonFields::Json none;

std::string in_quotes(std::string_view key) {
    return "'" + std::string(key) + "'";
}

bool is_rotation(const Mat3& m) {
    const auto row = [&](int i) { return Vec3{m.m[i][0], m.m[i][1], m.m[i][2]}; };
    constexpr double tolerance = 1e-3;
    return std::abs(dot(row(0), row(1))) < tolerance && std::abs(dot(row(0), row(2))) < tolerance &&
           std::abs(dot(row(0), row(0)) - 1) < tolerance &&
           std::abs(dot(row(1), row(1)) - 1) < tolerance &&
           length(cross(row(0), row(1)) - row(2)) < tolerance;
}

}  // namespace

JsonFields::Json JsonFields::parse(std::string_view text) {
    Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (json.is_object())
        return json;
    note(json.is_discarded() ? "is not JSON" : "is not a JSON object");
    return none;
}

const JsonFields::Json& JsonFields::member(const Json& object, const char* key) {
    if (object.is_object())
        if (const auto found = object.find(key); found != object.end())
            return *found;
    note("lacks " + in_quotes(key));
    return none;
}

double JsonFields::number(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (value.is_number())
        return value.get<double>();
    note("holds no number as " + in_quotes(key));
    return 0;
}

double JsonFields::number_or(const Json& object, const char* key, double fallback) {
    return has(object, key) ? number(object, key) : fallback;
}

int JsonFields::integer(const Json& object, const char* key) {
    const double value = number(object, key);
    if (value == std::floor(value) && std::abs(value) < 1e9)
        return int(value);
    note("holds no whole number as " + in_quotes(key));
    return 0;
}

void JsonFields::numbers(const Json& object, const char* key, std::span<double> out,
                         bool at_least) {
    const Json& list = member(object, key);
    const bool count_ok =
        list.is_array() && (at_least ? list.size() >= out.size() : list.size() == out.size());
    if (!count_ok ||
        !std::all_of(list.begin(), list.end(), [](const Json& v) { return v.is_number(); })) {
        note("holds no list of " + std::to_string(out.size()) + " numbers as " + in_quotes(key));
        return;
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = list[i].get<double>();
}

Quat JsonFields::rotation_matrix(const Json& object, const char* key) {
    double v[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    numbers(object, key, v);
    const Mat3 matrix{{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}}};
    if (is_rotation(matrix))
        return quat_from_matrix(matrix);
    note("holds no rotation matrix as " + in_quotes(key));
    return {};
}

Vec3 JsonFields::vector(const Json& object, const char* key) {
    double v[3] = {};
    numbers(object, key, v);
    return {v[0], v[1], v[2]};
}

void JsonFields::only(const Json& object, const char* what,
                      std::initializer_list<std::string_view> known) {
    if (!object.is_object())
        return note("holds no object as " + in_quotes(what));
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            return note("has the unknown key " + in_quotes(key.substr(0, 40)) + " in " +
                        in_quotes(what));
}

void JsonFields::note(std::string problem) {
    if (problem_.empty())
        problem_ = std::move(problem);
}

// A calibration from a file follows the same rules as one from the network.
std::string implausibility(const Calibration& calibration) {
    return decode_calibration(encode_calibration(calibration)).has_value()
               ? ""
               : "describes an impossible camera";
}

std::string to_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace theatron::capture
