// SPDX-License-Identifier: Apache-2.0
#include "study/study_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "study/built_in.h"

namespace theatron::study {
namespace {

using ::testing::HasSubstr;

const Questionnaires known = built_in_questionnaires();

Protocol example() {
    Protocol protocol = parse_protocol(example_protocol()).protocol;
    protocol.phases[3].watch_s = 0;
    return protocol;
}

// A valid reply to a step; which one depends on its place.
std::string reply_to(const Step& step, std::size_t place) {
    switch (step.kind) {
        case Step::Kind::consent:
            return "yes";
        case Step::Kind::yes_no:
            return place % 2 ? "yes" : "no";
        case Step::Kind::number:
        case Step::Kind::rating:
        case Step::Kind::choice:
            return std::to_string(step.lowest + step.step * int(place % 2));
        default:
            return "";
    }
}

// All lines of a run, in which each step takes two seconds.
std::string whole_journal(const Protocol& protocol, int participant) {
    StudyRun run(protocol, known, participant);
    std::string text = journal_head("P0" + std::to_string(participant), protocol.hash);
    TimePoint now{};
    while (run.state() == StudyRun::State::running) {
        run.show(now);
        now += 2s;
        const auto answer = run.reply(reply_to(run.current(), run.position()), now);
        EXPECT_EQ(answer.problem, "");
        text += answer.line;
    }
    EXPECT_EQ(run.state(), StudyRun::State::complete);
    return text;
}

TEST(Pseudonyms, AreALetterAndANumber) {
    EXPECT_EQ(participant_number("P07"), 7);
    EXPECT_EQ(participant_number("A123"), 123);
    for (const char* text : {"", "P", "P0", "P00", "p1", "P1234", "Anna", "P1a", "7", "PP1", "P-1"})
        EXPECT_FALSE(participant_number(text)) << text;
}

TEST(StudyRun, StepsHaveNamesOfTheirOwnAndConditionsInTheOrder) {
    const auto first = steps_of(example(), known, 1), second = steps_of(example(), known, 2);
    std::set<std::string> ids;
    for (const Step& step : first)
        EXPECT_TRUE(ids.insert(step.id).second) << step.id;
    const auto conditions = [](const std::vector<Step>& steps) {
        std::vector<int> order;
        for (const Step& step : steps)
            if (step.kind == Step::Kind::condition)
                order.push_back(step.condition);
        return order;
    };
    EXPECT_EQ(first[0].kind, Step::Kind::consent);
    ASSERT_EQ(conditions(first).size(), 2u);
    // A square of two: the next participant has the other order.
    EXPECT_EQ(conditions(first)[0], conditions(second)[1]);
    EXPECT_NE(conditions(first), conditions(second));
}

TEST(StudyRun, TheTaskDependsOnThePlaceAndNotOnTheCondition) {
    const auto texts_at = [](const std::vector<Step>& steps, int position) {
        std::vector<std::string> texts;
        for (const Step& step : steps)
            if (step.position == position && step.kind == Step::Kind::number)
                texts.push_back(step.texts[0]);
        return texts;
    };
    const auto first = steps_of(example(), known, 1), second = steps_of(example(), known, 2);
    EXPECT_EQ(texts_at(first, 0), texts_at(second, 0));
    EXPECT_NE(texts_at(first, 0), texts_at(first, 1));
    EXPECT_NE(construction_at(example(), 3, 0), construction_at(example(), 3, 1));
}

TEST(StudyRun, WithoutConsentNothingIsAsked) {
    StudyRun run(example(), known, 1);
    const auto answer = run.reply("no", TimePoint{} + 1s);
    EXPECT_EQ(answer.line, "0\t0\tdeclined\t-\tok\n");
    EXPECT_EQ(run.state(), StudyRun::State::declined);
}

TEST(StudyRun, RepliesThatAreNoneAreRefusedAndTheTimeGoesOn) {
    StudyRun run(example(), known, 1);
    run.show(TimePoint{});
    EXPECT_THAT(run.reply("perhaps", TimePoint{} + 1s).problem, HasSubstr("yes or no"));
    EXPECT_THAT(run.reply("-", TimePoint{} + 1s).problem, HasSubstr("yes or no"));
    EXPECT_EQ(run.reply(" yes ", TimePoint{} + 3s).line, "3000\t3000\tagree.consent\t1\tok\n");
    run.show(TimePoint{} + 4s);
    for (const char* text : {"0", "6", "one", "1.5", "", "99999999999999999999"})
        EXPECT_THAT(run.reply(text, TimePoint{} + 5s).problem, HasSubstr("from 1 to 5")) << text;
    EXPECT_EQ(run.reply("5", TimePoint{} + 6s).line, "6000\t2000\tperson.about-you.age\t5\tok\n");
    EXPECT_EQ(run.reply("-", TimePoint{} + 7s).line, "7000\t0\tperson.about-you.sex\t-\tok\n");
}

TEST(StudyRun, AReplyAfterTheLimitIsLate) {
    Protocol protocol = example();
    protocol.phases[3].limit_s = 10;
    StudyRun run(protocol, known, 1);
    TimePoint now{};
    while (run.current().kind != Step::Kind::number)
        run.reply(reply_to(run.current(), 0), now);
    run.show(now);
    EXPECT_THAT(run.reply("1", now + 10s).line, HasSubstr("\tok\n"));
    run.show(now);
    StudyRun delayed = run;
    EXPECT_THAT(delayed.reply("1", now + 10100ms, 100ms).line, HasSubstr("\t10000\t"))
        << "without what was added on the way";
    EXPECT_THAT(run.reply("1", now + 10001ms).line, HasSubstr("\tlate\n"));
}

TEST(StudyRun, QuestionsComeWhenTheTimeToWatchIsOver) {
    Protocol protocol = example();
    protocol.phases[3].watch_s = 60;
    StudyRun run(protocol, known, 1);
    TimePoint now{};
    while (run.current().kind != Step::Kind::watch)
        run.reply(reply_to(run.current(), 0), now);
    run.show(now);
    EXPECT_THAT(run.reply("", now + 58500ms).problem, HasSubstr("watch for another 2 s"));
    EXPECT_THAT(run.reply("", now + 60s).line, HasSubstr("60000\t60000\tbuild."));
}

TEST(StudyRun, APersonMayStopAtEachStep) {
    const std::size_t count = steps_of(example(), known, 1).size();
    for (std::size_t stop = 0; stop < count; ++stop) {
        StudyRun run(example(), known, 1);
        for (std::size_t i = 0; i < stop; ++i)
            run.reply(reply_to(run.current(), i), TimePoint{});
        EXPECT_EQ(run.reply("stop", TimePoint{}).line, "0\t0\tbroken-off\t-\tok\n");
        EXPECT_EQ(run.state(), StudyRun::State::broken_off);
    }
}

// The disk may have any byte of the journal as its last one: all whole lines hold, and the run goes
// on at the next step to the same end.
TEST(StudyRun, AJournalThatEndsAtAnyByteLosesAtMostTheReplyBeingWritten) {
    const Protocol protocol = example();
    const std::string whole = whole_journal(protocol, 3);
    for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
        const std::string_view part = std::string_view(whole).substr(0, bytes);
        const ReadJournal read = parse_journal(part);
        ASSERT_EQ(read.problem, "") << bytes;
        const auto lines = std::size_t(std::count(part.begin(), part.end(), '\n'));
        ASSERT_EQ(read.journal.entries.size(), lines > 0 ? lines - 1 : 0);
        ASSERT_EQ(read.journal.whole_bytes, part.rfind('\n') + 1);
        StudyRun run(protocol, known, 3);
        ASSERT_EQ(run.resume(read.journal), "");
        ASSERT_EQ(run.position(), read.journal.entries.size());
    }
    // Times go on behind those of the first run.
    const std::string half = whole.substr(0, whole.size() / 2);
    const ReadJournal read = parse_journal(half);
    StudyRun run(protocol, known, 3);
    ASSERT_EQ(run.resume(read.journal), "");
    std::string text = half.substr(0, read.journal.whole_bytes) + run.resumed_line();
    TimePoint now = TimePoint{} + 1h;
    while (run.state() == StudyRun::State::running) {
        run.show(now);
        now += 2s;
        text += run.reply(reply_to(run.current(), run.position()), now).line;
    }
    const ReadJournal again = parse_journal(text);
    EXPECT_EQ(again.problem, "");
    EXPECT_EQ(again.journal.entries.back().at_ms,
              parse_journal(whole).journal.entries.back().at_ms);
    StudyRun done(protocol, known, 3);
    EXPECT_EQ(done.resume(again.journal), "");
    EXPECT_EQ(done.state(), StudyRun::State::complete);
}

TEST(StudyRun, AJournalOfOtherStepsIsRefused) {
    const Protocol protocol = example();
    Journal journal = parse_journal(whole_journal(protocol, 3)).journal;
    StudyRun other(protocol, known, 4);
    EXPECT_THAT(other.resume(journal), HasSubstr("is none that comes here"));
    journal.entries[1].value = 77;
    StudyRun same(protocol, known, 3);
    EXPECT_THAT(same.resume(journal), HasSubstr("none that can be replied"));
}

TEST(Journal, DamagedLinesAreRefusedWithTheirNumber) {
    const std::string first_line = journal_head("P07", 0xabc);
    EXPECT_EQ(first_line, "theatron-study-1\tP07\t0000000000000abc\n");
    EXPECT_EQ(parse_journal(first_line).problem, "");
    EXPECT_EQ(parse_journal(first_line).journal.hash, 0xabcu);
    for (const char* line :
         {"", "1\t2\ta\t3", "1\t2\ta\t3\tok\t", "x\t2\ta\t3\tok", "1\t-2\ta\t3\tok",
          "1\t2\t\t3\tok", "1\t2\ta b\t3\tok", "1\t2\ta\tx\tok", "1\t2\ta\t3\tmaybe"}) {
        const ReadJournal read = parse_journal(first_line + line + "\n");
        EXPECT_NE(read.problem, "") << line;
        EXPECT_EQ(read.line, 2);
    }
    EXPECT_NE(parse_journal(first_line + "5\t0\ta\t-\tok\n4\t0\tb\t-\tok\n").problem, "");
    EXPECT_NE(parse_journal("theatron-study-1\tAnna\t0000000000000abc\n").problem, "");
}

}  // namespace
}  // namespace theatron::study
