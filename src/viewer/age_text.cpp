// SPDX-License-Identifier: Apache-2.0
#include "viewer/age_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phrases/phrase.h"

namespace theatron::viewer {

std::string age_text(double ms) {
    const auto rounded = [](double value, const char* unit) {
        char text[40];
        std::snprintf(text, sizeof(text), "%.0f %s", value, unit);
        return std::string(text);
    };
    if (ms < 1000)
        return rounded(ms, "ms");
    if (ms < 120'000)
        return rounded(std::floor(ms / 1000), "s");
    return rounded(std::floor(ms / 60'000), "min");
}

std::string seen_age(double ms, bool is_live) {
    const std::string age = age_text(std::max(ms, 0.0));
    return is_live ? age : say(Phrase::age_not_live, age);
}

std::string picture_title(const std::string& name, std::optional<double> age_ms, bool is_live) {
    if (age_ms)
        return seen_age(*age_ms, is_live) + "  " + name;
    return is_live ? name : say(Phrase::title_not_live, name);
}

}  // namespace theatron::viewer
