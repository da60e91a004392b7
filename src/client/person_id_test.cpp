// SPDX-License-Identifier: Apache-2.0
#include "client/person_id.h"

#include <gtest/gtest.h>

#include <fstream>

#include "testing/temporary_folder.h"

namespace theatron::client {
namespace {

TEST(PersonId, IsKeptAndOnesOwn) {
    const testing::TemporaryFolder home, other;
    const Bytes id = load_or_make_person_id(home.path() / "theatron");
    EXPECT_EQ(id.size(), 16u);
    EXPECT_EQ(load_or_make_person_id(home.path() / "theatron"), id);
    EXPECT_NE(load_or_make_person_id(other.path()), id);
    EXPECT_EQ(std::filesystem::status(home.path() / "theatron/person.id").permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(PersonId, WhereItCannotBeKeptThereIsOneForTheRun) {
    const Bytes first = load_or_make_person_id({});
    EXPECT_EQ(first.size(), 16u);
    EXPECT_NE(load_or_make_person_id({}), first);
    const testing::TemporaryFolder folder;
    {
        std::ofstream out(folder.path() / "person.id");
        out << "not an id";
    }
    std::filesystem::permissions(folder.path() / "person.id", std::filesystem::perms(0600));
    EXPECT_EQ(load_or_make_person_id(folder.path()).size(), 16u);
}

}  // namespace
}  // namespace theatron::client
