// SPDX-License-Identifier: Apache-2.0
#include "qr_text.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/error.h"

namespace theatron::app {
namespace {

TEST(QrText, IsASquareOfModulesWithAQuietZone) {
    // 21 modules, 4 on each side, two rows in a line of characters of three bytes or one.
    std::istringstream lines(qr_text("HELLO", false));
    int rows = 0;
    for (std::string line; std::getline(lines, line); ++rows) {
        int columns = 0;
        for (const char c : line)
            columns += (c & 0xc0) != 0x80;
        EXPECT_EQ(columns, 29);
        if (rows < 2)
            EXPECT_EQ(line.find(' '), std::string::npos) << "the quiet zone is light";
    }
    EXPECT_EQ(rows, 15);
}

TEST(QrText, RefusesATextThatNoCodeHolds) {
    EXPECT_THROW((void)qr_text(std::string(4000, 'a'), false), Error);
}

}  // namespace
}  // namespace theatron::app
