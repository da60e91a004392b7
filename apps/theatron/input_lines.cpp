// SPDX-License-Identifier: Apache-2.0
#include "input_lines.h"

#include <poll.h>
#include <unistd.h>

namespace theatron::app {

std::optional<std::string> InputLines::next() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (typed_.find('\n') == std::string::npos) {
        // In the background reading would stop the program.
        const bool ours = !isatty(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) == getpgrp();
        if (ended_ || !ours || poll(&input, 1, 0) <= 0)
            return std::nullopt;
        char bytes[512];
        const ssize_t count = read(STDIN_FILENO, bytes, sizeof(bytes));
        if (count <= 0) {
            ended_ = true;
            closed_by_person_ = isatty(STDIN_FILENO);
            return std::nullopt;
        }
        typed_.append(bytes, std::size_t(count));
    }
    const auto end = typed_.find('\n');
    std::string line = typed_.substr(0, end);
    typed_.erase(0, end + 1);
    return line;
}

}  // namespace theatron::app
