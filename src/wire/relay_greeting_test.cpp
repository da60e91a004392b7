// SPDX-License-Identifier: Apache-2.0
#include "wire/relay_greeting.h"

#include <gtest/gtest.h>

#include "wire/control.h"

namespace theatron::wire {
namespace {

TEST(RelayGreeting, CarriesItsSecretAndNothingElse) {
    Bytes secret;
    for (std::size_t i = 0; i < relay_secret_size; ++i)
        secret.push_back(std::byte(i + 1));
    const Bytes greeting = encode_relay_greeting(secret);
    const auto read = read_relay_greeting(greeting);
    ASSERT_TRUE(read);
    EXPECT_EQ(Bytes(read->begin(), read->end()), secret);

    for (std::size_t size = 0; size < greeting.size(); ++size)
        EXPECT_FALSE(read_relay_greeting(ByteView(greeting).first(size))) << size;
    Bytes longer = greeting;
    longer.push_back({});
    EXPECT_FALSE(read_relay_greeting(longer));
    Bytes newer = greeting;
    newer[4] = std::byte{2};
    EXPECT_FALSE(read_relay_greeting(newer));
    EXPECT_FALSE(read_relay_greeting(encode(ToHost(Join{}))));
}

}  // namespace
}  // namespace theatron::wire
