// SPDX-License-Identifier: Apache-2.0
// Reading calibration out of untrusted JSON: every type is checked, the first
// thing that is wrong is kept as the end of a sentence. Nothing throws.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "geometry/calibration.h"

namespace theatron::capture {

// A calibration understood, or what is wrong with the text, as the end of a
// sentence that begins with its name ("is not JSON").
struct ParsedCalibration {
    Calibration calibration;
    std::string problem;  // empty if `calibration` holds
};

class JsonFields {
public:
    using Json = nlohmann::json;

    // The whole text, or null and a problem.
    Json parse(std::string_view text);

    // The member `key`, or null and a problem where `object` has none.
    const Json& member(const Json& object, const char* key);
    bool has(const Json& object, const char* key) const {
        return object.is_object() && object.contains(key);
    }

    double number(const Json& object, const char* key);
    double number_or(const Json& object, const char* key, double fallback);
    int integer(const Json& object, const char* key);
    // Exactly, or `at_least`, out.size() numbers.
    void numbers(const Json& object, const char* key, std::span<double> out, bool at_least = false);

    // Nine numbers, row by row, that must be a rotation.
    Quat rotation_matrix(const Json& object, const char* key);
    Vec3 vector(const Json& object, const char* key);

    // Keys that nobody knows are mistyped ones.
    void only(const Json& object, const char* what, std::initializer_list<std::string_view> known);

    void note(std::string problem);
    const std::string& problem() const { return problem_; }

private:
    std::string problem_;
};

// The problem with a calibration whose numbers were read, if it is not one
// that a camera can have.
std::string implausibility(const Calibration& calibration);

std::string to_text(Size size);  // "640x480"

}  // namespace theatron::capture
