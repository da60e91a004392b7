// SPDX-License-Identifier: Apache-2.0
#include "input_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace theatron::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LineSplitter, GivesWholeLinesWhereverTheyAreParted) {
    LineSplitter splitter;
    std::vector<std::string> lines;
    splitter.take("one\ntw", lines);
    EXPECT_THAT(lines, ElementsAre("one"));
    splitter.take("o\n\nthree", lines);
    EXPECT_THAT(lines, ElementsAre("one", "two", ""));
}

TEST(LineSplitter, LeavesOutLinesThatAreTooLongAndCountsThem) {
    LineSplitter splitter;
    std::vector<std::string> lines;
    const std::string longest(LineSplitter::max_line_bytes, 'x');
    for (int i = 0; i < 100; ++i)
        splitter.take(longest, lines);
    EXPECT_EQ(splitter.take_too_long(), 1u);
    splitter.take("the rest of it\nnext\n" + longest + "y\n" + longest + "\n", lines);
    EXPECT_THAT(lines, ElementsAre("next", longest));
    EXPECT_EQ(splitter.take_too_long(), 1u);
    EXPECT_EQ(splitter.take_too_long(), 0u);
}

// Standard input is a pipe meanwhile.
class Input : public ::testing::Test {
protected:
    Input() : kept_(dup(STDIN_FILENO)) {
        int ends[2];
        EXPECT_EQ(pipe(ends), 0);
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        to_ = ends[1];
    }
    ~Input() override {
        if (to_ >= 0)
            close(to_);
        dup2(kept_, STDIN_FILENO);
        close(kept_);
    }
    void write(const std::string& text) {
        ASSERT_EQ(::write(to_, text.data(), text.size()), ssize_t(text.size()));
    }
    int to_ = -1;
    InputLines input;

private:
    int kept_;
};

TEST_F(Input, AFloodOfLinesIsTakenInTurnsAndNoneIsLost) {
    const std::size_t all = 10 * InputLines::max_lines + 7;
    for (std::size_t i = 0; i < all; ++i)
        write(std::to_string(i) + "\n");
    std::size_t came = 0;
    for (int turn = 0; turn < 11; ++turn) {
        const auto lines = input.take();
        ASSERT_LE(lines.size(), InputLines::max_lines);
        for (const std::string& line : lines)
            ASSERT_EQ(line, std::to_string(came++));
    }
    EXPECT_EQ(came, all);
    EXPECT_THAT(input.take(), IsEmpty());
}

TEST_F(Input, AFloodWithoutEndIsReadInTurns) {
    std::thread writer([this] {
        const std::string part(64 << 10, 'x');
        for (int i = 0; i < 32; ++i)
            (void)!::write(to_, part.data(), part.size());
        (void)!::write(to_, "\nlast\n", 6);
        close(std::exchange(to_, -1));
    });
    std::vector<std::string> lines;
    std::size_t turns = 0;
    while (lines.empty()) {
        lines = input.take();
        ++turns;
    }
    writer.join();
    EXPECT_THAT(lines, ElementsAre("last"));
    EXPECT_GE(turns, (std::size_t(32 * 64) << 10) / InputLines::max_read_bytes);
    EXPECT_FALSE(input.closed_by_person());
}

}  // namespace
}  // namespace theatron::app
