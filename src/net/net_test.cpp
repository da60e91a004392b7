// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>

#include "base/error.h"
#include "net/certificate.h"
#include "net/clock_sync.h"
#include "net/link.h"
#include "testing/temporary_folder.h"

namespace theatron::net {
namespace {

TEST(Link, RoundTrips) {
    const std::string fingerprint(64, 'a');
    for (const char* host : {"127.0.0.1", "or-3.hospital.example", "fe80::1"}) {
        const Link link = parse_link(format_link({host, 4400, "secret", fingerprint}));
        EXPECT_EQ(link.host, host);
        EXPECT_EQ(link.port, 4400);
        EXPECT_EQ(link.token, "secret");
        EXPECT_EQ(link.fingerprint, fingerprint);
    }
}

TEST(Link, SaysWhatIsWrong) {
    const std::string f(64, 'a');
    for (const std::string& text :
         {std::string("http://h:1/#join=t&cert=") + f, std::string("https://h/#join=t&cert=") + f,
          std::string("https://h:99999/#join=t&cert=") + f, std::string("https://h:1/#cert=") + f,
          std::string("https://h:1/#join=t"), std::string("https://h:1/#join=t&cert=zz"),
          std::string()})
        EXPECT_THROW(parse_link(text), Error) << text;
}

TEST(Endpoint, Parses) {
    EXPECT_EQ(parse_endpoint("127.0.0.1:0").address, "127.0.0.1");
    EXPECT_EQ(parse_endpoint("[::1]:5").address, "::1");
    EXPECT_EQ(parse_endpoint(":4400").address, "0.0.0.0");
    EXPECT_EQ(parse_endpoint(":4400").port, 4400);
    for (const char* text : {"4400", "h:", "h:x", "h:70000", "::1:5"})
        EXPECT_THROW(parse_endpoint(text), Error) << text;
}

TEST(Certificate, IsMadeOnceAndKept) {
    const testing::TemporaryFolder of_this_test;
    const auto folder = of_this_test.path() / "state";
    const Certificate made = load_or_make_certificate(folder);
    const Certificate loaded = load_or_make_certificate(folder);
    EXPECT_EQ(made.fingerprint, loaded.fingerprint);
    EXPECT_EQ(made.fingerprint.size(), 64u);
    struct stat info {};
    ASSERT_EQ(stat((folder / "host.key").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);

    std::filesystem::resize_file(folder / "host.key", 20);
    EXPECT_THROW(load_or_make_certificate(folder), Error);
}

TEST(Certificate, SecretsCompare) {
    EXPECT_TRUE(equal_secrets("abc", "abc"));
    EXPECT_FALSE(equal_secrets("abc", "abd"));
    EXPECT_FALSE(equal_secrets("abc", "ab"));
    EXPECT_NE(random_token(), random_token());
}

// A host whose clock is ahead by `offset`, over ways of random length.
TEST(ClockSync, FindsTheOffsetWithinItsBound) {
    std::mt19937 rng(1);
    const Duration offset = 123456us;
    ClockSync sync;
    EXPECT_FALSE(sync.known());
    TimePoint local{};
    for (int i = 0; i < 50; ++i) {
        const Duration there = Duration(2000 + rng() % 20000),
                       back = Duration(2000 + rng() % 20000);
        const TimePoint received = local + there + offset;
        sync.add(local, received, received + 100us, local + there + 100us + back);
        local += 100ms;
        EXPECT_LE(abs(sync.offset() - offset), sync.error_bound());
    }
    EXPECT_LT(sync.error_bound(), 8ms);
}

TEST(ClockSync, KeepsTheOffsetOfAnEarlierConnectionUntilItKnowsAnother) {
    ClockSync sync;
    sync.forget();
    EXPECT_EQ(sync.offset(), Duration(0));
    sync.add(from_us(100), from_us(1100), from_us(1100), from_us(100));
    for (int i = 0; i < 2; ++i) {
        sync.forget();
        EXPECT_FALSE(sync.known());
        EXPECT_EQ(sync.offset(), 1000us) << i;
        EXPECT_EQ(sync.error_bound(), Duration::max());
    }
    sync.add(from_us(100), from_us(600), from_us(600), from_us(200));
    EXPECT_EQ(sync.offset(), 450us);
}

TEST(ClockSync, IgnoresImpossibleAnswers) {
    ClockSync sync;
    sync.add(from_us(100), from_us(50), from_us(50), from_us(90));
    sync.add(from_us(100), from_us(50), from_us(40), from_us(190));
    EXPECT_FALSE(sync.known());
}

}  // namespace
}  // namespace theatron::net
