// SPDX-License-Identifier: Apache-2.0
#include "base/line_limit.h"

#include <algorithm>
#include <utility>

namespace theatron {

std::optional<std::uint64_t> LineLimit::take(const std::string& source, TimePoint now) {
    Source* entry = &others_;
    if (const auto found = sources_.find(source); found != sources_.end()) {
        entry = &found->second;
    } else {
        if (sources_.size() >= max_sources)
            std::erase_if(sources_, [&](const auto& s) { return s.second.next <= now; });
        if (sources_.size() < max_sources)
            entry = &sources_[source];
    }
    if (now + (at_once_ - 1) * interval < entry->next) {
        ++entry->left_out;
        return std::nullopt;
    }
    entry->next = std::max(entry->next, now) + interval;
    return std::exchange(entry->left_out, 0);
}

}  // namespace theatron
