// SPDX-License-Identifier: Apache-2.0
// Facts of people who come by one link, of a bounded number of them: beyond that the one is
// forgotten who was here longest ago. Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::session {

template <class Facts>
class RememberedPeople {
public:
    explicit RememberedPeople(std::size_t most) : most_(most) {}

    struct Remembered {
        Facts facts;
        TimePoint seen;
    };
    // `person`: as in wire::Join. Null if it was never here, or is forgotten.
    Remembered* find(const Bytes& person) {
        const auto found = people_.find(person);
        return found == people_.end() ? nullptr : &found->second;
    }
    // The person is here.
    Facts& note(const Bytes& person, TimePoint now) {
        if (people_.size() >= most_ && !people_.contains(person))
            people_.erase(std::min_element(
                people_.begin(), people_.end(),
                [](const auto& a, const auto& b) { return a.second.seen < b.second.seen; }));
        Remembered& noted = people_[person];
        noted.seen = std::max(noted.seen, now);
        return noted.facts;
    }

private:
    std::size_t most_;
    std::map<Bytes, Remembered> people_;
};

}  // namespace theatron::session
