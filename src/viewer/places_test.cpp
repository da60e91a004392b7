// SPDX-License-Identifier: Apache-2.0
#include "viewer/places.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(Places, PeopleWhoComeToSomebodyStandBesideEachOther) {
    const Pose host{Quat{1, 0, 0, 0}, {1, 1.6, -2}};
    std::vector<Vec3> heads;
    for (int guest = 0; guest < 6; ++guest) {
        const Vec3 place = beside(host, heads).translation;
        EXPECT_NEAR(place.y, 1.6, 1e-9);
        EXPECT_NEAR(place.z, -2, 1e-9) << "in a row";
        EXPECT_LT(length(place - host.translation), 2);
        EXPECT_GT(length(place - host.translation), 0.5);
        for (const Vec3& head : heads)
            EXPECT_GT(length(place - head), 0.5) << guest;
        heads.push_back(place);
    }
    EXPECT_NEAR(heads.front().x, 1.6, 1e-9) << "the first on the right";
}

}  // namespace
}  // namespace theatron::viewer
