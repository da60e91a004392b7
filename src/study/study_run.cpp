// SPDX-License-Identifier: Apache-2.0
#include "study/study_run.h"

#include <algorithm>
#include <cassert>
#include <charconv>

#include "base/split_mix.h"
#include "base/trimmed.h"
#include "study/order.h"

namespace theatron::study {
namespace {

constexpr const char* entry_resumed = "resumed";
constexpr const char* entry_broken_off = "broken-off";
constexpr const char* entry_declined = "declined";

std::uint64_t task_seed(const Protocol& protocol, std::size_t phase, int position) {
    return mixed(protocol.seed + 1000 * (phase + 1) + std::uint64_t(position + 1));
}

// The steps of one phase; `position` -1: outside the block of conditions.
class PhaseSteps {
public:
    PhaseSteps(const Protocol& protocol, const Questionnaires& known, std::vector<Step>& steps)
        : protocol_(protocol), known_(known), steps_(steps) {}

    void add(std::size_t phase, int position, int condition) {
        const Phase& from = protocol_.phases[phase];
        phase_ = phase;
        position_ = position;
        condition_ = condition;
        switch (from.kind) {
            case Phase::Kind::consent:
                return add_plain(Step::Kind::consent, "consent", from.texts);
            case Phase::Kind::instruction:
            case Phase::Kind::pause:
                return add_plain(Step::Kind::read, "read", from.texts);
            case Phase::Kind::bricks:
                return add_bricks(from);
            case Phase::Kind::questionnaire:
                if (!from.texts.empty())
                    add_plain(Step::Kind::read, "read", from.texts);
                for (const std::string& name : from.questionnaires)
                    add_questionnaire(*known_.find(name));
        }
    }
    void add_condition(std::size_t phase, int position, int condition) {
        phase_ = phase;
        position_ = position;
        condition_ = condition;
        add_plain(
            Step::Kind::condition, "condition",
            {"Set the session: " + values_text(protocol_.conditions[std::size_t(condition)])});
    }

private:
    Step& add(Step::Kind kind, const std::string& name) {
        Step& step = steps_.emplace_back();
        step.kind = kind;
        step.phase = phase_;
        step.position = position_;
        step.condition = condition_;
        step.id = protocol_.phases[phase_].id + ".";
        if (condition_ >= 0)
            step.id += protocol_.conditions[std::size_t(condition_)].id + ".";
        step.id += name;
        return step;
    }
    void add_plain(Step::Kind kind, const char* name, std::vector<std::string> texts) {
        add(kind, name).texts = std::move(texts);
    }
    void add_bricks(const Phase& from) {
        const auto construction = construction_at(protocol_, phase_, position_);
        Step& watch = add(Step::Kind::watch, "watch");
        watch.texts = from.texts;
        watch.watch_s = from.watch_s;
        int number = 0;
        for (const BrickQuestion& question : make_questions(
                 construction, task_seed(protocol_, phase_, position_), from.questions)) {
            const std::string name = "q" + std::to_string(++number);
            const bool yes_no = question.kind == BrickQuestion::Kind::buildable;
            Step& step = add(yes_no ? Step::Kind::yes_no : Step::Kind::number, name);
            step.item = name;
            step.texts = {question.text};
            step.expected = question.answer;
            step.limit_s = from.limit_s;
            step.highest = yes_no ? 1 : max_bricks * 8;
        }
    }
    void add_questionnaire(const Questionnaire& questionnaire) {
        for (const Item& item : questionnaire.items) {
            Step& step = add(item.choices.empty() ? Step::Kind::rating : Step::Kind::choice,
                             questionnaire.id + "." + item.id);
            step.questionnaire = questionnaire.id;
            step.item = item.id;
            step.texts = {item.text};
            step.choices = item.choices;
            step.left = item.left;
            step.right = item.right;
            step.lowest = item.lowest;
            step.highest = item.highest;
            step.step = item.step;
        }
    }

