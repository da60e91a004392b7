// SPDX-License-Identifier: Apache-2.0
#include "bench_targets.h"

#include <hwy/targets.h>
#include <strings.h>

#include "base/error.h"

namespace theatron::bench {

std::string known_targets() {
    std::string names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names += (names.empty() ? "" : ", ") + std::string(hwy::TargetName(target));
    return names;
}

std::string target_in_use() {
    const std::string names = known_targets();
    return names.substr(0, names.find(','));
}

void hold_to_target(const std::string& name) {
    // Highway numbers a better instruction set with a lower bit.
    std::int64_t held = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        if (held != 0 || strcasecmp(hwy::TargetName(target), name.c_str()) == 0)
            held |= target;
    if (held == 0)
        throw Error(std::string(targets_variable) + "=" + name + ": there is " + known_targets() +
                    " on this machine.");
    hwy::SetSupportedTargetsForTest(held);
}

}  // namespace theatron::bench
