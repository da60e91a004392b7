// SPDX-License-Identifier: Apache-2.0
#include "client/recorded_numbers.h"

#include <gtest/gtest.h>

#include "wire/control.h"

namespace theatron::client {
namespace {

TEST(RecordedNumbers, CountFromZeroAndStayWhileTheCameraDoes) {
    RecordedNumbers numbers;
    numbers.set_cameras({CameraId{7}, CameraId{9}});
    EXPECT_EQ(numbers.of(CameraId{7}), CameraId{0});
    EXPECT_EQ(numbers.of(CameraId{9}), CameraId{1});
    numbers.set_cameras({CameraId{9}, CameraId{12}});
    EXPECT_EQ(numbers.of(CameraId{7}), std::nullopt);
    EXPECT_EQ(numbers.of(CameraId{9}), CameraId{1});
    EXPECT_EQ(numbers.of(CameraId{12}), CameraId{2}) << "free numbers are given again last";
}

TEST(RecordedNumbers, AreGivenAgainWhenAllWereUsed) {
    RecordedNumbers numbers;
    for (std::size_t i = 0; i < wire::max_cameras; ++i)
        numbers.set_cameras({CameraId(i)});
    numbers.set_cameras({CameraId{200}});
    EXPECT_EQ(numbers.of(CameraId{200}), CameraId{0});
}

}  // namespace
}  // namespace theatron::client
