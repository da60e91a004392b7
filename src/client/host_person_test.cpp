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
              "65cece16b86b369ba3a5857900784bf8");
    EXPECT_EQ(hex_text(person_for_host(secret, identity_link("192.0.2.5"))),
              "27bd9e81b6e6b00c7b0c47b0fcb5d3ac");
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
