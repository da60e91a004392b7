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

}  // namespace
}  // namespace theatron::net
