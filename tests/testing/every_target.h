// SPDX-License-Identifier: Apache-2.0
// For tests of vector code: a loop over the instruction sets of this machine.
#pragma once

#include <gtest/gtest.h>

#include <hwy/targets.h>

namespace theatron::testing {

// Runs `test` once per instruction set of this machine.
template <class Test>
void on_every_target(Test test) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        SCOPED_TRACE(hwy::TargetName(target));
        test();
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace theatron::testing
