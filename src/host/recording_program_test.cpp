// SPDX-License-Identifier: Apache-2.0
#include "host/recording_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using Phase = RecordingProgram::Phase;
using ::testing::HasSubstr;

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return std::move(text).str();
}

// Recordings by shell scripts, whose $2 is the file.
class Recordings : public ::testing::Test {
protected:
    RecordingProgram::Options options(const std::string& script) const {
        return {folder.path() / "recordings", {"/bin/sh", "-c", script, "sh"}};
    }
    // Until the child has left `phase`.
    static RecordingProgram::State after(RecordingProgram& program, Phase phase) {
        RecordingProgram::State state = program.state(now);
        for (; state.phase == phase; state = program.state(now))
            std::this_thread::yield();
        return state;
    }
    // A script that goes on until it is asked to end.
    static std::string until_asked() {
        return "trap 'echo rest >> \"$2\"; exit 0' INT; cat > \"$2\"; while :; do :; done";
    }

    testing::TemporaryFolder folder;
    static constexpr TimePoint now = from_us(1'000'000);
};

TEST_F(Recordings, GetTheLinkByStandardInputAndAFileOfTheirOwn) {
    RecordingProgram program(options("test \"$1\" = @/dev/stdin && cat > \"$2\""));
    EXPECT_EQ(program.state(now).phase, Phase::none);
    program.start("https://or-3/#join=secret", "0badcafe", "OR 3: left/right", now);
    const auto state = after(program, Phase::running);
    EXPECT_EQ(state.phase, Phase::whole);
    EXPECT_EQ(content(state.file), "https://or-3/#join=secret\n");
    EXPECT_EQ(state.bytes, content(state.file).size());
    EXPECT_GT(state.free_bytes.value_or(0), 0u);
    EXPECT_THAT(state.file.filename().string(), HasSubstr("OR-3-left-right-20"));
    const auto end = program.take_end(now);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->link, "0badcafe");
    EXPECT_EQ(end->told, state.file.filename().string() + ": whole");
    EXPECT_FALSE(program.take_end(now)) << "once";
    program.start("link", "0badcafe", "OR 3: left/right", now);
    EXPECT_NE(program.state(now).file, state.file);
    after(program, Phase::running);
    EXPECT_EQ(content(state.file), "https://or-3/#join=secret\n") << "nothing is replaced";
}

TEST_F(Recordings, SayHowTheyEnded) {
    const auto ended = [&](const std::string& script) {
        RecordingProgram program(options(script));
        program.start("link", "0badcafe", "a", now);
        return after(program, Phase::running);
    };
    EXPECT_EQ(ended("echo one >&2; echo 'Something is missing.' >&2; exit 3").phase,
              Phase::incomplete);
    const auto failed = ended("echo 'The disk is full.' >&2; exit 1");
    EXPECT_EQ(failed.phase, Phase::failed);
    EXPECT_EQ(failed.problem, "The disk is full.");
    EXPECT_EQ(ended("exit 1").problem, "Its program ended and said nothing.");
    EXPECT_EQ(ended("kill -9 $$").problem, "Its program was ended by signal 9.");
    // More than a pipe holds, while nobody asks.
    EXPECT_EQ(ended("i=0; while [ $i -lt 3000 ]; do echo 'A line of some forty bytes, again and "
                    "again' >&2; i=$((i+1)); done; exit 3")
                  .problem,
              "A line of some forty bytes, again and again");
}

TEST_F(Recordings, EndWhenTheyAreAsked) {
    RecordingProgram program(options(until_asked()));
    EXPECT_FALSE(program.stop()) << "none runs";
    program.start("link", "0badcafe", "a", now);
    EXPECT_THROW(program.start("link", "0badcafe", "a", now), Error) << "one runs already";
    while (program.state(now).bytes == 0)
        std::this_thread::yield();
    EXPECT_EQ(program.state(now + std::chrono::seconds(3)).seconds, 3);
    EXPECT_TRUE(program.stop());
    const auto state = after(program, Phase::ending);
    EXPECT_EQ(state.phase, Phase::whole);
    EXPECT_EQ(content(state.file), "link\nrest\n");
    EXPECT_EQ(state.seconds, 3) << "as long as it was wanted";
}

TEST_F(Recordings, AreAskedToEndWithTheirHost) {
    std::filesystem::path file;
    {
        RecordingProgram program(options(until_asked()));
        program.start("link", "0badcafe", "a", now);
        while (program.state(now).bytes == 0)
            std::this_thread::yield();
        file = program.state(now).file;
    }
    EXPECT_EQ(content(file), "link\nrest\n");
}

TEST_F(Recordings, ThatAreStoppedAtOnceSaySo) {
    RecordingProgram program(options("while :; do :; done"));
    program.start("link", "0badcafe", "a", now);
    EXPECT_TRUE(program.stop());
    EXPECT_EQ(after(program, Phase::ending).problem, "It was stopped before it began.");
}

TEST_F(Recordings, ThatCannotBeginSayWhy) {
    RecordingProgram none({folder.path() / "recordings", {"/nonexistent"}});
    EXPECT_THROW(none.start("link", "0badcafe", "a", now), Error);
    EXPECT_EQ(none.state(now).phase, Phase::none);
    std::ofstream(folder.path() / "file");
    RecordingProgram blocked({folder.path() / "file", {"/bin/true"}});
    EXPECT_THROW(blocked.start("link", "0badcafe", "a", now), Error);
}

}  // namespace
}  // namespace theatron::host
