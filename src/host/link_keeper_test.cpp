// SPDX-License-Identifier: Apache-2.0
#include "host/link_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using wire::Role;

class Links : public ::testing::Test {
protected:
    Links() { make_role_links(folder.path()); }
    // The keeper of a host that begins now.
    LinkKeeper keeper(std::string own_token = "") const {
        return LinkKeeper({folder.path(), std::move(own_token), {}});
    }
    std::string made(std::optional<files::UtcSeconds> expires = {}) const {
        return make_link(folder.path(), Role::expert, expires, "").name;
    }
    static const session::Admission::Token* find(
        const std::vector<session::Admission::Token>& tokens, const std::string& link) {
        const auto found = std::ranges::find(tokens, link, &session::Admission::Token::link);
        return found == tokens.end() ? nullptr : &*found;
    }
    static bool has(const LinkKeeper& links, const std::string& link) {
        return find(links.tokens(), link) != nullptr;
    }
    static std::string secret(const LinkKeeper& links, const std::string& link) {
        return find(links.tokens(), link)->secret;
    }
    fs::path file(const std::string& name) const { return folder.path() / name; }

    testing::TemporaryFolder folder;
    TimePoint now = from_us(1'000'000);
};

TEST_F(Links, FollowsFilesThatComeAndGo) {
    LinkKeeper links = keeper();
    EXPECT_FALSE(links.follow(now));
    const std::string link = made();
    EXPECT_TRUE(links.follow(now));
    EXPECT_TRUE(has(links, link));
    EXPECT_FALSE(links.follow(now));
    EXPECT_TRUE(revoke_link(folder.path(), link));
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, link));
    EXPECT_THAT(links.problem(), IsEmpty());
}

TEST_F(Links, KnowsTheMakerOfALinkAsLongAsThereIsOne) {
    LinkKeeper links = keeper();
    const KnownLink link = links.make(Role::observer, 4102444800, "Dr. Ada", "page of operator");
    EXPECT_TRUE(links.follow(now));
    EXPECT_EQ(secret(links, link.name), link.token);
    EXPECT_EQ(links.makers().at(link.name), "page of operator");
    const std::vector<KnownLink> known = links.links();
    EXPECT_EQ(std::ranges::find(known, link.name, &KnownLink::name)->label, "Dr. Ada");
    links.revoke(link.name, now);
    for (const KnownLink& left : links.links())
        EXPECT_NE(left.name, link.name);
    (void)made();
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(links.makers().contains(link.name));
}

TEST_F(Links, AnOwnTokenIsRevokedWithTheLinkOfExperts) {
    LinkKeeper links = keeper("correct-horse-battery");
    EXPECT_EQ(secret(links, "expert"), "correct-horse-battery");
    EXPECT_FALSE(links.follow(now));
    EXPECT_TRUE(revoke_link(folder.path(), "expert"));
    EXPECT_TRUE(links.follow(now));
    EXPECT_NE(secret(links, "expert"), "correct-horse-battery");
    // The link that 'theatron link --show' prints.
    const KnownLinks all = load_links(folder.path());
    EXPECT_EQ(secret(links, "expert"),
              std::ranges::find(all.links, "expert", &KnownLink::name)->token);
}

TEST_F(Links, APipeAmongThemIsNotWaitedFor) {
    const std::string revoked = made();
    LinkKeeper links = keeper();
    ASSERT_EQ(mkfifo(file("links/deadbeef").c_str(), 0600), 0);
    EXPECT_TRUE(revoke_link(folder.path(), revoked));
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, revoked));
    EXPECT_TRUE(has(links, "expert"));
    EXPECT_THAT(links.problem(), HasSubstr("deadbeef"));
    fs::remove(file("observer.token"));
    ASSERT_EQ(mkfifo(file("observer.token").c_str(), 0600), 0);
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, "observer"));
    EXPECT_TRUE(has(links, "expert"));
}

TEST_F(Links, ARevokedLinkIsInvalidWhateverElseIsWrong) {
    const std::string revoked = made(), other = made();
    LinkKeeper links = keeper();
    ASSERT_EQ(chmod(file("observer.token").c_str(), 0644), 0);
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, "observer"));
    EXPECT_TRUE(has(links, revoked) && has(links, other));
    EXPECT_THAT(links.problem(), HasSubstr("observer.token"));
    EXPECT_TRUE(revoke_link(folder.path(), revoked));
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, revoked));
    EXPECT_TRUE(has(links, other) && has(links, "operator"));
    ASSERT_EQ(chmod(file("observer.token").c_str(), 0600), 0);
    EXPECT_TRUE(links.follow(now));
    EXPECT_TRUE(has(links, "observer"));
    EXPECT_THAT(links.problem(), IsEmpty());
}

