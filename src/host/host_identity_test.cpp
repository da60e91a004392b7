// SPDX-License-Identifier: Apache-2.0
#include "host/host_identity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <functional>
#include <optional>

#include "base/error.h"
#include "files/private_file.h"
#include "testing/full_disk.h"
#include "testing/log_capture.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Sets or takes away a variable of the environment while it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name))
            before_ = before;
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;

private:
    void set(const char* value) {
        if (value)
            setenv(name_, value, 1);
        else
            unsetenv(name_);
    }

    const char* name_;
    std::optional<std::string> before_;
};

std::string problem_of(const std::function<void()>& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(StateFolder, IsWhatTheEnvironmentNames) {
    {
        const Variable state("XDG_STATE_HOME", "/s"), home("HOME", "/h");
        EXPECT_EQ(default_state_folder(), "/s/theatron");
    }
    const Variable state("XDG_STATE_HOME", nullptr), home("HOME", "/h");
    EXPECT_EQ(default_state_folder(), "/h/.local/state/theatron");
}

TEST(StateFolder, IsNeverOneThatEverybodySharesWhereNothingIsNamed) {
    for (const char* empty : {(const char*)nullptr, "", "relative"}) {
        const Variable state("XDG_STATE_HOME", empty), home("HOME", empty);
        EXPECT_THAT(problem_of([] { default_state_folder(); }), HasSubstr("--state"));
    }
}

TEST(Address, ThatIsThereAlreadyNeedsNoRoomOnTheDisk) {
    const testing::TemporaryFolder folder;
    const net::Link link{"or-3.example", 4400, "secret", std::string(64, 'a')};
    write_address(folder.path(), link);
    net::Link other = link;
    other.port = 4401;
    const testing::FullDisk full(1);
    write_address(folder.path(), link);
    EXPECT_THROW(write_address(folder.path(), other), Error);
    EXPECT_EQ(read_address(folder.path()).port, 4400);
}

TEST(Token, IsMadeOnceAndKept) {
    const theatron::testing::TemporaryFolder folder;
    const std::string token = load_or_make_token(folder.path(), "join.token");
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(load_or_make_token(folder.path(), "join.token"), token);
    EXPECT_NE(load_or_make_token(folder.path(), "metrics.token"), token);
    struct stat info {};
    ASSERT_EQ(stat((folder.path() / "join.token").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);
}

TEST(Token, AStartThatWasCutOffIsCompletedByTheNext) {
    for (const char* left : {"join.token.part", "join.token"}) {
        const theatron::testing::TemporaryFolder folder;
        files::write_private_file(folder.path() / left, "");
        const std::string token = load_or_make_token(folder.path(), "join.token");
        EXPECT_EQ(load_or_make_token(folder.path(), "join.token"), token) << left;
    }
}

TEST(Token, OfAnEmptyFileIsNewAndTheLogTells) {
    const theatron::testing::TemporaryFolder folder;
    const auto said_at_start = [&] {
        testing::LogCapture capture;
        load_or_make_token(folder.path(), "join.token");
        return capture.end();
    };
    EXPECT_EQ(said_at_start(), "") << "the first start";
    EXPECT_EQ(said_at_start(), "");
    files::write_private_file(folder.path() / "join.token", "");
    EXPECT_THAT(said_at_start(), HasSubstr("token file was empty"));
}

TEST(Token, OfAFileThatWasCutOffLetsNobodyIn) {
    const theatron::testing::TemporaryFolder folder;
    const std::string token = load_or_make_token(folder.path(), "join.token");
    for (std::size_t left = 1; left <= token.size(); ++left) {
        files::write_private_file(folder.path() / "join.token", token.substr(0, left));
        EXPECT_THAT(problem_of([&] { load_or_make_token(folder.path(), "join.token"); }),
                    HasSubstr("is cut off"))
            << left;
    }
}

TEST(Token, ThatOthersMayReadIsRefused) {
    const theatron::testing::TemporaryFolder folder;
    load_or_make_token(folder.path(), "join.token");
    const fs::path path = folder.path() / "join.token";
    ASSERT_EQ(chmod(path.c_str(), 0644), 0);
    EXPECT_THAT(problem_of([&] { load_or_make_token(folder.path(), "join.token"); }),
                HasSubstr("chmod 600 '" + path.string()));
    EXPECT_THAT(problem_of([&] { read_token(path); }), HasSubstr("chmod 600"));
}

TEST(Token, OfAPersonsOwnIsLongEnoughAndFitsIntoALink) {
    EXPECT_EQ(problem_of([] { check_token(std::string(least_token_characters, 'a')); }), "");
    EXPECT_THAT(problem_of([] { check_token(std::string(least_token_characters - 1, 'a')); }),
                HasSubstr("could be guessed"));
    EXPECT_THAT(problem_of([] { check_token("0123456789abcdef&cert=x"); }),
                HasSubstr("part of a link"));
    const theatron::testing::TemporaryFolder folder;
    files::write_private_file(folder.path() / "token", "correct-horse-battery\n");
    EXPECT_EQ(read_token(folder.path() / "token"), "correct-horse-battery");
    files::write_private_file(folder.path() / "token", "abc\n");
    EXPECT_THAT(problem_of([&] { read_token(folder.path() / "token"); }), HasSubstr("guessed"));
    EXPECT_THAT(problem_of([&] { read_token(folder.path() / "none"); }), HasSubstr("no file"));
    files::write_private_file(folder.path() / "join.token", "abc\n");
    EXPECT_THAT(problem_of([&] { load_or_make_token(folder.path(), "join.token"); }),
                HasSubstr("join.token"));
}

}  // namespace
}  // namespace theatron::host
