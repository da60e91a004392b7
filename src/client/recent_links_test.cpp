// SPDX-License-Identifier: Apache-2.0
#include "client/recent_links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "testing/temporary_folder.h"

namespace theatron::client {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

const std::string print(64, 'a');

std::string link_to(const std::string& host, const std::string& token,
                    const std::string& more = "") {
    return "https://" + host + "/#join=" + token + "&cert=" + print + more;
}

TEST(RecentLinks, HoldTheNewestFirstAndEachOnce) {
    RecentLinks links;
    for (int i = 0; i < 7; ++i)
        links = with_newest(links, {link_to("or-3:4400", "token" + std::to_string(i)), "OR 3"});
    ASSERT_THAT(links, SizeIs(max_recent_links));
    EXPECT_THAT(links.front().link, HasSubstr("token6"));
    links = with_newest(links, {link_to("or-3:4400", "token4", "&role=expert"), "Ward"});
    ASSERT_THAT(links, SizeIs(max_recent_links));
    EXPECT_EQ(links.front().session, "Ward");
    EXPECT_THAT(links[1].link, HasSubstr("token6"));
    EXPECT_THAT(links[2].link, HasSubstr("token5"));
    EXPECT_THAT(links[3].link, HasSubstr("token3"));
    links = with_newest(links, {link_to("or-4:4400", "token3"), "OR 4"});
    EXPECT_THAT(links[4].link, HasSubstr("or-3:4400/#join=token3")) << "another host";
}

TEST(RecentLinks, AreShownWithoutTheirTokens) {
    EXPECT_EQ(recent_link_text({link_to("or-3:4400", "secret", "&role=expert"), "OR 3"}),
              "expert at or-3:4400");
    EXPECT_EQ(recent_link_text({link_to("[::1]:4400", "secret"), "OR 3"}), "at [::1]:4400");
    EXPECT_EQ(recent_link_text({link_to("or-3:4400", "s", "&role=a\nb"), "OR 3"}),
              "a b at or-3:4400");
    EXPECT_EQ(recent_link_text({"no link", "OR 3"}), "");
}

TEST(RecentLinks, AreReadAgainWithoutThoseThatHaveExpired) {
    const RecentLinks links{{link_to("or-3:4400", "one"), "OR 3, left"},
                            {link_to("or-3:4400", "two", "&until=2026-11-22T20:00:00Z"), "OR 4"}};
    const files::UtcSeconds end = *files::parse_utc("2026-11-22T20:00:00Z");
    EXPECT_EQ(parse_recent_links(recent_links_text(links), end - 1), links);
    EXPECT_THAT(parse_recent_links(recent_links_text(links), end), ElementsAre(links[0]));
    EXPECT_THAT(recent_links_text({{link_to("or-3:4400", "a\nb"), ""}}), IsEmpty());
}

TEST(RecentLinks, OfADamagedFileAreThoseThatAreLinks) {
    const std::string good = link_to("or-3:4400", "one");
    const std::string text = "\n\xff\n" + good + "\n " + good + " x\nhttps://or-3 y\n" + good +
                             " OR\t3\xe2\x80\x8b\n" + good + " \n";
    EXPECT_THAT(parse_recent_links(text, 0),
                ElementsAre(RecentLink{good, "OR 3"}, RecentLink{good, "or-3"}));
}

TEST(RecentLinks, AreKeptWhereOnlyThePersonMayRead) {
    const testing::TemporaryFolder home;
    const auto folder = home.path() / "theatron";
    const RecentLinks links{{link_to("or-3:4400", "t0ken"), "OR 3"}};
    std::string problem;
    EXPECT_THAT(load_recent_links(folder, problem), IsEmpty());
    EXPECT_EQ(problem, "");
    EXPECT_EQ(save_recent_links(folder, links), "");
    EXPECT_EQ(load_recent_links(folder, problem), links);
    namespace fs = std::filesystem;
    EXPECT_EQ(fs::status(folder / "recent_links").permissions(), fs::perms(0600));
    fs::permissions(folder / "recent_links", fs::perms(0644));
    EXPECT_THAT(load_recent_links(folder, problem), IsEmpty()) << "others may have read it";
    EXPECT_THAT(problem, HasSubstr("recent_links"));
    EXPECT_THAT(problem, Not(HasSubstr("t0ken")));
    EXPECT_EQ(save_recent_links({}, links), "") << "nowhere to keep them is no problem";
    std::ofstream(home.path() / "file") << "";
    EXPECT_THAT(save_recent_links(home.path() / "file", links),
                HasSubstr("The session is not kept for the next time. "));
}

}  // namespace
}  // namespace theatron::client
