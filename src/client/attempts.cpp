// SPDX-License-Identifier: Apache-2.0
#include "client/attempts.h"

#include <algorithm>
#include <utility>

#include "wire/sentence.h"

namespace theatron::client {

Attempts::Judged Attempts::after(const End& end) {
    if (!end.refusal.empty()) {
        const bool again = was_in_ && !wire::is_for_good(end.refusal.code);
        return {again ? Next::again : Next::refused, wire::sentence(end.refusal), longest_wait};
    }
    if (end.final)
        return {Next::refused, end.why, {}};
    if (!end.goodbye.empty())
        return {Next::ended, wire::sentence(end.goodbye), {}};
    return {Next::again, end.why, std::exchange(wait_, std::min(2 * wait_, longest_wait))};
}

}  // namespace theatron::client
