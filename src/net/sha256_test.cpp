// SPDX-License-Identifier: Apache-2.0
#include "net/sha256.h"

#include <gtest/gtest.h>

#include "net/content_digest.h"

namespace theatron::net {
namespace {

TEST(Sha256, IsThatOfTheLibraryForAllLengthsAndPieces) {
    Bytes content;
    for (int i = 0; i < 300; ++i)
        content.push_back(std::byte(i * 37 + 11));
    for (std::size_t size = 0; size <= content.size(); ++size) {
        const ByteView bytes = ByteView(content).first(size);
        for (const std::size_t piece : {std::size_t(1), std::size_t(63), std::size_t(200)}) {
            Sha256 digest;
            for (std::size_t at = 0; at < size; at += piece)
                digest.add(bytes.subspan(at, std::min(piece, size - at)));
            EXPECT_EQ(digest.finish(), content_hash(bytes)) << size << " in pieces of " << piece;
        }
    }
}

}  // namespace
}  // namespace theatron::net
