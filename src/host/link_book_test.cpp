// SPDX-License-Identifier: Apache-2.0
#include "host/link_book.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "base/error.h"
#include "files/private_file.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::HasSubstr;
using wire::Role;

class LinkBook : public ::testing::Test {
protected:
    std::optional<KnownLink> find(const std::string& name) const {
        for (const KnownLink& link : load_links(folder.path()).links)
            if (link.name == name)
                return link;
        return std::nullopt;
    }
    testing::TemporaryFolder folder;
};

TEST_F(LinkBook, HasOneLinkOfEachRoleThatStays) {
    const auto first = load_links(folder.path()).links, again = load_links(folder.path()).links;
    ASSERT_EQ(first.size(), 4u);
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].name, wire::text_of(wire::roles[i]));
        EXPECT_EQ(first[i].token, again[i].token);
        EXPECT_FALSE(first[i].expires);
    }
}

TEST_F(LinkBook, KeepsWhatALinkAllowsAndForWhomItIs) {
    const KnownLink made = make_link(folder.path(), Role::observer, 1'795'378'500, "Dr. Ada\n x");
    const auto read = find(made.name);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->role, Role::observer);
    EXPECT_EQ(read->token, made.token);
    EXPECT_EQ(read->expires, 1'795'378'500);
    EXPECT_EQ(read->label, "Dr. Ada  x");
    EXPECT_FALSE(read->has_expired(1'795'378'499));
    EXPECT_TRUE(read->has_expired(1'795'378'500));
    struct stat info {};
    ASSERT_EQ(stat((folder.path() / "links" / made.name).c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);
}

TEST_F(LinkBook, RevokesALinkForGoodAndGivesARoleAnotherToken) {
    const KnownLink made = make_link(folder.path(), Role::expert, std::nullopt, "");
    const std::string before = find("operator")->token;
    EXPECT_TRUE(revoke_link(folder.path(), made.name));
    EXPECT_FALSE(find(made.name));
    EXPECT_FALSE(revoke_link(folder.path(), made.name));
    EXPECT_FALSE(revoke_link(folder.path(), "../join.token"));
    EXPECT_TRUE(revoke_link(folder.path(), "operator"));
    EXPECT_NE(find("operator")->token, before);
}

TEST_F(LinkBook, FilesDifferAfterEachChange) {
    make_role_links(folder.path());
    LinkFiles seen = look_at_links(folder.path());
    const auto is_other = [&] { return std::exchange(seen, look_at_links(folder.path())) != seen; };
    EXPECT_FALSE(is_other());
    const KnownLink made = make_link(folder.path(), Role::expert, std::nullopt, "");
    EXPECT_TRUE(is_other());
    const auto file = folder.path() / "links" / made.name;
    ASSERT_EQ(chmod(file.c_str(), 0644), 0);
    EXPECT_TRUE(is_other()) << "others may read it";
    std::ofstream(file) << "expert - 0123456789abcdef0123\n";
    EXPECT_TRUE(is_other());
    (void)revoke_link(folder.path(), made.name);
    EXPECT_TRUE(is_other());
    (void)revoke_link(folder.path(), "observer");
    EXPECT_TRUE(is_other());
    EXPECT_FALSE(is_other());
}

TEST_F(LinkBook, AHostSaysWhichFilesItFollows) {
    make_role_links(folder.path());
    EXPECT_FALSE(are_links_followed(folder.path()));
    tell_links_followed(folder.path(), look_at_links(folder.path()));
    EXPECT_TRUE(are_links_followed(folder.path()));
    (void)revoke_link(folder.path(), "expert");
    EXPECT_FALSE(are_links_followed(folder.path()));
}

TEST_F(LinkBook, ALinkOfARoleThatCannotBeReadIsNoTroubleForOthers) {
    make_role_links(folder.path());
    const KnownLink made = make_link(folder.path(), Role::expert, std::nullopt, "");
    ASSERT_EQ(chmod((folder.path() / "observer.token").c_str(), 0644), 0);
    EXPECT_THROW(make_role_links(folder.path()), Error);
    const KnownLinks known = load_links(folder.path());
    ASSERT_EQ(known.problems.size(), 1u);
    EXPECT_THAT(known.problems[0], HasSubstr("observer.token"));
    EXPECT_FALSE(find("observer"));
    EXPECT_TRUE(find("operator") && find(made.name));
}

TEST_F(LinkBook, MoreFilesThanLinksAreToldAndTheOthersAreJudged) {
    (void)make_link(folder.path(), Role::expert, std::nullopt, "");
    const auto links = folder.path() / "links";
    for (std::size_t i = 0; i < max_made_links + 3; ++i) {
        char name[16];
        std::snprintf(name, sizeof(name), "%08zx", i);
        files::write_private_file(links / name, "observer - 0123456789abcdef0123\n");
    }
    const KnownLinks known = load_links(folder.path());
    ASSERT_EQ(known.problems.size(), 1u);
    EXPECT_THAT(known.problems[0], HasSubstr("more than 256 links"));
    EXPECT_EQ(known.links.size(), 4 + max_made_links);
    EXPECT_TRUE(find("00000000"));
    EXPECT_TRUE(revoke_link(folder.path(), "00000000"));
    EXPECT_FALSE(find("00000000"));
}

TEST_F(LinkBook, ARevocationThatFailsIsNoRevocation) {
    make_role_links(folder.path());
    const auto in_the_way = folder.path() / "links" / "0badcafe";
    std::filesystem::create_directories(in_the_way / "something");
    EXPECT_THROW((void)revoke_link(folder.path(), "0badcafe"), Error);
    std::filesystem::create_directories(folder.path() / "observer.token.part" / "something");
    EXPECT_THROW((void)revoke_link(folder.path(), "observer"), Error);
}

TEST_F(LinkBook, NamesFilesThatAreNoLinksAndKeepsTheOthers) {
    const KnownLink made = make_link(folder.path(), Role::expert, std::nullopt, "");
    const auto links = folder.path() / "links";
    files::write_private_file(links / "0badcafe", "expert tomorrow 0123456789abcdef0123\n");
    const auto others_may_read = links / "0badbeef";
    files::write_private_file(others_may_read, "expert - 0123456789abcdef0123\n");
    ASSERT_EQ(chmod(others_may_read.c_str(), 0644), 0);
    const KnownLinks known = load_links(folder.path());
    ASSERT_EQ(known.problems.size(), 2u);
    EXPECT_THAT(known.problems[0] + known.problems[1],
                AllOf(HasSubstr("0badcafe"), HasSubstr("0badbeef")));
    EXPECT_TRUE(find(made.name));
    EXPECT_FALSE(find("0badcafe") || find("0badbeef"));
    std::filesystem::remove(others_may_read);
    std::filesystem::rename(links / "0badcafe", links / "0badcafe.part");
    EXPECT_TRUE(load_links(folder.path()).problems.empty()) << "a draft of another program";
}

TEST_F(LinkBook, MakesRoomForNewLinksByDeletingExpiredOnes) {
    for (std::size_t i = 0; i < max_made_links; ++i)
        (void)make_link(folder.path(), Role::expert,
                        i < 2 ? std::optional(files::UtcSeconds(1)) : std::nullopt, "");
    (void)make_link(folder.path(), Role::expert, std::nullopt, "");
    (void)make_link(folder.path(), Role::expert, std::nullopt, "");
    EXPECT_THROW((void)make_link(folder.path(), Role::expert, std::nullopt, ""), Error);
}

}  // namespace
}  // namespace theatron::host
