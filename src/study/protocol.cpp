// SPDX-License-Identifier: Apache-2.0
#include "study/protocol.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>

#include "base/outside_text.h"

namespace theatron::study {
namespace {

constexpr std::size_t shown_of_protocol = 60;

std::string quote(std::string_view text) {
    return "'" + clean_text(text, shown_of_protocol) + "'";
}

template <class Number>
std::string take_number(const std::string& text, Number lowest, Number highest, Number& number) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < lowest ||
        value > highest)
        return quote(text) + " is no whole number from " + std::to_string(lowest) + " to " +
               std::to_string(highest);
    number = value;
    return "";
}

// A file beside the protocol, never elsewhere.
bool is_file_name(std::string_view text) {
    return !text.empty() && text.front() != '.' && text.size() <= 100 &&
           text.find('/') == text.npos;
}

// A value of an option: no blanks, no hyphen in front.
bool is_value(std::string_view text) {
    return !text.empty() && text.front() != '-' && text.size() <= 100 &&
           text.find_first_of(" \t'\"") == text.npos;
}

class ProtocolReader {
public:
    explicit ProtocolReader(Protocol& protocol) : protocol_(protocol) {}

    // Empty: the line was taken.
    std::string take(const ConfigLine& line) {
        if (line.value.size() > max_text_bytes)
            return "the value is longer than " + std::to_string(max_text_bytes) + " bytes";
        if (clean_text(line.value, line.value.size()) != line.value)
            return "the value is no plain UTF-8 text";
        const bool begins = line.key == "condition" || line.key == "phase";
        if (begins)
            given_.clear();
        std::string problem = line.key == "condition" ? begin_condition(line)
                              : line.key == "phase"   ? begin_phase(line)
                                                      : take_part(line);
        const bool may_repeat = begins || line.key == "text" || line.key == "questionnaire" ||
                                line.key == "questionnaires";
        if (const auto [first, is_new] = given_.emplace(line.key, line.line);
            problem.empty() && !is_new && !may_repeat)
            problem = "line " + std::to_string(first->second) + " says it already";
        return problem;
    }

private:
    std::string take_part(const ConfigLine& line) {
        if (phase_)
            return take_of_phase(line);
        if (condition_)
            return take_of_condition(line);
        return take_of_study(line);
    }

    std::string begin_condition(const ConfigLine& line) {
        // The lines below a refused one are read as its own.
        refused_condition_ = {};
        condition_ = &refused_condition_;
        phase_ = nullptr;
        if (!protocol_.phases.empty())
            return "conditions stand before the first phase";
        if (!is_id(line.value))
            return quote(line.value) + " is no name of letters, digits, '-' and '_'";
        for (const Condition& other : protocol_.conditions)
            if (other.id == line.value)
                return "the condition in line " + std::to_string(other.line) + " has the same name";
        if (protocol_.conditions.size() >= max_conditions)
            return "a study has at most " + std::to_string(max_conditions) + " conditions";
        condition_ = &protocol_.conditions.emplace_back();
        condition_->id = line.value;
        condition_->line = line.line;
        return "";
    }

    std::string begin_phase(const ConfigLine& line) {
        refused_phase_ = {};
        phase_ = &refused_phase_;
        if (!is_id(line.value))
            return quote(line.value) + " is no name of letters, digits, '-' and '_'";
        for (const Phase& other : protocol_.phases)
            if (other.id == line.value)
                return "the phase in line " + std::to_string(other.line) + " has the same name";
        if (protocol_.phases.size() >= max_phases)
            return "a study has at most " + std::to_string(max_phases) + " phases";
        phase_ = &protocol_.phases.emplace_back();
        phase_->id = line.value;
        phase_->line = line.line;
        return "";
    }

