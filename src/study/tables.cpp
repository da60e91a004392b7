// SPDX-License-Identifier: Apache-2.0
#include "study/tables.h"

#include <charconv>
#include <map>
#include <set>
#include <utility>

#include "study/order.h"

namespace theatron::study {
namespace {

std::string field(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

// The shortest text that gives the same number.
std::string field(double value) {
    char digits[40];
    return {digits, std::to_chars(digits, digits + sizeof(digits), value).ptr};
}

std::string field(std::int64_t value) {
    return std::to_string(value);
}

template <class... Fields>
std::string row(const Fields&... fields) {
    std::string text;
    ((text += (text.empty() ? "" : ",") + field(fields)), ...);
    return text + "\n";
}

// Replies to one questionnaire at one place.
struct Filled {
    const Step* step = nullptr;
    Replies replies;
};

class TableWriter {
public:
    TableWriter(const Protocol& protocol, const Questionnaires& known)
        : protocol_(protocol), known_(known) {
        tables_.participants = "participant,state,order,replied,steps,minutes\n";
        tables_.replies =
            "participant,condition,position,phase,questionnaire,item,reply,value,took_ms\n";
        tables_.scores =
            "participant,condition,position,phase,questionnaire,scale,title,score,lowest,"
            "highest\n";
        tables_.tasks =
            "participant,condition,position,phase,question,kind,expected,reply,correct,late,"
            "took_ms\n";
        tables_.items =
            "questionnaire,questionnaire_title,item,text,left,right,lowest,highest,reversed,"
            "choices,scales\n";
        add_items();
    }

    void add(const Journal& journal) {
        const int number = *participant_number(journal.participant);
        StudyRun run(protocol_, known_, number);
        (void)run.resume(journal);
        const std::vector<Step>& steps = run.steps();
        // By phase and place of the condition; questionnaires stand once in a phase.
        std::map<std::pair<std::string, std::string>, Filled> filled;
        std::size_t next = 0;
        bool is_resumed = false;
        for (const JournalEntry& entry : journal.entries) {
            if (next >= steps.size() || entry.step != steps[next].id) {
                is_resumed = true;
                continue;
            }
            const Step& step = steps[next++];
            const bool has_time = !std::exchange(is_resumed, false);
            if (!step.questionnaire.empty())
                add_reply(journal.participant, step, entry, has_time, filled);
            else if (step.is_question())
                add_task(journal.participant, step, entry, has_time);
        }
        for (const auto& [place, one] : filled)
            add_scores(journal.participant, one);
        std::string order;
        for (const std::size_t c :
             condition_order(protocol_.order, protocol_.conditions.size(), protocol_.seed, number))
            order += (order.empty() ? "" : " ") + protocol_.conditions[c].id;
        const std::int64_t at_ms = journal.entries.empty() ? 0 : journal.entries.back().at_ms;
        tables_.participants +=
            row(journal.participant, std::string(text_of(run.state())), order,
                std::int64_t(run.position()), std::int64_t(steps.size()), double(at_ms) / 60000);
    }

    Tables take() { return std::move(tables_); }

private:
    std::string condition_of(const Step& step) const {
        return step.condition >= 0 ? protocol_.conditions[std::size_t(step.condition)].id : "";
    }
    std::string position_of(const Step& step) const {
        return step.position >= 0 ? std::to_string(step.position + 1) : "";
    }

    void add_reply(const std::string& participant, const Step& step, const JournalEntry& entry,
                   bool has_time, std::map<std::pair<std::string, std::string>, Filled>& filled) {
        Filled& one =
            filled[{protocol_.phases[step.phase].id + " " + position_of(step), step.questionnaire}];
        one.step = &step;
        std::string shown = entry.value ? std::to_string(*entry.value) : "";
        if (entry.value) {
            one.replies[step.item] = *entry.value;
            if (!step.choices.empty())
                shown = step.choices[std::size_t(*entry.value - 1)];
        }
        tables_.replies += row(participant, condition_of(step), position_of(step),
                               protocol_.phases[step.phase].id, step.questionnaire, step.item,
                               shown, entry.value ? std::to_string(*entry.value) : "",
                               has_time ? std::to_string(entry.took_ms) : "");
    }

    void add_task(const std::string& participant, const Step& step, const JournalEntry& entry,
                  bool has_time) {
        const bool correct = entry.value == step.expected && !entry.late;
        tables_.tasks +=
            row(participant, condition_of(step), position_of(step), protocol_.phases[step.phase].id,
                step.item, std::string(step.kind == Step::Kind::yes_no ? "can be built" : "count"),
                std::int64_t(step.expected), entry.value ? std::to_string(*entry.value) : "",
                std::int64_t(correct), std::int64_t(entry.late),
                has_time ? std::to_string(entry.took_ms) : "");
    }

    void add_scores(const std::string& participant, const Filled& one) {
        const Questionnaire& questionnaire = *known_.find(one.step->questionnaire);
        const auto values = scores(questionnaire, one.replies);
        for (std::size_t s = 0; s < values.size(); ++s) {
            const auto [low, high] = bounds(questionnaire, s);
            if (values[s])
                tables_.scores += row(participant, condition_of(*one.step), position_of(*one.step),
                                      protocol_.phases[one.step->phase].id, questionnaire.id,
                                      questionnaire.scales[s].id, questionnaire.scales[s].title,
                                      *values[s], low, high);
        }
    }

    void add_items() {
        std::set<std::string> asked;
        for (const Phase& phase : protocol_.phases)
            asked.insert(phase.questionnaires.begin(), phase.questionnaires.end());
        for (const Questionnaire& one : known_.all)
            for (const Item& item : one.items) {
                if (!asked.contains(one.id))
                    continue;
                std::string choices, scales;
                for (const std::string& choice : item.choices)
                    choices += (choices.empty() ? "" : " | ") + choice;
                for (const std::size_t s : std::set(item.scales.begin(), item.scales.end()))
                    scales += (scales.empty() ? "" : " | ") + one.scales[s].id;
                tables_.items += row(one.id, one.title, item.id, item.text, item.left, item.right,
                                     std::int64_t(item.lowest), std::int64_t(item.highest),
                                     std::int64_t(item.reversed), choices, scales);
            }
    }

    const Protocol& protocol_;
    const Questionnaires& known_;
    Tables tables_;
};

}  // namespace

Tables tables_of(const Protocol& protocol, const Questionnaires& known,
                 const std::vector<Journal>& journals) {
    TableWriter writer(protocol, known);
    for (const Journal& journal : journals)
        writer.add(journal);
    return writer.take();
}

}  // namespace theatron::study
