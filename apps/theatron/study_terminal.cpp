// SPDX-License-Identifier: Apache-2.0
#include "study_terminal.h"

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/outside_text.h"

namespace theatron::app {
namespace {

using study::Step;
using study::StudyRun;

const char* kind_text(Step::Kind kind) {
    switch (kind) {
        case Step::Kind::consent:
            return "consent";
        case Step::Kind::read:
            return "read";
        case Step::Kind::condition:
            return "condition";
        case Step::Kind::watch:
            return "watch";
        case Step::Kind::number:
            return "number";
        case Step::Kind::yes_no:
            return "yes_no";
        case Step::Kind::rating:
            return "rating";
        case Step::Kind::choice:
            return "choice";
    }
    return "";
}

// The options of 'theatron join' that the participant's own client takes.
std::string join_words(const study::Condition& condition) {
    std::string words;
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty())
            words += (words.empty() ? "" : " ") + std::string(option) + " " + value;
    };
    add("--renderer", condition.renderer);
    add("--color-codec", condition.color_codec);
    add("--depth-codec", condition.depth_codec);
    return words;
}

void say(const nlohmann::ordered_json& json) {
    std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << std::endl;
}

nlohmann::ordered_json as_json(const Study& study, const Step& step, std::size_t number) {
    nlohmann::ordered_json json{{"event", "step"},
                                {"step", number},
                                {"id", step.id},
                                {"kind", kind_text(step.kind)},
                                {"texts", step.texts}};
    if (step.condition >= 0) {
        const study::Condition& condition = study.protocol.conditions[std::size_t(step.condition)];
        json["condition"] = condition.id;
        if (step.kind == Step::Kind::condition) {
            json["host_line"] = host_line(condition);
            json["join_options"] = join_words(condition);
            json["latency_ms"] = condition.latency_ms;
        }
    }
    if (!step.choices.empty())
        json["choices"] = step.choices;
    if (step.kind == Step::Kind::rating || step.kind == Step::Kind::number) {
        json["lowest"] = step.lowest;
        json["highest"] = step.highest;
        json["step_size"] = step.step;
    }
    if (!step.left.empty())
        json["anchors"] = {step.left, step.right};
    if (step.watch_s > 0)
        json["watch_s"] = step.watch_s;
    if (step.limit_s > 0)
        json["limit_s"] = step.limit_s;
    return json;
}

std::string asked_for(const Step& step) {
    const std::string limit =
        step.limit_s > 0 ? " (within " + std::to_string(step.limit_s) + " s)" : "";
    switch (step.kind) {
        case Step::Kind::consent:
        case Step::Kind::yes_no:
            return "yes or no" + limit + ":";
        case Step::Kind::number:
            return "a number" + limit + ":";
        case Step::Kind::choice:
            return "1 to " + std::to_string(step.choices.size()) + ":";
        case Step::Kind::rating: {
            const auto end = [](int point, const std::string& meaning) {
                return std::to_string(point) + (meaning.empty() ? "" : " = " + meaning);
            };
            return end(step.lowest, step.left) + " ... " + end(step.highest, step.right) + ":";
        }
        case Step::Kind::watch:
            return step.watch_s > 0
                       ? "Watch for " + std::to_string(step.watch_s) + " s, then press Enter."
                       : "Press Enter for the questions.";
        default:
            return "Press Enter to go on.";
    }
}

void print_condition(const study::Condition& condition) {
    const std::string words = join_words(condition);
    if (!words.empty())
        std::printf("  by the host's line: %s\n  or by the client's options: %s\n",
                    host_line(condition).c_str(), words.c_str());
    if (condition.latency_ms > 0)
        std::printf("  and %d ms more, which the network between them has to add\n",
                    condition.latency_ms);
}

}  // namespace

std::string host_line(const study::Condition& condition) {
    return condition.renderer.empty() ? "renderer all free"
                                      : "renderer " + condition.renderer + " lock";
}

void StudyTerminal::begin(const StudyRun& run, const std::string& participant,
                          bool is_resumed) const {
    if (json_)
        return say({{"event", is_resumed ? "resumed" : "began"},
                    {"participant", participant},
                    {"step", run.position() + 1},
                    {"steps", run.steps().size()}});
    std::printf("%s, participant %s, %zu steps.\n", study_.protocol.title.c_str(),
                participant.c_str(), run.steps().size());
    if (is_resumed)
        std::printf("The run goes on at step %zu.\n", run.position() + 1);
    std::fflush(stdout);
}

void StudyTerminal::remind(const study::Condition& condition) const {
    if (!json_)
        std::printf("The session must be set as before: %s\n",
                    study::values_text(condition).c_str());
}

void StudyTerminal::show(const StudyRun& run, bool asks) const {
    const Step& step = run.current();
    if (json_)
        return say(as_json(study_, step, run.position() + 1));
    std::printf("\n[%zu/%zu]\n", run.position() + 1, run.steps().size());
    if (asks || step.kind == Step::Kind::condition)
        for (const std::string& text : step.texts)
            std::printf("%s\n", text.c_str());
    if (asks) {
        if (step.kind == Step::Kind::condition)
            print_condition(study_.protocol.conditions[std::size_t(step.condition)]);
        for (std::size_t i = 0; i < step.choices.size(); ++i)
            std::printf("  %zu  %s\n", i + 1, step.choices[i].c_str());
        std::printf("%s ", asked_for(step).c_str());
    } else {
        std::printf("%s\n", step.id.c_str());
    }
    std::fflush(stdout);
}

void StudyTerminal::refuse(const std::string& problem) const {
    if (json_)
        return say({{"event", "refused"}, {"problem", problem}});
    std::printf("%s ", problem.c_str());
    std::fflush(stdout);
}

void StudyTerminal::saved(const std::string& step) const {
    if (json_)
        say({{"event", "saved"}, {"id", step}});
}

void StudyTerminal::over() const {
    std::printf("\nThe time is over: press Enter. ");
    std::fflush(stdout);
}

void StudyTerminal::found(const std::string& name, std::uint32_t number, bool goes_on) const {
    // The name of a person stands on the terminal alone: lines of JSON are often kept.
    if (json_)
        return say({{"event", "found"}, {"id", number}});
    std::printf(
        "The participant is here: %s, #%u.%s\n", clean_text(name, name.size()).c_str(),
        unsigned(number),
        goes_on ? " If somebody else began this run, stop now, and start with --person '#n'." : "");
    std::fflush(stdout);
}

void StudyTerminal::wait(const std::string& why) const {
    if (json_)
        return say({{"event", "waits"}, {"why", why}});
    std::printf("%s\n", why.c_str());
    std::fflush(stdout);
}

void StudyTerminal::end(const StudyRun& run) const {
    if (json_)
        return say({{"event", "end"}, {"state", study::text_of(run.state())}});
    const bool stopped = run.state() == StudyRun::State::broken_off;
    if (stopped && !study_.protocol.break_off.empty())
        std::printf("\n%s\n", study_.protocol.break_off.c_str());
    std::printf("\nThe run is %s.\n", study::text_of(run.state()));
}

}  // namespace theatron::app
