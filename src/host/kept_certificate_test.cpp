// SPDX-License-Identifier: Apache-2.0
#include "host/kept_certificate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "files/private_file.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr files::UtcSeconds day = 24 * 3600;

class KeptCertificateTest : public ::testing::Test {
protected:
    KeptCertificateTest() { write(first, first); }
    void write(const net::Certificate& certificate, const net::Certificate& key) {
        files::write_private_file(folder.path() / "crt", certificate.certificate_pem);
        files::write_private_file(folder.path() / "key", key.private_key_pem);
    }
    net::CertificateFiles files() const { return {folder.path() / "crt", folder.path() / "key"}; }
    // The files stay as they are for one look.
    bool settle(KeptCertificate& kept) const {
        const bool at_once = kept.follow(any, now);
        EXPECT_FALSE(at_once) << "a file was just changed, the other one may follow";
        return kept.follow(any, now);
    }

    static void any(const net::Certificate&) {}

    const net::Certificate first = net::make_certificate(), second = net::make_certificate();
    const testing::TemporaryFolder folder;
    const files::UtcSeconds now = files::utc_now();
};

TEST_F(KeptCertificateTest, FollowsItsFiles) {
    KeptCertificate kept(files());
    EXPECT_FALSE(settle(kept));
    write(second, second);
    EXPECT_TRUE(settle(kept));
    EXPECT_EQ(kept.current().fingerprint, second.fingerprint);
    EXPECT_EQ(kept.current().private_key_pem, second.private_key_pem);
    EXPECT_EQ(kept.problem(now, "theatron"), "");
}

TEST_F(KeptCertificateTest, KeepsTheOldOneAndSaysSoUntilTheFilesAreRight) {
    KeptCertificate kept(files());
    write(second, first);
    EXPECT_FALSE(settle(kept));
    EXPECT_EQ(kept.current().fingerprint, first.fingerprint);
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("was made for another key than"));
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("stays in use"));
    std::filesystem::remove(folder.path() / "crt");
    EXPECT_FALSE(settle(kept));
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("There is no file"));
    write(second, second);
    EXPECT_TRUE(settle(kept));
    EXPECT_EQ(kept.problem(now, "theatron"), "");
}

TEST_F(KeptCertificateTest, APermissionThatIsMendedIsNoticed) {
    KeptCertificate kept(files());
    write(second, second);
    namespace fs = std::filesystem;
    fs::permissions(folder.path() / "key", fs::perms::group_read, fs::perm_options::add);
    EXPECT_FALSE(settle(kept));
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("chmod 600"));
    fs::permissions(folder.path() / "key", fs::perms::group_read, fs::perm_options::remove);
    EXPECT_TRUE(settle(kept));
}

TEST_F(KeptCertificateTest, OneThatCannotBeUsedStaysOut) {
    KeptCertificate kept(files());
    write(second, second);
    const auto refuse = [](const net::Certificate&) { throw Error("Too short a key."); };
    (void)kept.follow(refuse, now);
    EXPECT_FALSE(kept.follow(refuse, now));
    EXPECT_EQ(kept.current().fingerprint, first.fingerprint);
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("Too short a key."));
}

TEST_F(KeptCertificateTest, WarnsThreeWeeksBeforeItsEnd) {
    const KeptCertificate kept(files());
    const files::UtcSeconds end = kept.validity().ends;
    EXPECT_EQ(kept.problem(end - 22 * day, "theatron"), "");
    EXPECT_THAT(kept.problem(end - 20 * day, "theatron"), HasSubstr(", in 20 days;"));
    EXPECT_THAT(kept.problem(end - 3600, "theatron"), HasSubstr("less than a day"));
    EXPECT_THAT(kept.problem(end + 1, "theatron"),
                AllOf(HasSubstr("expired at"), HasSubstr("let nobody go on where --hsts")));
}

TEST_F(KeptCertificateTest, OneThatIsNotValidYetIsShownIfThereIsNoOther) {
    const KeptCertificate kept(files());
    const files::UtcSeconds begin = kept.validity().begins;
    EXPECT_THAT(
        kept.problem(begin - 3600, "theatron"),
        AllOf(HasSubstr("valid only from " + files::utc_text(begin)), HasSubstr("browsers warn")));
    EXPECT_EQ(kept.problem(begin, "theatron"), "");
}

TEST_F(KeptCertificateTest, OneThatIsNotValidYetWaitsForItsTime) {
    KeptCertificate kept(files());
    write(second, second);
    const files::UtcSeconds begin = net::validity_of(second).begins;
    (void)kept.follow(any, begin - 1);
    for (int i = 0; i < 3; ++i)
        EXPECT_FALSE(kept.follow(any, begin - 1));
    EXPECT_EQ(kept.current().fingerprint, first.fingerprint);
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("stays in use"));
    EXPECT_TRUE(kept.follow(any, begin));
    EXPECT_EQ(kept.current().fingerprint, second.fingerprint);
    EXPECT_EQ(kept.problem(now, "theatron"), "");
    EXPECT_FALSE(kept.follow(any, begin));
}

TEST_F(KeptCertificateTest, OneThatHasExpiredStaysOut) {
    KeptCertificate kept(files());
    write(second, second);
    const files::UtcSeconds end = net::validity_of(second).ends;
    (void)kept.follow(any, end + 1);
    EXPECT_FALSE(kept.follow(any, end + 1));
    const std::string told = kept.problem(end + 1, "theatron");
    EXPECT_THAT(told, HasSubstr("has expired, at " + files::utc_text(end)));
    for (files::UtcSeconds later = end + 2; later < end + 5; ++later) {
        EXPECT_FALSE(kept.follow(any, later));
        EXPECT_EQ(kept.problem(later, "theatron"), told) << "a host tells it once";
    }
    EXPECT_EQ(kept.current().fingerprint, first.fingerprint);
    EXPECT_TRUE(kept.follow(any, now)) << "the clock was wrong";
    EXPECT_EQ(kept.current().fingerprint, second.fingerprint);
    EXPECT_EQ(kept.problem(now, "theatron"), "");
}

TEST_F(KeptCertificateTest, SaysThatTheOneInUseHasExpiredToo) {
    KeptCertificate kept(files());
    write(second, first);
    EXPECT_FALSE(settle(kept));
    const std::string end = files::utc_text(kept.validity().ends);
    EXPECT_THAT(kept.problem(now, "theatron"), HasSubstr("that expires at " + end + " stays"));
    EXPECT_THAT(kept.problem(kept.validity().ends + 1, "theatron"),
                HasSubstr("that expired at " + end + " stays"));
}

TEST_F(KeptCertificateTest, TheHostsOwnOneIsNotForANameButHasAnEnd) {
    KeptCertificate kept(first, "/state");
    EXPECT_FALSE(kept.follow([](const net::Certificate&) { FAIL(); }, now));
    EXPECT_EQ(kept.problem(now, "or-3"), "");
    EXPECT_THAT(kept.problem(kept.validity().ends, "or-3"), HasSubstr("'/state'"));
}

TEST_F(KeptCertificateTest, OneForAnotherNameIsToldOf) {
    EXPECT_THAT(KeptCertificate(files()).problem(now, "or-3"), HasSubstr("not one for 'or-3'"));
}

}  // namespace
}  // namespace theatron::host
