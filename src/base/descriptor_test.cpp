// SPDX-License-Identifier: Apache-2.0
#include "base/descriptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>

namespace theatron {
namespace {

bool is_open_in_system(int number) {
    return fcntl(number, F_GETFD) != -1;
}

TEST(Descriptor, ClosesWhatItOwns) {
    int number = -1;
    {
        const Descriptor file(open("/dev/null", O_RDONLY | O_CLOEXEC));
        ASSERT_TRUE(file.is_open());
        number = file.get();
        EXPECT_TRUE(is_open_in_system(number));
    }
    EXPECT_FALSE(is_open_in_system(number));
}

TEST(Descriptor, WhatWasMovedOrReleasedStaysOpen) {
    Descriptor first(open("/dev/null", O_RDONLY | O_CLOEXEC));
    const int number = first.get();
    Descriptor second(std::move(first));
    EXPECT_EQ(second.get(), number);
    const int released = second.release();
    EXPECT_FALSE(second.is_open());
    EXPECT_TRUE(is_open_in_system(released));
    EXPECT_TRUE(Descriptor(released).close());
    EXPECT_FALSE(is_open_in_system(released));
}

TEST(Descriptor, NoneIsClosedWithoutAnError) {
    EXPECT_TRUE(Descriptor(-1).close());
}

}  // namespace
}  // namespace theatron
