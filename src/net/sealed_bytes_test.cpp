// SPDX-License-Identifier: Apache-2.0
#include "net/sealed_bytes.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

constexpr std::string_view passphrase = "correct horse";

Bytes some_content() {
    Bytes content;
    for (int i = 0; i < 1000; ++i)
        content.push_back(std::byte(i % 251));
    return content;
}

TEST(SealedBytes, OpenWithThePassphraseAlone) {
    const Bytes content = some_content();
    const Sealed sealed = seal(content, passphrase, least_seal_cost);
    EXPECT_EQ(unseal(sealed, passphrase), content);
    EXPECT_FALSE(unseal(sealed, "correct horse "));
    EXPECT_FALSE(unseal(sealed, ""));
    // Two files of the same content do not look alike.
    const Sealed again = seal(content, passphrase, least_seal_cost);
    EXPECT_NE(sealed.salt, again.salt);
    EXPECT_NE(sealed.content, again.content);
    EXPECT_EQ(unseal(seal({}, passphrase, least_seal_cost), passphrase), Bytes());
}

TEST(SealedBytes, NoByteCanBeChangedUnseen) {
    const Bytes whole = sealed_bytes(seal(some_content(), passphrase, least_seal_cost));
    for (const std::size_t at :
         {std::size_t(8), std::size_t(24), std::size_t(40), std::size_t(60), whole.size() - 1}) {
        Bytes changed = whole;
        changed[at] ^= std::byte(1);
        const auto sealed = parse_sealed(changed);
        ASSERT_TRUE(sealed) << at;
        EXPECT_FALSE(unseal(*sealed, passphrase)) << at;
    }
    Bytes dearer = whole;
    dearer[7] = std::byte(least_seal_cost + 1);
    EXPECT_FALSE(unseal(*parse_sealed(dearer), passphrase));
}

TEST(SealedBytes, DamagedFilesAreRefusedBeforeAnyWork) {
    const Bytes whole = sealed_bytes(seal(some_content(), passphrase, least_seal_cost));
    for (std::size_t n = 0; n < 52; ++n)
        EXPECT_EQ(parse_sealed(ByteView(whole).first(n)).error(),
                  n < 6 ? Status::malformed : Status::truncated);
    Bytes changed = whole;
    changed[6] = std::byte(2);
    EXPECT_EQ(parse_sealed(changed).error(), Status::unsupported_version);
    changed = whole;
    changed[7] = std::byte(most_seal_cost + 1);  // memory for a guess
    EXPECT_EQ(parse_sealed(changed).error(), Status::too_large);
    changed[7] = std::byte(least_seal_cost - 1);
    EXPECT_EQ(parse_sealed(changed).error(), Status::malformed);
}

}  // namespace
}  // namespace theatron::net
