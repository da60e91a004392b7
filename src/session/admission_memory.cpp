// SPDX-License-Identifier: Apache-2.0
#include "session/admission_memory.h"

#include <algorithm>

namespace theatron::session {

void AdmissionMemory::note(const Left& left) {
    if (left.who.person.empty())
        return;
    std::erase_if(left_, [&](const Left& known) {
        return known.who == left.who || left.until - known.until > kept_for;
    });
    left_.push_back(left);
    make_room(left.who.token);
}

void AdmissionMemory::make_room(const std::string& token) {
    const auto is_of_link = [&](const Left& known) { return known.who.token == token; };
    const bool link_is_full =
        std::size_t(std::count_if(left_.begin(), left_.end(), is_of_link)) > max_kept_of_one_link;
    if (!link_is_full && left_.size() <= max_kept)
        return;
    auto shortest = left_.end();
    for (auto known = left_.begin(); known != left_.end(); ++known)
        if ((!link_is_full || is_of_link(*known)) &&
            (shortest == left_.end() ||
             known->until - known->since < shortest->until - shortest->since))
            shortest = known;
    left_.erase(shortest);
}

const AdmissionMemory::Left* AdmissionMemory::find(const Who& who, TimePoint now) const {
    const auto found = std::find_if(left_.begin(), left_.end(), [&](const Left& known) {
        return known.who == who && now - known.until <= kept_for;
    });
    return who.person.empty() || found == left_.end() ? nullptr : &*found;
}

}  // namespace theatron::session
