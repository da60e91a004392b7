// SPDX-License-Identifier: Apache-2.0
#include "host/line_probe.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace theatron::host {
namespace {

using namespace std::chrono_literals;

net::HttpAnswer ask(LineProbe& line, const std::string& target, TimePoint now = {}) {
    return line.answer({target, ""}, now);
}

TEST(LineProbe, GivesTheBytesThatWereAskedFor) {
    LineProbe line;
    EXPECT_EQ(ask(line, "/line").status, 200);
    EXPECT_EQ(ask(line, "/line").body, "");
    for (const std::size_t bytes : {std::size_t(0), std::size_t(1), std::size_t(65536)}) {
        const auto answer = ask(line, "/line?bytes=" + std::to_string(bytes));
        EXPECT_EQ(answer.status, 200);
        EXPECT_EQ(answer.body.size(), bytes);
    }
    const std::string most = std::to_string(LineProbe::max_answer_bytes);
    EXPECT_EQ(ask(line, "/line?n=3&bytes=" + most).body.size(), LineProbe::max_answer_bytes);
}

TEST(LineProbe, RefusesOtherNumbersInOneSentence) {
    LineProbe line;
    const std::string more = std::to_string(LineProbe::max_answer_bytes + 1);
    for (const std::string& text :
         {more, std::string("-1"), std::string("1e3"), std::string("x"), std::string("12 "),
          std::string("99999999999999999999999"), std::string("%00")}) {
        const auto answer = ask(line, "/line?bytes=" + text);
        EXPECT_EQ(answer.status, 400) << text;
        EXPECT_NE(answer.body.find("Ask for 0 to"), std::string::npos);
    }
}

TEST(LineProbe, TakesBodiesUpToItsBound) {
    LineProbe line;
    EXPECT_EQ(line.take_body(0, {}).status, 204);
    EXPECT_EQ(line.take_body(LineProbe::max_body_bytes, {}).status, 204);
    EXPECT_EQ(line.take_body(LineProbe::max_body_bytes + 1, {}).status, 413);
    EXPECT_EQ(line.take_body(UINT64_MAX, {}).status, 413);
}

// A flood gets what the bucket has, then its rate, in both directions together.
TEST(LineProbe, AFloodCostsTheHostABoundedNumberOfBytes) {
    LineProbe line;
    const std::string largest = "/line?bytes=" + std::to_string(LineProbe::max_answer_bytes);
    std::uint64_t bytes = 0, refused = 0;
    for (int i = 0; i < 10000; ++i) {
        const TimePoint now = TimePoint() + i * 1ms;
        if (const auto answer = ask(line, largest, now); answer.status == 200)
            bytes += answer.body.size();
        else
            refused += answer.status == 429;
        if (line.take_body(LineProbe::max_body_bytes, now).status == 204)
            bytes += LineProbe::max_body_bytes;
    }
    const double allowed = LineProbe::max_bytes_at_once + 10 * LineProbe::max_bytes_per_second;
    EXPECT_LE(double(bytes), allowed);
    EXPECT_GT(double(bytes), 0.8 * allowed);
    EXPECT_GT(refused, 9000u);
}

TEST(LineProbe, EmptyRequestsAreBoundedToo) {
    LineProbe line;
    int answered = 0;
    for (int i = 0; i < 100'000; ++i)
        answered += ask(line, "/line").status == 200;
    EXPECT_EQ(answered, int(LineProbe::max_bytes_at_once) / int(LineProbe::least_bytes));
    EXPECT_EQ(ask(line, "/line", TimePoint() + 1s).status, 200);
}

TEST(LineProbe, IsAtOnePathAlone) {
    EXPECT_TRUE(LineProbe::is_line({"/line?bytes=1", ""}));
    for (const char* target : {"/", "/lines", "/line/", "//line", "/x?/line"})
        EXPECT_FALSE(LineProbe::is_line({target, ""})) << target;
}

}  // namespace
}  // namespace theatron::host
