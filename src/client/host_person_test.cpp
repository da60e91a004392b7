// SPDX-License-Identifier: Apache-2.0
#include "client/host_person.h"

#include <gtest/gtest.h>

#include "base/hex_text.h"

namespace theatron::client {
namespace {

net::Link identity_link(const std::string& host, char digit = '0') {
    return {host, 4400, "token", std::string(64, digit)};
}

Bytes person_secret() {
    Bytes secret;
    for (int i = 0; i < 16; ++i)
        secret.push_back(std::byte(i));
    return secret;
}

// The vectors of docs/formats/connection.md.
TEST(HostPerson, IsAnotherOneForEachHostAndTheSecretForNone) {
    const Bytes secret = person_secret();
    EXPECT_EQ(hex_text(person_for_host(secret, identity_link("or-3.example.org"))),
              "469ab961de7ca07a1459d9c603634a6c");
    EXPECT_EQ(hex_text(person_for_host(secret, identity_link("192.0.2.5"))),
              "5cbba8bf0a3ab91b1b76763dd4a99704");
    EXPECT_NE(person_for_host(secret, identity_link("192.0.2.5", '1')),
              person_for_host(secret, identity_link("192.0.2.5", '2')));
    EXPECT_TRUE(person_for_host({}, identity_link("192.0.2.5")).empty());
}

TEST(HostPerson, StaysWhenTheCertificateOfANameIsRenewed) {
    EXPECT_EQ(host_identity(identity_link("OR-3.Example.org", '1')), "name:or-3.example.org");
    EXPECT_EQ(host_identity(identity_link("or-3.example.org", '2')), "name:or-3.example.org");
}

TEST(HostPerson, AnAddressOrAnOwnNameIsNoIdentity) {
    for (const char* host : {"192.0.2.5", "::1", "2001:db8::1", "localhost", "or-3", "or-3.local",
                             "x.localhost", "or-3."})
        EXPECT_TRUE(host_identity(identity_link(host)).starts_with("certificate:")) << host;
}

}  // namespace
}  // namespace theatron::client
