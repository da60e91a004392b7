// SPDX-License-Identifier: Apache-2.0
#include "cli/instruction_set.h"

#include <hwy/targets.h>
#include <strings.h>

#include <cstdlib>

#include "base/error.h"
#include "base/output.h"

namespace theatron::cli {

std::string known_instruction_sets() {
    std::string names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names += (names.empty() ? "" : ", ") + std::string(hwy::TargetName(target));
    return names;
}

std::string instruction_set_in_use() {
    const std::string names = known_instruction_sets();
    return names.substr(0, names.find(','));
}

void hold_to_instruction_set() {
    const char* const name = std::getenv(instruction_set_variable);
    if (name == nullptr || *name == '\0')
        return;
    // Highway numbers a better instruction set with a lower bit.
    std::int64_t held = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        if (held != 0 || strcasecmp(hwy::TargetName(target), name) == 0)
            held |= target;
    if (held == 0)
        throw Error(std::string(instruction_set_variable) + "=" + name + ": there is " +
                    known_instruction_sets() + " on this machine.");
    hwy::SetSupportedTargetsForTest(held);
    output::print("theatron: the kernels use no better instruction set than " +
                      instruction_set_in_use() + ".\n",
                  output::Stream::error);
}

}  // namespace theatron::cli
