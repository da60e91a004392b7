// SPDX-License-Identifier: Apache-2.0
#include "record/crc32c.h"

#include <gtest/gtest.h>

#include <random>

namespace theatron::record {
namespace {

TEST(Crc32c, GivesTheKnownValues) {
    EXPECT_EQ(crc32c({}), 0u);
    EXPECT_EQ(crc32c(as_bytes("123456789")), 0xe3069283u);
    EXPECT_EQ(crc32c(Bytes(32)), 0x8a9136aau);  // RFC 3720, B.4
}

TEST(Crc32c, EqualsItsDefinitionForEveryLengthAndPlace) {
    std::minstd_rand random(1);
    Bytes bytes(300);
    for (std::byte& b : bytes)
        b = std::byte(random() >> 16);
    for (std::size_t begin = 0; begin < 9; ++begin)
        for (std::size_t size = 0; begin + size <= bytes.size(); ++size) {
            const ByteView part = ByteView(bytes).subspan(begin, size);
            ASSERT_EQ(crc32c(part), crc32c_reference(part)) << begin << " " << size;
        }
}

TEST(Crc32c, OfPartsIsThatOfTheWhole) {
    const Bytes bytes(77, std::byte{0x5a});
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut)
        EXPECT_EQ(crc32c(ByteView(bytes).subspan(cut), crc32c(ByteView(bytes).first(cut))),
                  crc32c(bytes));
}

}  // namespace
}  // namespace theatron::record
