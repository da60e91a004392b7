// SPDX-License-Identifier: Apache-2.0
#include "session/audit_budget.h"

#include <gtest/gtest.h>

#include "wire/control.h"

namespace theatron::session {
namespace {

using std::chrono::seconds;

Bytes audited_person(int number) {
    Bytes id(wire::person_id_size);
    store_le(id.data(), std::uint32_t(number));
    return id;
}

class Lines : public ::testing::Test {
protected:
    int taken(const std::string& link, int number, int lines) {
        int count = 0;
        for (int i = 0; i < lines; ++i)
            count += budget.take(link, audited_person(number), now);
        return count;
    }
    AuditBudget budget;
    TimePoint now = from_us(1'000'000);
};

TEST_F(Lines, OfOnePersonAreLimitedAndThoseOfOthersAreNot) {
    EXPECT_EQ(taken("observer", 1, 5000), int(AuditBudget::of_person.at_once));
    EXPECT_EQ(taken("observer", 2, 3), 3);
    EXPECT_EQ(taken("expert", 1, 3), 3) << "by another link";
    now += seconds(60);
    EXPECT_EQ(taken("observer", 1, 5000), 60 * AuditBudget::of_person.per_second);
}

TEST_F(Lines, TheFirstOfAPersonComesHoweverManyCameBefore) {
    for (int i = 0; i < 3000; ++i)
        EXPECT_EQ(taken("observer", 100 + i, 1), 1);
    EXPECT_EQ(taken("observer", 1, 3), 1) << "the others of this link are used up";
    EXPECT_EQ(taken("expert", 2, 3), 3);
    now += seconds(2000);
    EXPECT_EQ(taken("observer", 1, 3), 3);
}

TEST_F(Lines, OfPeopleWithoutANumberCountAsThoseOfOne) {
    int count = 0;
    for (int i = 0; i < 1000; ++i)
        count += budget.take("observer", {}, now);
    EXPECT_EQ(count, int(AuditBudget::of_person.at_once));
}

TEST_F(Lines, OfStrangersAreFewAndTakeNoneFromThoseWhoHaveALink) {
    int count = 0;
    for (int i = 0; i < 5000; ++i)
        count += budget.take_of_stranger(now);
    EXPECT_EQ(count, int(AuditBudget::of_strangers.at_once));
    EXPECT_EQ(taken("", 1, 3), 3);
    now += seconds(100);
    EXPECT_TRUE(budget.take_of_stranger(now));
}

}  // namespace
}  // namespace theatron::session
