// SPDX-License-Identifier: Apache-2.0
#include "net/certificate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.h"
#include "files/private_file.h"
#include "testing/temporary_folder.h"

namespace theatron::net {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string problem_with(const fs::path& folder) {
    try {
        load_or_make_certificate(folder);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

// The files of a first start in the order in which they come into being.
const std::vector<std::vector<const char*>> cut_points = {
    {},
    {"host.key.part"},
    {"host.key"},
    {"host.key", "host.crt.part"},
};

TEST(CertificateFiles, AFirstStartThatWasCutOffAnywhereIsCompletedByTheNext) {
    const theatron::testing::TemporaryFolder folder;
    const Certificate other = make_certificate();
    int n = 0;
    for (const auto& left : cut_points) {
        // A draft may be whole, half or empty.
        for (const std::size_t size :
             {other.private_key_pem.size(), std::size_t(20), std::size_t(0)}) {
            const fs::path state = folder.path() / std::to_string(n++);
            fs::create_directory(state);
            for (const char* name : left)
                files::write_private_file(state / name, other.private_key_pem.substr(0, size));
            const Certificate made = load_or_make_certificate(state);
            EXPECT_EQ(load_or_make_certificate(state).fingerprint, made.fingerprint);
            for (const auto& entry : fs::directory_iterator(state))
                EXPECT_THAT(entry.path().filename(), ::testing::AnyOf("host.key", "host.crt"));
        }
    }
}

TEST(CertificateFiles, ACertificateWhoseKeyIsGoneIsNotReplacedInSilence) {
    const theatron::testing::TemporaryFolder folder;
    load_or_make_certificate(folder.path());
    fs::remove(folder.path() / "host.key");
    EXPECT_THAT(problem_with(folder.path()), HasSubstr("must belong together"));
}

TEST(CertificateFiles, ACertificateThatLinksNameIsNotReplacedInSilence) {
    const theatron::testing::TemporaryFolder folder;
    (void)load_or_make_certificate(folder.path());
    fs::remove(folder.path() / "host.crt");
    (void)load_or_make_certificate(folder.path());  // no link was made yet
    files::write_private_file(folder.path() / "join.token", "0123456789abcdef0123456789abcdef\n");
    fs::remove(folder.path() / "host.crt");
    EXPECT_THAT(problem_with(folder.path()), HasSubstr("links that were made name it"));
    fs::remove(folder.path() / "host.key");
    (void)load_or_make_certificate(folder.path());  // as the sentence advises
}

TEST(CertificateFiles, AKeyThatOthersMayReadIsRefused) {
    const theatron::testing::TemporaryFolder folder;
    load_or_make_certificate(folder.path());
    ASSERT_EQ(chmod((folder.path() / "host.key").c_str(), 0644), 0);
    EXPECT_THAT(problem_with(folder.path()), HasSubstr("host.key"));
    ASSERT_EQ(chmod((folder.path() / "host.key").c_str(), 0600), 0);
    ASSERT_EQ(chmod((folder.path() / "host.crt").c_str(), 0644), 0);
    EXPECT_EQ(problem_with(folder.path()), "");
}

TEST(CertificateFiles, AFolderThatOthersMayWriteIntoIsRefused) {
    const theatron::testing::TemporaryFolder folder;
    ASSERT_EQ(chmod(folder.path().c_str(), 0777), 0);
    EXPECT_THAT(problem_with(folder.path()), HasSubstr("chmod go-w"));
}

class OwnCertificate : public ::testing::Test {
protected:
    OwnCertificate() {
        write("crt", made.certificate_pem + make_certificate().certificate_pem);
        write("key", made.private_key_pem);
    }
    void write(const char* name, const std::string& text) {
        files::write_private_file(folder.path() / name, text);
    }
    std::string problem(const char* certificate = "crt", const char* key = "key") const {
        try {
            (void)read_certificate(folder.path() / certificate, folder.path() / key);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    const Certificate made = make_certificate();
    const theatron::testing::TemporaryFolder folder;
};

TEST_F(OwnCertificate, IsReadWithThoseOfItsIssuers) {
    const Certificate read = read_certificate(folder.path() / "crt", folder.path() / "key");
    EXPECT_EQ(read.fingerprint, made.fingerprint);
    EXPECT_EQ(read.private_key_pem, made.private_key_pem);
    EXPECT_GT(read.certificate_pem.size(), made.certificate_pem.size());
}

TEST_F(OwnCertificate, WhoseFilesAreMissingDamagedOrOfDifferentKeysIsRefusedByName) {
    EXPECT_THAT(problem("other"), HasSubstr("other"));
    EXPECT_THAT(problem("crt", "other"), HasSubstr("other"));
    EXPECT_THAT(problem("key", "crt"), HasSubstr("key' holds no certificate in PEM"));
    write("key", make_certificate().private_key_pem);
    EXPECT_THAT(problem(), HasSubstr("crt' was made for another key than '"));
    write("key", "");
    EXPECT_THAT(problem(), HasSubstr("key' holds no key in PEM"));
    write("key",
          "-----BEGIN ENCRYPTED PRIVATE KEY-----\nMII=\n-----END ENCRYPTED PRIVATE KEY-----\n");
    EXPECT_THAT(problem(), HasSubstr("key' has a passphrase"));
}

TEST_F(OwnCertificate, BehindThatOfAnIssuerIsRefusedWithTheRightOrder) {
    write("crt", make_certificate().certificate_pem + made.certificate_pem);
    EXPECT_THAT(problem(), HasSubstr("crt' begins with another certificate than that of the key"));
}

TEST_F(OwnCertificate, HasATimeAndAName) {
    const Validity validity = validity_of(made);
    const files::UtcSeconds now = files::utc_now(), day = 24 * 3600;
    EXPECT_NEAR(double(validity.begins), double(now - day), 60);
    EXPECT_NEAR(double(validity.ends), double(now + 3650 * day), 60);
    EXPECT_TRUE(is_for(made, "theatron"));
    EXPECT_FALSE(is_for(made, "or-3"));
    EXPECT_FALSE(is_for(made, "127.0.0.1"));
    EXPECT_THROW((void)validity_of({"no PEM", "", ""}), Error);
}

TEST_F(OwnCertificate, OfAnotherProgramIsReadWithoutItsKey) {
    const Certificate read = read_certificate(folder.path() / "crt", {});
    EXPECT_EQ(read.fingerprint, made.fingerprint);
    EXPECT_TRUE(read.private_key_pem.empty());
    write("crt", "no PEM");
    EXPECT_THROW((void)read_certificate(folder.path() / "crt", {}), Error);
}

TEST_F(OwnCertificate, WhoseKeyOthersMayReadIsRefused) {
    fs::permissions(folder.path() / "key", fs::perms::group_read, fs::perm_options::add);
    EXPECT_THAT(problem(), HasSubstr("key"));
}

}  // namespace
}  // namespace theatron::net
