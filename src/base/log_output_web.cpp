// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "base/log.h"
#include "base/log_output.h"

namespace theatron::log {

void output_line(std::string line) {
    std::fwrite(line.data(), 1, line.size(), stderr);
}

void flush(Duration) {}
void flush_before_abort() {}

}  // namespace theatron::log
