// SPDX-License-Identifier: Apache-2.0
// Whole lines from standard input, without waiting for any. However much is written there, the
// program goes on: lines are bounded in length, and in number for each turn of its main loop.
#pragma once

#include <string>
#include <vector>

namespace theatron::app {

// Takes lines out of bytes that come in parts.
class LineSplitter {
public:
    // Longer lines are left out.
    static constexpr std::size_t max_line_bytes = 4096;

    // Adds the lines that end in `bytes` to `lines`.
    void take(std::string_view bytes, std::vector<std::string>& lines);
    // How many lines were too long since the last call.
    std::size_t take_too_long();

private:
    std::string begun_;
    bool is_too_long_ = false;  // the line that has begun
    std::size_t too_long_ = 0;
};

class InputLines {
public:
    // Lines of one call.
    static constexpr std::size_t max_lines = 100;
    // Bytes that are read in one call.
    static constexpr std::size_t max_read_bytes = std::size_t(64) << 10;

    // The lines that were typed since the last call; further ones wait for the next call. Says that
    // a line is too long.
    std::vector<std::string> take();

    // A person has closed the terminal's input. Other input may simply end.
    bool closed_by_person() const { return closed_by_person_; }

private:
    void read();

    LineSplitter splitter_;
    std::vector<std::string> waiting_;
    bool ended_ = false;
    bool closed_by_person_ = false;
};

}  // namespace theatron::app