    const Protocol& protocol_;
    const Questionnaires& known_;
    std::vector<Step>& steps_;
    std::size_t phase_ = 0;
    int position_ = -1, condition_ = -1;
};

bool is_done(std::string_view text) {
    return text.empty() || text == "done";
}

}  // namespace

std::optional<int> participant_number(std::string_view pseudonym) {
    if (pseudonym.size() < 2 || pseudonym.size() > 4 || pseudonym[0] < 'A' || pseudonym[0] > 'Z')
        return std::nullopt;
    int number = 0;
    for (const char c : pseudonym.substr(1)) {
        if (c < '0' || c > '9')
            return std::nullopt;
        number = 10 * number + (c - '0');
    }
    return number > 0 ? std::optional(number) : std::nullopt;
}

std::vector<Step> steps_of(const Protocol& protocol, const Questionnaires& known, int participant) {
    std::vector<Step> steps;
    PhaseSteps writer(protocol, known, steps);
    const auto order =
        condition_order(protocol.order, protocol.conditions.size(), protocol.seed, participant);
    for (std::size_t p = 0; p < protocol.phases.size();) {
        std::size_t end = p;
        while (end < protocol.phases.size() && protocol.phases[end].each_condition)
            ++end;
        if (end == p) {
            writer.add(p++, -1, -1);
            continue;
        }
        for (std::size_t place = 0; place < order.size(); ++place) {
            writer.add_condition(p, int(place), int(order[place]));
            for (std::size_t phase = p; phase < end; ++phase)
                writer.add(phase, int(place), int(order[place]));
        }
        p = end;
    }
    return steps;
}

Construction construction_at(const Protocol& protocol, std::size_t phase, int position) {
    return make_construction(task_seed(protocol, phase, position), protocol.phases[phase].bricks);
}

StudyRun::StudyRun(const Protocol& protocol, const Questionnaires& known, int participant)
    : steps_(steps_of(protocol, known, participant)) {}

std::string StudyRun::resume(const Journal& journal) {
    for (const JournalEntry& entry : journal.entries) {
        before_ms_ = entry.at_ms;
        if (entry.step == entry_resumed)
            continue;
        const bool is_end = entry.step == entry_broken_off || entry.step == entry_declined;
        if (state_ != State::running || (!is_end && entry.step != current().id))
            return "Its step '" + entry.step + "' is none that comes here in this protocol.";
        if (!is_end) {
            const Step& step = current();
            const bool within = entry.value ? step.is_question() || step.kind == Step::Kind::consent
                                            : step.kind != Step::Kind::consent;
            const int highest = step.kind == Step::Kind::consent ? 1 : step.highest;
            if (!within || (entry.value && (*entry.value < step.lowest || *entry.value > highest)))
                return "The value of its step '" + entry.step + "' is none that can be replied.";
        }
        take(entry);
    }
    return "";
}

std::string StudyRun::resumed_line() const {
    return journal_line({before_ms_, 0, entry_resumed, std::nullopt, false});
}

void StudyRun::show(TimePoint now) {
    if (!began_)
        began_ = now;
    if (!shown_)
        shown_ = now;
}

bool StudyRun::has_consent() const {
    return std::any_of(steps_.begin(), steps_.begin() + std::ptrdiff_t(next_),
                       [](const Step& step) { return step.kind == Step::Kind::consent; });
}

StudyRun::Answer StudyRun::reply(std::string_view text, TimePoint now, Duration added) {
    assert(state_ == State::running);
    show(now);
    text = trimmed(text);
    JournalEntry entry;
    const auto ms = [](Duration duration) {
        return std::max<std::int64_t>(
            0, std::chrono::duration_cast<std::chrono::milliseconds>(duration).count());
    };
    entry.at_ms = before_ms_ + ms(now - *began_);
    entry.took_ms = ms(now - *shown_ - added);
    const Step& step = current();
    entry.step = step.id;
    if (text == "stop") {
        entry.step = entry_broken_off;
        return add(entry);
    }
    if (const std::int64_t rest_ms = std::int64_t(step.watch_s) * 1000 - entry.took_ms; rest_ms > 0)
        return {"", "Please watch for another " + std::to_string((rest_ms + 999) / 1000) +
                        " s, or write stop to end."};
    entry.late = step.limit_s > 0 && entry.took_ms > std::int64_t(step.limit_s) * 1000;
    if (step.may_skip() && text == "-")
        return add(entry);
    std::string problem;
    entry.value = value_of(text, problem);
    if (!problem.empty())
        return {"", problem};
    if (step.kind == Step::Kind::consent && entry.value == 0) {
        entry.value.reset();
        entry.step = entry_declined;
    }
    return add(entry);
}

StudyRun::Answer StudyRun::add(JournalEntry entry) {
    take(entry);
    shown_.reset();
    return {journal_line(entry), ""};
}

void StudyRun::take(const JournalEntry& entry) {
    if (entry.step == entry_broken_off)
        state_ = State::broken_off;
    else if (entry.step == entry_declined)
        state_ = State::declined;
    else if (++next_ == steps_.size())
        state_ = State::complete;
}

std::optional<int> StudyRun::value_of(std::string_view text, std::string& problem) const {
    const Step& step = current();
    switch (step.kind) {
        case Step::Kind::read:
        case Step::Kind::condition:
        case Step::Kind::watch:
            if (!is_done(text))
                problem = "There is nothing to reply here: press Enter, or write stop to end.";
            return std::nullopt;
        case Step::Kind::consent:
        case Step::Kind::yes_no:
            if (text == "yes" || text == "y")
                return 1;
            if (text == "no" || text == "n")
                return 0;
            problem = "Please reply yes or no.";
            return std::nullopt;
        default:
            break;
    }
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (!is_number || value < step.lowest || value > step.highest ||
        (value - step.lowest) % step.step != 0) {
        problem = "Please reply with a whole number from " + std::to_string(step.lowest) + " to " +
                  std::to_string(step.highest) +
                  (step.step > 1 ? " in steps of " + std::to_string(step.step) : "") +
                  ", or - to leave the question out.";
        return std::nullopt;
    }
    return value;
}

const char* text_of(StudyRun::State state) {
    switch (state) {
        case StudyRun::State::running:
            return "unfinished";
        case StudyRun::State::complete:
            return "complete";
        case StudyRun::State::broken_off:
            return "broken off";
        case StudyRun::State::declined:
            return "declined";
    }
    return "";
}

}  // namespace theatron::study
