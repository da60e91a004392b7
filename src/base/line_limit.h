// SPDX-License-Identifier: Apache-2.0
// Limits the lines of a log for events that others can repeat at will: the log stays readable,
// and the disk does not fill up. Not thread safe; time is an argument.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/time.h"

namespace theatron {

class LineLimit {
public:
    // `at_once`: lines of a source that may follow each other without a pause.
    explicit LineLimit(int at_once = 1) : at_once_(at_once) {}

    // In the long run one line for each source in this time.
    static constexpr Duration interval = std::chrono::seconds(1);
    // Further sources share one limit.
    static constexpr std::size_t max_sources = 64;

    // If a line about `source` may be written now, the number of lines left out before; else empty.
    std::optional<std::uint64_t> take(const std::string& source, TimePoint now);

private:
    struct Source {
        TimePoint next;
        std::uint64_t left_out = 0;
    };
    const int at_once_;
    std::map<std::string, Source> sources_;
    Source others_;
};

}  // namespace theatron
