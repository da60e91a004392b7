// SPDX-License-Identifier: Apache-2.0
#include "base/shown_address.h"

#include <gtest/gtest.h>

#include "base/options.h"

namespace theatron {
namespace {

TEST(ShownAddress, HasNoSecretInIt) {
    EXPECT_EQ(shown_address("rtsp://tower.local/live"), "rtsp://tower.local/live");
    EXPECT_EQ(shown_address("rtsp://tower.local:554"), "rtsp://tower.local:554");
    EXPECT_EQ(shown_address("folder:/a/b?c=d"), "folder:/a/b?c=d") << "no address";
    const std::string secret = "pass" + std::string("word9");
    for (const char* form :
         {"rtsp://cart:*@tower/live", "rtsp://*@tower/live", "rtsp://a:b@*@tower/live",
          "rtsp://a:x/*@tower/live", "rtsp://tower/live?user=a&password=*", "rtsp://tower?p=*",
          "rtsp://tower/live?*", "rtsp://tower/live#*", "rtsp://tower/user=a&password=*&channel=1",
          "rtsp://tower/a/pw=*/b", "rtsp://tower/live;key=*", "rtsp://[::1]:554/x?p=*",
          "rtsp://tower/live?user=a,password=*", "rtsp://tower/live?a,b=1,*"}) {
        std::string text = form;
        text.replace(text.find('*'), 1, secret);
        const std::string shown = shown_address(text);
        EXPECT_EQ(shown.find(secret), shown.npos) << shown;
        EXPECT_TRUE(shown.starts_with("rtsp://"));
        // Nor do sentences about the options of such a camera.
        for (const char* options : {"", ",width=wide", ",width=1,width=2", ",colour=1", ",x"}) {
            Options parsed = Options::parse(text + options);
            parsed.take_number("width", 1, 0, 10);
            EXPECT_EQ(parsed.problem().find(secret), std::string::npos) << parsed.problem();
            EXPECT_EQ(parsed.text().find(secret), std::string::npos) << parsed.text();
        }
    }
    EXPECT_EQ(shown_address("rtsp://cart:x@tower/live?p=1"), "rtsp://tower/live...");
}

}  // namespace
}  // namespace theatron
