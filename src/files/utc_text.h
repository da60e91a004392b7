// SPDX-License-Identifier: Apache-2.0
// Times of day in whole seconds, as RFC 3339 in UTC: "2026-11-22T20:15:00Z". base/utc.h has those
// with milliseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace theatron::files {

// Seconds since 1970 in UTC, without leap seconds.
using UtcSeconds = std::int64_t;

UtcSeconds utc_now();
// Empty for a time that has no text, beyond the year 9999.
std::string utc_text(UtcSeconds time);
// The time of such a text without a fraction; nullopt for any other text.
std::optional<UtcSeconds> parse_utc(std::string_view text);

}  // namespace theatron::files
