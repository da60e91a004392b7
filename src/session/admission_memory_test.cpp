// SPDX-License-Identifier: Apache-2.0
#include "session/admission_memory.h"

#include <gtest/gtest.h>

namespace theatron::session {
namespace {

using Who = AdmissionMemory::Who;

constexpr TimePoint start = from_us(1'000'000'000);

Bytes person(int number) {
    Bytes id(16, std::byte(number));
    id[0] = std::byte(number >> 8);
    return id;
}

TEST(AdmissionMemory, SomebodyIsKnownForTenMinutesByPersonLinkAndPurpose) {
    AdmissionMemory memory;
    const Who ann{person(1), "a", false};
    EXPECT_EQ(memory.find(ann, start), nullptr);
    memory.note({ann, start, start + 5s});
    ASSERT_NE(memory.find(ann, start + 605s), nullptr);
    EXPECT_EQ(memory.find(ann, start + 605s)->since, start);
    EXPECT_EQ(memory.find(ann, start + 606s), nullptr);
    EXPECT_EQ(memory.find({person(2), "a", false}, start + 6s), nullptr);
    EXPECT_EQ(memory.find({person(1), "b", false}, start + 6s), nullptr);
    EXPECT_EQ(memory.find({person(1), "a", true}, start + 6s), nullptr);
    memory.forget_all();
    EXPECT_EQ(memory.find(ann, start + 6s), nullptr);
}

TEST(AdmissionMemory, SomebodyWithoutAnIdIsNotRemembered) {
    AdmissionMemory memory;
    memory.note({{{}, "a", false}, start, start});
    EXPECT_EQ(memory.find({{}, "a", false}, start), nullptr);
}

TEST(AdmissionMemory, ManyWhoComeAndGoDoNotHideOneWhoStayed) {
    AdmissionMemory memory;
    const Who stayed{person(0), "a", true};
    memory.note({stayed, start - 60s, start});
    for (int i = 1; i <= 5000; ++i)
        memory.note({{person(i), "a", false}, start, start + 1s});
    EXPECT_NE(memory.find(stayed, start + 2s), nullptr);
    const Who other{person(0), "b", false};
    memory.note({other, start, start + 2s});
    int known = 0;
    for (int i = 1; i <= 5000; ++i)
        known += memory.find({person(i), "a", false}, start + 2s) != nullptr;
    EXPECT_EQ(known, int(AdmissionMemory::max_kept_of_one_link) - 1);
    for (int link = 0; link < 10; ++link)
        for (int i = 1; i <= 100; ++i)
            memory.note(
                {{person(i), "link " + std::to_string(link), false}, start + 1s, start + 2s});
    EXPECT_NE(memory.find(stayed, start + 2s), nullptr);
    EXPECT_NE(memory.find(other, start + 2s), nullptr);
}

}  // namespace
}  // namespace theatron::session
