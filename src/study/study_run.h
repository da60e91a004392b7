// SPDX-License-Identifier: Apache-2.0
// One participant's way through a study: what is shown next, what is a valid reply, and the lines
// of the journal that go to disk.
//
// The run knows no surface. A terminal, a panel in the window, the page or the headset asks for
// current(), shows it, and gives what was answered to reply(). Before it shows the next step it
// writes the returned line to the journal and to the disk. A new run of the same participant is
// given the journal and goes on at the first step without a reply.
//
// A reply is a number, yes, no, or done: there is no free text, in which a name could stand.
//
// Pure: time is an argument. Safe for any journal and any reply.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "study/bricks.h"
#include "study/protocol.h"

namespace theatron::study {

// A larger journal is refused.
inline constexpr std::size_t max_journal_bytes = std::size_t(4) << 20;

// The number of a pseudonym: one capital letter and one to three digits, not 0 ("P07" is 7).
// nullopt: it is none.
std::optional<int> participant_number(std::string_view pseudonym);

struct Step {
    enum class Kind {
        consent,    // yes or no
        read,       // done
        condition,  // done: the session has these values now
        watch,      // done, but not before its time is over: then come the questions of a task
        number,     // from lowest to highest
        yes_no,
        rating,  // from lowest to highest in steps
        choice,  // 1 to the number of choices
    };
    Kind kind = Kind::read;
    std::string id;             // unique in the run: "build.splats.q2"
    std::size_t phase = 0;      // index in the protocol
    int position = -1;          // of the condition in this participant's order; -1: none
    int condition = -1;         // index in the protocol
    std::string questionnaire;  // its name; empty: none
    std::string item;           // of it, or "q2" of a task
    std::vector<std::string> texts;
    std::vector<std::string> choices;
    std::string left, right;
    int lowest = 0, highest = 0, step = 1;
    int expected = 0;  // of number and yes_no
    int limit_s = 0;   // 0: none
    int watch_s = 0;

    // Questions may be left out; the others are done or not.
    bool may_skip() const { return kind >= Kind::number; }
    bool is_question() const { return kind >= Kind::number; }
};

// The steps of a participant, the same for the same protocol and number. `protocol` and `known`
// are without mistakes.
std::vector<Step> steps_of(const Protocol& protocol, const Questionnaires& known, int participant);

// The construction of a task, which depends on its place in the order and not on the condition:
// whoever sees the conditions in another order builds the same ones in the same order.
Construction construction_at(const Protocol& protocol, std::size_t phase, int position);

struct JournalEntry {
    std::int64_t at_ms = 0;    // since the run began, without the time while it was interrupted
    std::int64_t took_ms = 0;  // from when the step was shown
    std::string step;          // or "resumed", "broken-off", "declined"
    std::optional<int> value;  // yes is 1, no 0; nothing: left out, or nothing to answer
    bool late = false;         // after the limit
};

struct Journal {
    std::string participant;
    std::uint64_t hash = 0;  // of protocol and questionnaires
    std::vector<JournalEntry> entries;
    std::size_t whole_bytes = 0;  // those of its whole lines; what follows is half a line
};

struct ReadJournal {
    Journal journal;
    int line = 0;         // of the problem, from 1
    std::string problem;  // empty: it could be read
};
// Half a line at the end, which was being written when the program was killed, counts as not there.
ReadJournal parse_journal(std::string_view text);

// 16 hexadecimal digits, as in the first line of a journal.
std::string hash_text(std::uint64_t hash);

// The first line of a journal, and the others, with their ends.
std::string journal_head(const std::string& participant, std::uint64_t hash);
std::string journal_line(const JournalEntry& entry);

class StudyRun {
public:
    enum class State { running, complete, broken_off, declined };

    // As for steps_of().
    StudyRun(const Protocol& protocol, const Questionnaires& known, int participant);

    // Goes on behind the entries of an earlier run. Returns the problem as a sentence; empty: none.
    std::string resume(const Journal& journal);
    // For the journal after that: the time of the step that follows does not tell how long it took.
    std::string resumed_line() const;

    State state() const { return state_; }
    // The person has agreed to take part, in this run or an earlier one.
    bool has_consent() const;
    // While running.
    const Step& current() const { return steps_[next_]; }
    std::size_t position() const { return next_; }
    const std::vector<Step>& steps() const { return steps_; }

    // The current step is seen from now on. Call it again after a reply that was refused, too: the
    // first time counts.
    void show(TimePoint now);

    struct Answer {
        std::string line;     // for the journal
        std::string problem;  // a sentence for the person; then there is no line
    };
    // `text`: a number, yes, no, "-" to leave a question out, "stop" to end early; empty or "done"
    // where there is nothing to answer. `added`: the part of the time since show() by which step
    // and reply were made late on purpose, which the person did not take.
    Answer reply(std::string_view text, TimePoint now, Duration added = {});

private:
    Answer add(JournalEntry entry);
    void take(const JournalEntry& entry);
    std::optional<int> value_of(std::string_view text, std::string& problem) const;

    std::vector<Step> steps_;
    std::size_t next_ = 0;
    State state_ = State::running;
    std::int64_t before_ms_ = 0;  // at the end of the earlier runs
    std::optional<TimePoint> began_, shown_;
};

const char* text_of(StudyRun::State state);

}  // namespace theatron::study
