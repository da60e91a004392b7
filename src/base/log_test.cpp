// SPDX-License-Identifier: Apache-2.0
#include "base/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/line_limit.h"
#include "base/line_writer.h"
#include "base/log_format.h"
#include "base/log_scope.h"
#include "testing/log_capture.h"

namespace theatron {
namespace {

TEST(LineWriter, WritesLinesInOrderBeforeItEnds) {
    std::string written;
    {
        LineWriter writer([&](std::string_view line) {
            written += line;
            return true;
        });
        writer.put("one\n");
        writer.put("two\n");
    }
    EXPECT_EQ(written, "one\ntwo\n");
}

TEST(LineWriter, NobodyWaitsForAnOutputThatIsStuckAndWhatWasLeftOutIsCounted) {
    std::promise<void> stuck, freed;
    std::vector<std::string> written;
    LineWriter writer([&, first = true](std::string_view line) mutable {
        if (std::exchange(first, false)) {
            stuck.set_value();
            freed.get_future().wait();
        }
        written.emplace_back(line);
        return true;
    });
    writer.put("first\n");
    stuck.get_future().wait();
    constexpr std::size_t surplus = 7;
    for (std::size_t i = 0; i < LineWriter::max_waiting + surplus; ++i)
        writer.put("more\n");
    EXPECT_FALSE(writer.idle());
    EXPECT_FALSE(writer.flush(Duration(0)));
    freed.set_value();
    EXPECT_TRUE(writer.flush(std::chrono::minutes(1)));
    EXPECT_TRUE(writer.idle());
    ASSERT_EQ(written.size(), 1 + LineWriter::max_waiting + 1);
    EXPECT_EQ(written[2], "... 7 lines were left out.\n");
}

TEST(LineWriter, KeepsAResultHoweverMuchWaitsAndLinesOnlyUpToABoundOfTheirBytes) {
    std::promise<void> stuck, freed;
    std::vector<std::string> written;
    LineWriter writer([&, first = true](std::string_view line) mutable {
        if (std::exchange(first, false)) {
            stuck.set_value();
            freed.get_future().wait();
        }
        written.emplace_back(line);
        return true;
    });
    writer.put("first\n");
    stuck.get_future().wait();
    const std::string half(LineWriter::max_waiting_bytes / 2, 'x');
    for (int i = 0; i < 3; ++i)
        writer.put(half);
    EXPECT_FALSE(writer.keeps());
    writer.keep("result\n");
    EXPECT_TRUE(writer.keeps());
    freed.set_value();
    EXPECT_TRUE(writer.flush(std::chrono::minutes(1)));
    EXPECT_THAT(written, ::testing::ElementsAre("first\n", half, "... 1 lines were left out.\n",
                                                half, "result\n"));
    EXPECT_FALSE(writer.keeps() || writer.has_lost_kept());
}

TEST(LineWriter, LinesThatCannotBeWrittenAreCountedAndToldOnceTheyCan) {
    bool works = false;
    std::vector<std::string> written;
    LineWriter writer([&](std::string_view line) {
        if (works)
            written.emplace_back(line);
        return works;
    });
    for (int i = 0; i < 3; ++i)
        writer.put("lost\n");
    ASSERT_TRUE(writer.flush(std::chrono::minutes(1)));
    EXPECT_FALSE(writer.has_lost_kept());
    writer.keep("a result\n");
    ASSERT_TRUE(writer.flush(std::chrono::minutes(1)));
    EXPECT_TRUE(writer.has_lost_kept());
    works = true;
    writer.put("again\n");
    ASSERT_TRUE(writer.flush(std::chrono::minutes(1)));
    EXPECT_THAT(written, ::testing::ElementsAre("again\n", "... 4 lines were left out.\n"));
}

TEST(SessionScope, LinesAndSentencesNameTheirSession) {
    testing::LogCapture capture;
    const auto write = log::in_session("OR 4", std::function<void(int)>([](int id) {
                                           log::info("host", "one", {{"id", id}});
                                           {
                                               const log::SessionScope first("");
                                               log::info("host", "two");
                                           }
                                           log::say("Three.");
                                       }));
    write(7);
    log::info("host", "four");
    const std::string lines = capture.end();
    for (const std::string expected : {"info host: one id=7 session=\"OR 4\"\n", "info host: two\n",
                                       "OR 4: Three.\n", "info host: four\n"})
        EXPECT_NE(lines.find(expected), std::string::npos) << expected << lines;
}

TEST(LogFormat, JsonHasQuotesAndTheSession) {
    testing::LogCapture capture;
    log::set_json_lines(true);
    {
        const log::SessionScope scope("OR \"4\"");
        log::warning("host", "one", {{"id", 7}, {"path", "a\\b\n\xff"}});
    }
    log::say("Two.");
    log::flush(std::chrono::minutes(1));
    log::set_json_lines(false);
    log::say("Three.");
    std::istringstream written(capture.end());
    std::string first, second, third;
    std::getline(written, first);
    std::getline(written, second);
    std::getline(written, third);
    const std::string time = R"(^\{"time":"[-0-9T:.]{23}Z",)";
    EXPECT_TRUE(std::regex_match(
        first, std::regex(time + R"("level":"warning","area":"host","event":"one",)"
                                 R"("fields":\{"id":"7","path":"a\\\\b [^"]+"\},)"
                                 R"("session":"OR \\"4\\""\}$)")))
        << first;
    EXPECT_TRUE(std::regex_match(second, std::regex(time + R"("level":"info","event":"Two\."\}$)")))
        << second;
    EXPECT_EQ(third, "Three.");
}

TEST(LineLimit, WritesOneLinePerSourceAndInterval) {
    LineLimit limit;
    TimePoint now = from_us(1'000'000);
    EXPECT_EQ(limit.take("a", now), 0u);
    EXPECT_EQ(limit.take("a", now), std::nullopt);
    EXPECT_EQ(limit.take("b", now), 0u);
    now += LineLimit::interval;
    EXPECT_EQ(limit.take("a", now), 1u);
    EXPECT_EQ(limit.take("a", now + LineLimit::interval), 0u);
}

TEST(LineLimit, LetsSomeLinesOfASourceFollowEachOther) {
    LineLimit limit(3);
    TimePoint now = from_us(1'000'000);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(limit.take("a", now), 0u);
    EXPECT_EQ(limit.take("a", now), std::nullopt);
    now += LineLimit::interval;
    EXPECT_EQ(limit.take("a", now), 1u);
    EXPECT_EQ(limit.take("a", now), std::nullopt);
    now += 10 * LineLimit::interval;
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(limit.take("a", now));
    EXPECT_FALSE(limit.take("a", now));
}

TEST(LineLimit, ManySourcesShareWhatOneHas) {
    LineLimit limit;
    const TimePoint now = from_us(1'000'000);
    std::size_t lines = 0;
    for (int i = 0; i < 10'000; ++i)
        lines += limit.take(std::to_string(i), now).has_value();
    EXPECT_EQ(lines, LineLimit::max_sources + 1);
    EXPECT_TRUE(limit.take("another", now + LineLimit::interval));
}

TEST(Log, CutsAndCleansWhatItRepeats) {
    testing::LogCapture capture;
    const std::string wild = "\x1b]0;owned\x07 \xc2\x9b" + std::string(1000, 'x');
    log::info("test", "said", {log::outside("text", wild), {"own", wild}, {"quote", "a \"b\""}});
    log::say("a\nb\x1b[2J");
    const std::string line = capture.end();
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
    EXPECT_EQ(line.find('\x07'), std::string::npos);
    EXPECT_EQ(line.find('\xc2'), std::string::npos);
    EXPECT_EQ(std::size_t(std::count(line.begin(), line.end(), '\n')), 2u);
    EXPECT_LT(line.size(), log::max_field_characters + log::max_outside_characters + 100);
    EXPECT_NE(line.find("quote=\"a 'b'\""), std::string::npos);
    EXPECT_NE(line.find("a b"), std::string::npos);
}

}  // namespace
}  // namespace theatron
