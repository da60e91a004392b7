// SPDX-License-Identifier: Apache-2.0
#include "licences.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace theatron::app {
namespace {

TEST(Licences, NameThisProgramsAndEachPackageThatItContains) {
    EXPECT_TRUE(licences().starts_with("Theatron, copyright"));
    for (const char* package : {"libimgui-dev", "libcli11-dev", "nlohmann-json3-dev",
                                "libeigen3-dev", "libhwy-dev", "fonts-dejavu-core"}) {
        EXPECT_NE(licences().find("== " + std::string(package)), std::string_view::npos) << package;
        std::ifstream file("/usr/share/doc/" + std::string(package) + "/copyright");
        std::stringstream text;
        if (file && text << file.rdbuf())
            EXPECT_NE(licences().find(text.str()), std::string_view::npos) << package;
    }
}

}  // namespace
}  // namespace theatron::app
