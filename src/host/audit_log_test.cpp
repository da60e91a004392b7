// SPDX-License-Identifier: Apache-2.0
#include "host/audit_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "testing/full_disk.h"
#include "testing/temporary_folder.h"
#include "testing/wait_until.h"

namespace theatron::host {
namespace {

using What = session::AuditEvent::What;

session::AuditEvent event(What what = What::joined) {
    return {what,
            ParticipantId{7},
            "Dr. \"Ada\"\xff",
            Bytes(2, std::byte(0xab)),
            wire::Role::observer,
            "5f0c2a91",
            "Ben",
            ""};
}

// Without a last line that is still being written.
std::vector<nlohmann::json> lines_of(const std::filesystem::path& path) {
    std::vector<nlohmann::json> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line) && !in.eof();)
        lines.push_back(nlohmann::json::parse(line));
    return lines;
}

TEST(Audit, ALineNamesWhoWhatWhenAndByWhom) {
    const auto line =
        nlohmann::json::parse(audit_line(event(), "2026-11-22T20:15:00.250Z", "10.0.0.7"));
    EXPECT_EQ(line["time"], "2026-11-22T20:15:00.250Z");
    EXPECT_EQ(line["event"], "joined");
    EXPECT_EQ(line["participant"], 7);
    EXPECT_EQ(line["name"], "Dr. \"Ada\"\xef\xbf\xbd");
    EXPECT_EQ(line["person"], "abab");
    EXPECT_EQ(line["role"], "observer");
    EXPECT_EQ(line["link"], "5f0c2a91");
    EXPECT_EQ(line["address"], "10.0.0.7");
    EXPECT_EQ(line["by"], "Ben");
    const auto ended = nlohmann::json::parse(
        audit_line({What::ended, {}, "", {}, {}, "", "", ""}, "2026-11-22T20:15:00.250Z", ""));
    EXPECT_EQ(ended.size(), 2u) << ended;
}

TEST(Audit, ALineOfAFurtherSessionNamesIt) {
    const auto line = nlohmann::json::parse(audit_line(event(), "", "", "OR 2"));
    EXPECT_EQ(line["session"], "OR 2");
    EXPECT_FALSE(nlohmann::json::parse(audit_line(event(), "", "")).contains("session"));
}

TEST(Audit, LinesAreAppendedInOrderToAPrivateFile) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    for (const What what : {What::joined, What::left}) {
        AuditLog log(path);
        log.add(event(what), "");
    }
    const auto lines = lines_of(path);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0]["event"], "joined");
    EXPECT_EQ(lines[1]["event"], "left");
    struct stat info {};
    ASSERT_EQ(stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);
}

TEST(Audit, FilesAreNumberedWhenTheyAreFullAndTheirNumberIsBounded) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    for (int i = 0; i < 30; ++i) {
        AuditLog log(path, 400);  // two lines
        log.add(event(), "");
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        ++files;
        EXPECT_LE(lines_of(entry.path()).size(), 2u);
    }
    EXPECT_EQ(files, 1 + AuditLog::max_old_audits);
}

TEST(Audit, WhatWasLeftOutIsCounted) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    {
        AuditLog log(path);
        log.leave_out(What::waits);
        log.leave_out(What::joined);
        log.leave_out(What::waits);
        log.add(event(), "");
    }
    const auto last = lines_of(path).back();
    EXPECT_EQ(last["left_out"], 3);
    EXPECT_EQ(last["events"], (nlohmann::json{{"waits", 2}, {"joined", 1}}));
}

TEST(Audit, WhatWasLeftOutIsCountedAlsoWhereNoLineFollows) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    {
        AuditLog log(path);
        log.leave_out(What::waits);
    }
    ASSERT_EQ(lines_of(path).size(), 1u);
    EXPECT_EQ(lines_of(path)[0]["events"]["waits"], 1);
}

TEST(Audit, AFullDiskIsAProblemUntilItHasRoomAgainAndNothingIsLost) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    AuditLog log(path);
    log.add(event(), "");
    testing::wait_until([&] { return lines_of(path).size() == 1; });
    constexpr std::size_t more = 20;  // lines than wait
    {
        const testing::FullDisk disk(std::filesystem::file_size(path) + 10);
        log.add(event(What::left), "");
        testing::wait_until([&] { return !log.problem().empty(); });
        for (std::size_t i = 0; i < AuditLog::max_waiting_lines + more; ++i)
            log.add(event(What::waits), "");
        EXPECT_FALSE(log.problem().empty());
    }
    testing::wait_until([&] { return log.problem().empty(); });
    testing::wait_until([&] { return lines_of(path).size() == AuditLog::max_waiting_lines + 3; });
    const auto lines = lines_of(path);
    EXPECT_EQ(lines[0]["event"], "joined");
    EXPECT_EQ(lines[1]["event"], "left");
    EXPECT_EQ(lines[2]["event"], "waits");
    EXPECT_EQ(lines.back()["left_out"], more);
}

TEST(Audit, ALineThatWasCutOffEndsBeforeTheNextOne) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl";
    const std::string half = R"({"time":"2026-11-22T20:15:00.250Z","eve)";
    std::ofstream(path) << half;
    {
        AuditLog log(path);
        log.add(event(), "");
    }
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, half);
    std::getline(in, line);
    EXPECT_EQ(nlohmann::json::parse(line)["event"], "joined");
}

TEST(Audit, AFileThatWasMovedAwayIsMadeAnew) {
    const testing::TemporaryFolder folder;
    const auto path = folder.path() / "audit.jsonl", moved = folder.path() / "moved";
    AuditLog log(path);
    log.add(event(), "");
    testing::wait_until([&] { return std::filesystem::file_size(path) > 0; });
    std::filesystem::rename(path, moved);
    log.add(event(What::left), "");
    testing::wait_until([&] { return std::filesystem::exists(path) && !lines_of(path).empty(); });
    EXPECT_EQ(lines_of(path)[0]["event"], "left");
    EXPECT_EQ(lines_of(moved).size(), 1u);
}

TEST(Audit, AFileThatCannotBeWrittenIsNamed) {
    const testing::TemporaryFolder folder;
    EXPECT_THROW(AuditLog(folder.path() / "none" / "audit.jsonl"), Error);
    EXPECT_THROW(AuditLog{folder.path()}, Error);
    EXPECT_THROW(AuditLog("/dev/null"), Error);
}

}  // namespace
}  // namespace theatron::host
