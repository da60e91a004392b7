// SPDX-License-Identifier: Apache-2.0
#include "certificate_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CertificatePlace, IsWhereTheConfigurationSays) {
    const CertificatePlace place =
        certificate_place("/etc/theatron/or-3.conf",
                          "certificate = /srv/a.pem\nkey = /srv/b.key\n"
                          "public-name = or-3.example:8443\nstate = /srv/state\n");
    EXPECT_EQ(place.certificate, "/srv/a.pem");
    EXPECT_EQ(place.key, "/srv/b.key");
    EXPECT_EQ(place.name, "or-3.example");
    EXPECT_EQ(place.state, "/srv/state");
    EXPECT_TRUE(place.is_named);
    EXPECT_THAT(place.missing_lines, IsEmpty());
}

TEST(CertificatePlace, IsBesideAConfigurationThatNamesNone) {
    const CertificatePlace place =
        certificate_place("/etc/theatron/or-3.conf", "key = relative.key\nnonsense\n");
    EXPECT_FALSE(place.is_named);
    EXPECT_THAT(place.missing_lines, ElementsAre("certificate = /etc/theatron/or-3.pem",
                                                 "key = /etc/theatron/or-3.key"));
}

}  // namespace
}  // namespace theatron::app