    std::string take_of_study(const ConfigLine& line) {
        if (line.key == "study") {
            protocol_.title = line.value;
            return "";
        }
        if (line.key == "break-off") {
            protocol_.break_off = line.value;
            return "";
        }
        if (line.key == "seed")
            return take_number<std::uint64_t>(line.value, 0, ~std::uint64_t(0), protocol_.seed);
        if (line.key == "order") {
            const std::pair<const char*, Order> orders[] = {{"as-written", Order::as_written},
                                                            {"random", Order::random},
                                                            {"latin-square", Order::latin_square}};
            for (const auto& [name, order] : orders)
                if (line.value == name) {
                    protocol_.order = order;
                    return "";
                }
            return quote(line.value) + " is neither as-written, random nor latin-square";
        }
        if (line.key == "questionnaires") {
            if (!is_file_name(line.value))
                return quote(line.value) + " is no name of a file beside the protocol";
            if (protocol_.text_files.size() >= max_text_files)
                return "a study has at most " + std::to_string(max_text_files) +
                       " files of questionnaires";
            protocol_.text_files.push_back(line.value);
            return "";
        }
        return "there is no such line; before the first condition and phase stand study, seed, "
               "order, break-off and questionnaires";
    }

    std::string take_of_condition(const ConfigLine& line) {
        if (line.key == "latency-ms")
            return take_number<int>(line.value, 0, max_added_latency_ms, condition_->latency_ms);
        std::string* const value = line.key == "renderer"      ? &condition_->renderer
                                   : line.key == "color-codec" ? &condition_->color_codec
                                   : line.key == "depth-codec" ? &condition_->depth_codec
                                                               : nullptr;
        if (line.key == "room")
            return "no condition sets the room; take this line away, and start the participant's "
                   "program with 'theatron join --room on' or 'off'";
        if (!value)
            return "there is no such line; a condition has renderer, color-codec, depth-codec and "
                   "latency-ms";
        if (!is_value(line.value))
            return quote(line.value) + " is no value that an option takes";
        *value = line.value;
        return "";
    }

    std::string take_of_phase(const ConfigLine& line) {
        if (line.key == "kind")
            return take_kind(line.value);
        if (line.key == "text") {
            if (phase_->texts.size() >= max_paragraphs)
                return "a phase has at most " + std::to_string(max_paragraphs) + " lines of text";
            phase_->texts.push_back(line.value);
            return "";
        }
        if (line.key == "each-condition") {
            phase_->each_condition = line.value == "yes";
            return phase_->each_condition || line.value == "no"
                       ? ""
                       : quote(line.value) + " is neither yes nor no";
        }
        if (line.key == "questionnaire") {
            if (phase_->questionnaires.size() >= max_questionnaires)
                return "a phase has at most " + std::to_string(max_questionnaires) +
                       " questionnaires";
            if (!is_id(line.value))
                return quote(line.value) + " is no name of a questionnaire";
            if (std::count(phase_->questionnaires.begin(), phase_->questionnaires.end(),
                           line.value) > 0)
                return quote(line.value) + " stands in this phase already";
            phase_->questionnaires.push_back(line.value);
            return "";
        }
        if (line.key == "bricks")
            return take_number(line.value, 2, max_bricks, phase_->bricks);
        if (line.key == "questions")
            return take_number(line.value, 1, max_task_questions, phase_->questions);
        if (line.key == "watch-s")
            return take_number(line.value, 0, max_phase_seconds, phase_->watch_s);
        if (line.key == "limit-s")
            return take_number(line.value, 1, max_phase_seconds, phase_->limit_s);
        return "there is no such line; a phase has kind, text, each-condition, questionnaire, "
               "bricks, questions, watch-s and limit-s";
    }

    std::string take_kind(const std::string& value) {
        const std::pair<const char*, Phase::Kind> kinds[] = {
            {"consent", Phase::Kind::consent},
            {"instruction", Phase::Kind::instruction},
            {"questionnaire", Phase::Kind::questionnaire},
            {"bricks", Phase::Kind::bricks},
            {"break", Phase::Kind::pause}};
        for (const auto& [name, kind] : kinds)
            if (value == name) {
                phase_->kind = kind;
                phase_->has_kind = true;
                return "";
            }
        return quote(value) + " is neither consent, instruction, questionnaire, bricks nor break";
    }