TEST_F(Links, WhatFailedIsTriedAgainEachSecond) {
    LinkKeeper links = keeper();
    // The role has no link, and none can be made, for a reason that no link's file shows.
    const fs::path draft = file("observer.token.part");
    fs::create_directories(draft / "in the way");
    fs::remove(file("observer.token"));
    EXPECT_TRUE(links.follow(now));
    EXPECT_FALSE(has(links, "observer"));
    EXPECT_TRUE(has(links, "operator"));
    EXPECT_THAT(links.problem(), HasSubstr("observer.token"));
    fs::remove_all(draft);
    EXPECT_FALSE(links.follow(now));
    now += LinkKeeper::again_after;
    EXPECT_TRUE(links.follow(now));
    EXPECT_TRUE(has(links, "observer"));
    EXPECT_THAT(links.problem(), IsEmpty());
}

TEST_F(Links, ARevocationThatCannotBeSavedHoldsAndIsTriedAgain) {
    const std::string link = made();
    LinkKeeper links = keeper();
    // Something that cannot be deleted stands in the file's place, and then the file itself again.
    const fs::path path = file("links") / link, kept = file("kept");
    fs::rename(path, kept);
    fs::create_directories(path / "in the way");
    links.revoke(link, now);
    EXPECT_FALSE(has(links, link));
    EXPECT_THAT(links.problem(), HasSubstr("would after a restart"));
    fs::remove_all(path);
    fs::rename(kept, path);
    made();
    EXPECT_TRUE(links.follow(now)) << "another link was made";
    EXPECT_FALSE(has(links, link)) << "the file is still there";
    now += LinkKeeper::again_after;
    (void)links.follow(now);
    EXPECT_FALSE(has(links, link));
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THAT(links.problem(), IsEmpty());
}

TEST_F(Links, ARoleWhoseLinkIsRevokedGetsAnotherOnceThatCanBeSaved) {
    LinkKeeper links = keeper();
    const std::string before = secret(links, "expert");
    const fs::path draft = file("join.token.part");
    fs::create_directories(draft / "in the way");
    links.revoke("expert", now);
    EXPECT_FALSE(has(links, "expert"));
    made();
    (void)links.follow(now);
    EXPECT_FALSE(has(links, "expert")) << "its file has the revoked token";
    fs::remove_all(draft);
    now += LinkKeeper::again_after;
    EXPECT_TRUE(links.follow(now));
    (void)links.follow(now);
    ASSERT_TRUE(has(links, "expert"));
    EXPECT_NE(secret(links, "expert"), before);
}

TEST_F(Links, AnOwnTokenIsThatOfTheExpertUntilItIsRevoked) {
    const std::string own = "a token of the user's own";
    LinkKeeper links = keeper(own);
    EXPECT_EQ(secret(links, "expert"), own);
    links.revoke("expert", now);
    EXPECT_FALSE(has(links, "expert"));
    EXPECT_TRUE(links.follow(now));
    EXPECT_NE(secret(links, "expert"), own);
}

TEST_F(Links, TheEndOfALinkIsATimeInUtc) {
    const std::string link = made(1'795'378'500);
    LinkKeeper links = keeper();
    const auto tokens = links.tokens();
    const auto* token = find(tokens, link);
    ASSERT_TRUE(token);
    EXPECT_FALSE(token->has_expired(now, 1'795'378'499));
    EXPECT_TRUE(token->has_expired(now, 1'795'378'500));
    EXPECT_FALSE(find(tokens, "operator")->has_expired(now, 1'795'378'500));
}

TEST_F(Links, SaysWhatItFollowsOnceAllOfItHolds) {
    LinkKeeper links = keeper();
    EXPECT_FALSE(are_links_followed(folder.path()));
    links.tell_followed(now);
    EXPECT_TRUE(are_links_followed(folder.path()));
    const std::string link = made();
    EXPECT_FALSE(are_links_followed(folder.path()));
    EXPECT_TRUE(links.follow(now));
    links.tell_followed(now);
    EXPECT_TRUE(are_links_followed(folder.path()));
}

}  // namespace
}  // namespace theatron::host
