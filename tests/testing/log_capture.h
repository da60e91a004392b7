// SPDX-License-Identifier: Apache-2.0
// The lines that the log writes to standard error during a part of a test. The log writes them in a
// thread of its own, so the lines from earlier are waited for at the begin, and the test's own at
// the end.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "base/log.h"

namespace theatron::testing {

// One at a time.
class LogCapture {
public:
    LogCapture() {
        log::flush(patience);
        ::testing::internal::CaptureStderr();
    }
    LogCapture(const LogCapture&) = delete;
    LogCapture& operator=(const LogCapture&) = delete;

    // Once, and before this capture is destroyed.
    std::string end() {
        log::flush(patience);
        return ::testing::internal::GetCapturedStderr();
    }

private:
    static constexpr std::chrono::minutes patience{1};
};

}  // namespace theatron::testing