    Protocol& protocol_;
    std::map<std::string, int> given_;  // keys of this part, and their lines
    Condition refused_condition_;
    Phase refused_phase_;
    Condition* condition_ = nullptr;
    Phase* phase_ = nullptr;
};

void check_phase(const Protocol& protocol, const Phase& phase, bool is_first,
                 std::vector<ConfigMistake>& mistakes) {
    const auto refuse = [&](const char* why) {
        mistakes.push_back({phase.line, "phase", quote(phase.id) + " " + why});
    };
    if (!phase.has_kind)
        return refuse("has no line 'kind = ...'");
    const bool asks = phase.kind == Phase::Kind::questionnaire;
    if (is_first && phase.kind != Phase::Kind::consent)
        refuse("is the first phase, which must be of the kind consent");
    if (!is_first && phase.kind == Phase::Kind::consent)
        refuse("asks for consent, which must stand before all other phases");
    if (phase.kind == Phase::Kind::consent && phase.each_condition)
        refuse("asks for consent, which is given once and not for each condition");
    if (asks && phase.questionnaires.empty())
        refuse("has no line 'questionnaire = NAME'");
    if (!asks && !phase.questionnaires.empty())
        refuse("has a line 'questionnaire = NAME', which needs 'kind = questionnaire'");
    if (!asks && phase.kind != Phase::Kind::bricks && phase.texts.empty())
        refuse("has no line 'text = ...', so it says nothing");
    if (phase.each_condition && protocol.conditions.empty())
        refuse("is for each condition, but there is no line 'condition = NAME'");
}

void check_protocol(const Protocol& protocol, std::vector<ConfigMistake>& mistakes) {
    if (protocol.title.empty())
        mistakes.push_back({0, "", "there is no line 'study = NAME'"});
    if (protocol.phases.empty())
        mistakes.push_back({0, "", "there is no line 'phase = NAME'"});
    for (const Phase& phase : protocol.phases)
        check_phase(protocol, phase, &phase == protocol.phases.data(), mistakes);
    // The phases of a condition are one block, which is repeated.
    int blocks = 0;
    bool before = false;
    for (const Phase& phase : protocol.phases) {
        if (phase.each_condition && !before && ++blocks == 2)
            mistakes.push_back({phase.line, "phase",
                                quote(phase.id) +
                                    " is for each condition; all such phases stand one after the "
                                    "other, and another phase is between them"});
        before = phase.each_condition;
    }
    if (!protocol.conditions.empty() && blocks == 0 && !protocol.phases.empty())
        mistakes.push_back({protocol.conditions.front().line, "condition",
                            "no phase has the line 'each-condition = yes', so no condition is "
                            "ever shown"});
}

}  // namespace

ReadProtocol parse_protocol(std::string_view text) {
    ConfigText config = parse_config(text);
    ReadProtocol read;
    ProtocolReader reader(read.protocol);
    read.protocol.conditions.reserve(max_conditions);
    read.protocol.phases.reserve(max_phases);
    for (const ConfigLine& line : config.lines)
        if (std::string why = reader.take(line); !why.empty())
            config.mistakes.push_back({line.line, line.key, std::move(why)});
    if (config.mistakes.empty())
        check_protocol(read.protocol, config.mistakes);
    std::stable_sort(config.mistakes.begin(), config.mistakes.end(),
                     [](const auto& a, const auto& b) { return a.line < b.line; });
    read.mistakes = std::move(config.mistakes);
    read.protocol.hash = text_hash(text);
    return read;
}

