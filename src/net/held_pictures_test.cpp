// SPDX-License-Identifier: Apache-2.0
#include "net/held_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::net {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t quarter = max_held_bytes / 4;

TEST(HeldPictures, WithinTheBoundAllStay) {
    const std::vector<HeldPictures> peers(4, {quarter, 29s});
    EXPECT_THAT(must_go(peers), IsEmpty());
}

TEST(HeldPictures, TheOnesThatStoodStillLongestGo) {
    const std::vector<HeldPictures> peers = {
        {quarter, 3s}, {2 * quarter, 9s}, {quarter, 5s}, {2 * quarter, 4s}};
    EXPECT_THAT(must_go(peers), ElementsAre(1));
    const std::vector<HeldPictures> more = {{quarter, 3s}, {quarter, 9s}, {4 * quarter, 5s}};
    EXPECT_THAT(must_go(more), ElementsAre(1, 2));
}

TEST(HeldPictures, APeerThatTakesSomethingStays) {
    const std::vector<HeldPictures> peers = {{9 * quarter, 1999ms}, {1, 2s}, {0, 20s}};
    EXPECT_THAT(must_go(peers), ElementsAre(1));
}

TEST(HeldPictures, RecordersGoLast) {
    const std::vector<HeldPictures> peers = {
        {quarter, 25s, true}, {4 * quarter, 3s}, {4 * quarter, 2s}};
    EXPECT_THAT(must_go(peers), ElementsAre(1, 2));
    const std::vector<HeldPictures> alone = {{5 * quarter, 25s, true}, {quarter, 1s}};
    EXPECT_THAT(must_go(alone), ElementsAre(0));
}

}  // namespace
}  // namespace theatron::net
