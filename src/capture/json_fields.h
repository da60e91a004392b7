// SPDX-License-Identifier: Apache-2.0
// Reads calibrations from untrusted JSON. All types are checked; the first problem is stored
// as the end of a sentence. Nothing throws.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "geometry/calibration.h"

namespace theatron::capture {

// A calibration, or the problem with the text, as the end of a sentence that begins with the
// text's name ("is not JSON").
struct ParsedCalibration {
    Calibration calibration;
    std::string problem;  // empty if `calibration` holds
};

class JsonFields {
public:
    using Json = nlohmann::json;

    // Parses the text; null on failure, with a problem.
    Json parse(std::string_view text);

    // The member `key`; null, with a problem, if `object` has none.
    const Json& member(const Json& object, const char* key);
    bool has(const Json& object, const char* key) const {
        return object.is_object() && object.contains(key);
    }

    double number(const Json& object, const char* key);
    double number_or(const Json& object, const char* key, double fallback);
    int integer(const Json& object, const char* key);
    // Reads out.size() numbers; the array has exactly that many, or `at_least` that many.
    void numbers(const Json& object, const char* key, std::span<double> out, bool at_least = false);

    // Reads nine numbers, row by row, which must be a rotation.
    Quat rotation_matrix(const Json& object, const char* key);
    Vec3 vector(const Json& object, const char* key);

    // Reports unknown keys, which are probably misspelt.
    void only(const Json& object, const char* what, std::initializer_list<std::string_view> known);

    void note(std::string problem);
    const std::string& problem() const { return problem_; }

private:
    std::string problem_;
};

// The problem with a calibration whose numbers were read; empty if a camera can have it.
std::string implausibility(const Calibration& calibration);

std::string to_text(Size size);  // "640x480"

}  // namespace theatron::capture