std::vector<ConfigMistake> check_questionnaires(const Protocol& protocol,
                                                const Questionnaires& known) {
    std::vector<ConfigMistake> mistakes;
    for (const Phase& phase : protocol.phases)
        for (const std::string& name : phase.questionnaires) {
            const Questionnaire* one = known.find(name);
            if (!one) {
                std::string names;
                for (const Questionnaire& other : known.all)
                    names += (names.empty() ? "" : ", ") + other.id;
                mistakes.push_back(
                    {phase.line, "phase",
                     "there is no questionnaire " + quote(name) + "; there are " + names});
                continue;
            }
            const auto missing = one->items_without_text();
            if (missing.empty())
                continue;
            std::string items;
            for (const std::string& item : missing)
                items += (items.empty() ? "" : " ") + item;
            mistakes.push_back(
                {phase.line, "phase",
                 "the texts of " + std::to_string(missing.size()) + " items of " + quote(name) +
                     " (" + one->title + ") are missing: " + items +
                     "; write them into a file that a line 'questionnaires = FILE' names. They "
                     "are published: " +
                     (one->texts_at.empty() ? "in a file of this study" : one->texts_at) + " (" +
                     (one->source.empty() ? "no source is named" : one->source) + ")"});
        }
    return mistakes;
}

std::vector<std::string> without_anchors(const Protocol& protocol, const Questionnaires& known) {
    std::vector<std::string> names;
    for (const Phase& phase : protocol.phases)
        for (const std::string& name : phase.questionnaires) {
            const Questionnaire* one = known.find(name);
            const bool is_bare =
                one && std::any_of(one->items.begin(), one->items.end(), [](const Item& item) {
                    return !item.scales.empty() && item.choices.empty() && item.left.empty() &&
                           item.right.empty();
                });
            if (is_bare && std::count(names.begin(), names.end(), name) == 0)
                names.push_back(name);
        }
    return names;
}

std::string values_text(const Condition& condition) {
    std::string text;
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty())
            text += (text.empty() ? "" : " ") + std::string(key) + "=" + value;
    };
    add("renderer", condition.renderer);
    add("color-codec", condition.color_codec);
    add("depth-codec", condition.depth_codec);
    add("latency-ms", condition.latency_ms > 0 ? std::to_string(condition.latency_ms) : "");
    return text.empty() ? "as usual" : text;
}

std::uint64_t text_hash(std::string_view text, std::uint64_t before) {
    // FNV-1a.
    for (const char c : text)
        before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return before;
}

std::string_view example_protocol() {
    return R"(# The protocol of a study: 'theatron study check FOLDER' tells what is wrong with it, and
# 'theatron study run FOLDER --participant P01' runs it. Lines are KEY = VALUE; a line that begins
# with # is a comment. docs/studies.md describes all keys.

study = Splats or mesh

# Orders and tasks follow from the seed: the same seed gives the same study.
seed = 2022

# as-written, random, or latin-square: each condition is equally often first, second and so on, and
# equally often behind each other one.
order = latin-square

# Shown when a participant ends the study early, which is possible at every question.
break-off = You have ended the study. Take the headset off and tell the person in charge how you are.

# The texts of published questionnaires are not part of Theatron. Write them into a file beside this
# one ('theatron study texts ipq' prints its form) and name it:
# questionnaires = ipq.conf

# What the participants compare: values that a session takes.
condition = splats
  renderer = splat

condition = mesh
  renderer = mesh

# The first phase asks for consent. Without it nothing else is asked.
phase = agree
  kind = consent
  text = You watch a person at the operating table in a virtual room, answer questions, and rate what you saw.
  text = It takes about half an hour. You may stop at any time, without giving a reason.
  text = Replies and times are kept under your pseudonym alone. Do you agree to take part?

phase = person
  kind = questionnaire
  questionnaire = about-you

# Phases with 'each-condition = yes' are repeated for each condition, in the participant's order.
phase = welcome
  kind = instruction
  each-condition = yes
  text = Put the headset on. You stand beside the table. Look around until you are at ease.

phase = build
  kind = bricks
  each-condition = yes
  text = Watch what is built on the table. Questions about it follow.
  bricks = 9
  questions = 4
  watch-s = 60

phase = impression
  kind = questionnaire
  each-condition = yes
  questionnaire = own-presence

phase = compare
  kind = questionnaire
  questionnaire = own-preference
  questionnaire = own-benefit

phase = thanks
  kind = instruction
  text = That was the last question. Thank you.
)";
}

}  // namespace theatron::study
