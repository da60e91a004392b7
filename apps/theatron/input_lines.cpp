// SPDX-License-Identifier: Apache-2.0
#include "input_lines.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/log.h"

namespace theatron::app {

void LineSplitter::take(std::string_view bytes, std::vector<std::string>& lines) {
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        if (begun_.size() + end > max_line_bytes) {
            too_long_ += !std::exchange(is_too_long_, true);
            begun_.clear();
        }
        if (!is_too_long_)
            begun_ += bytes.substr(0, end);
        if (end == bytes.size())
            return;
        if (!std::exchange(is_too_long_, false))
            lines.push_back(std::move(begun_));
        begun_.clear();
        bytes.remove_prefix(end + 1);
    }
}

std::size_t LineSplitter::take_too_long() {
    return std::exchange(too_long_, 0);
}

void InputLines::read() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    for (std::size_t taken = 0; taken < max_read_bytes && waiting_.size() < max_lines;) {
        // In the background reading would stop the program.
        const bool ours = !isatty(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) == getpgrp();
        if (ended_ || !ours || poll(&input, 1, 0) <= 0)
            return;
        char bytes[4096];
        const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof(bytes));
        if (count <= 0) {
            ended_ = true;
            closed_by_person_ = isatty(STDIN_FILENO);
            return;
        }
        splitter_.take({bytes, std::size_t(count)}, waiting_);
        taken += std::size_t(count);
    }
}

std::vector<std::string> InputLines::take() {
    read();
    if (const std::size_t left_out = splitter_.take_too_long(); left_out > 0)
        log::say("A line of standard input is longer than " +
                 std::to_string(LineSplitter::max_line_bytes) + " bytes and is not obeyed" +
                 (left_out > 1 ? ", and " + std::to_string(left_out - 1) + " more." : "."));
    const auto end =
        waiting_.begin() + std::ptrdiff_t(std::min(waiting_.size(), std::size_t(max_lines)));
    std::vector<std::string> lines(std::make_move_iterator(waiting_.begin()),
                                   std::make_move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    return lines;
}

}  // namespace theatron::app
