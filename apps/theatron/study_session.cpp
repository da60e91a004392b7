// SPDX-License-Identifier: Apache-2.0
#include "study_session.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/steady_clock.h"
#include "files/journal_file.h"
#include "files/json_text.h"
#include "files/private_file.h"
#include "study_folder.h"

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

// The line of a host's standard input that sets and locks what a host can set.
std::string host_line(const study::Condition& condition) {
    return condition.renderer.empty() ? "renderer all free"
                                      : "renderer " + condition.renderer + " lock";
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
    add("--room", condition.room);
    return words;
}

// A pipe from which a host reads its lines.
void tell_host(const std::string& path, const std::string& line) {
    if (path.empty())
        return;
    const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0 && errno == ENXIO)
        throw Error("No host reads from '" + path + "'; start it with: theatron host ... < " +
                    path + ".");
    if (file < 0)
        throw Error("Cannot write to '" + path + "': " + std::strerror(errno) + ".");
    const std::string text = line + "\n";
    const bool is_written = write(file, text.data(), text.size()) == ssize_t(text.size());
    close(file);
    if (!is_written)
        throw Error("The host does not take the line '" + line + "' from '" + path + "'.");
}

class TerminalSurface {
public:
    TerminalSurface(const Study& study, bool json) : study_(study), json_(json) {}

    void begin(const StudyRun& run, const std::string& participant, bool is_resumed) const {
        if (json_)
            return say({{"event", is_resumed ? "resumed" : "began"},
                        {"participant", participant},
                        {"step", run.position() + 1},
                        {"steps", run.steps().size()}});
        std::printf("%s, participant %s, %zu steps.\n", study_.protocol.title.c_str(),
                    participant.c_str(), run.steps().size());
        if (is_resumed)
            std::printf("The run goes on at step %zu.\n", run.position() + 1);
        std::printf("'stop' ends the study at any time; '-' leaves a question out.\n");
    }

    void remind(const study::Condition& condition) const {
        if (!json_)
            std::printf("The session must be set as before: %s\n",
                        study::values_text(condition).c_str());
    }

    void show(const StudyRun& run) const {
        const Step& step = run.current();
        if (json_)
            return say(as_json(step, run.position() + 1));
        std::printf("\n[%zu/%zu]\n", run.position() + 1, run.steps().size());
        for (const std::string& text : step.texts)
            std::printf("%s\n", text.c_str());
        if (step.kind == Step::Kind::condition) {
            const study::Condition& condition =
                study_.protocol.conditions[std::size_t(step.condition)];
            const std::string words = join_words(condition);
            if (!words.empty())
                std::printf("  by the host's line: %s\n  or by the client's options: %s\n",
                            host_line(condition).c_str(), words.c_str());
            if (condition.latency_ms > 0)
                std::printf("  and %d ms more, which the network between them has to add\n",
                            condition.latency_ms);
        }
        for (std::size_t i = 0; i < step.choices.size(); ++i)
            std::printf("  %zu  %s\n", i + 1, step.choices[i].c_str());
        std::printf("%s ", asked_for(step).c_str());
        std::fflush(stdout);
    }

    void refuse(const std::string& problem) const {
        if (json_)
            return say({{"event", "refused"}, {"problem", problem}});
        std::printf("%s ", problem.c_str());
        std::fflush(stdout);
    }

    void saved(const std::string& step) const {
        if (json_)
            say({{"event", "saved"}, {"id", step}});
    }

    void over() const {
        std::printf("\nThe time is over: press Enter. ");
        std::fflush(stdout);
    }

    void end(const StudyRun& run) const {
        if (json_)
            return say({{"event", "end"}, {"state", study::text_of(run.state())}});
        const bool stopped = run.state() == StudyRun::State::broken_off;
        if (stopped && !study_.protocol.break_off.empty())
            std::printf("\n%s\n", study_.protocol.break_off.c_str());
        std::printf("\nThe run is %s.\n", study::text_of(run.state()));
    }

private:
    static void say(const nlohmann::ordered_json& json) {
        std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                  << std::endl;
    }

    nlohmann::ordered_json as_json(const Step& step, std::size_t number) const {
        nlohmann::ordered_json json{{"event", "step"},
                                    {"step", number},
                                    {"id", step.id},
                                    {"kind", kind_text(step.kind)},
                                    {"texts", step.texts}};
        if (step.condition >= 0) {
            const study::Condition& condition =
                study_.protocol.conditions[std::size_t(step.condition)];
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

    static std::string asked_for(const Step& step) {
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

    const Study& study_;
    const bool json_;
};

// Writes nothing while somebody types.
void wait_for_time(const Step& step, const TerminalSurface& surface) {
    if (step.watch_s == 0 || !isatty(STDIN_FILENO))
        return;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, step.watch_s * 1000) == 0)
        surface.over();
}

std::optional<StudyRun> begun(const Study& study, const std::string& participant,
                              files::JournalFile& file) {
    const std::string path = study.journal_of(participant).string();
    const std::string text = file.text(study::max_journal_bytes);
    const study::ReadJournal read = study::parse_journal(text);
    if (!read.problem.empty())
        throw Error("'" + path + "', line " + std::to_string(read.line) + ": " + read.problem +
                    "; the run cannot go on.");
    if (read.line > 0 && read.journal.hash != study.hash)
        throw Error("The protocol or its questionnaires were changed since " + participant +
                    " began; put their earlier text back, or take another pseudonym.");
    StudyRun run(study.protocol, study.questionnaires, *study::participant_number(participant));
    if (const std::string problem = run.resume(read.journal); !problem.empty())
        throw Error("'" + path + "': " + problem);
    if (run.state() != StudyRun::State::running)
        throw Error("The run of " + participant + " is " + study::text_of(run.state()) +
                    " already; another participant needs another pseudonym.");
    if (read.journal.whole_bytes < text.size())
        file.keep(read.journal.whole_bytes);
    file.append(read.line == 0 ? study::journal_head(participant, study.hash) : run.resumed_line());
    return run;
}

}  // namespace

void run_study(const StudyRunFlags& flags) {
    const Study study = load_study(flags.folder);
    if (!study::participant_number(flags.participant))
        throw Error("'" + flags.participant +
                    "' is no pseudonym; write a capital letter and a number, such as P07, and "
                    "never a name.");
    files::open_private_folder(study.journal_of(flags.participant).parent_path());
    files::JournalFile file(study.journal_of(flags.participant));
    const bool is_resumed = !file.text(study::max_journal_bytes).empty();
    StudyRun run = *begun(study, flags.participant, file);
    const TerminalSurface surface(study, flags.json);
    surface.begin(run, flags.participant, is_resumed);
    // A host that was started again knows nothing of the condition in whose midst the run goes on.
    if (const int at = run.current().condition; is_resumed && at >= 0) {
        const study::Condition& condition = study.protocol.conditions[std::size_t(at)];
        tell_host(flags.host_input, host_line(condition));
        surface.remind(condition);
    }
    while (run.state() == StudyRun::State::running) {
        const Step step = run.current();
        if (step.kind == Step::Kind::condition)
            tell_host(flags.host_input,
                      host_line(study.protocol.conditions[std::size_t(step.condition)]));
        surface.show(run);
        run.show(steady_now());
        wait_for_time(step, surface);
        while (true) {
            std::string text;
            if (!std::getline(std::cin, text))
                throw Error("The input ended before the run: the same command goes on at step " +
                            std::to_string(run.position() + 1) + ".");
            const StudyRun::Answer answer = run.reply(text, steady_now());
            if (answer.problem.empty()) {
                file.append(answer.line);
                surface.saved(step.id);
                break;
            }
            surface.refuse(answer.problem);
        }
    }
    tell_host(flags.host_input, "renderer all free");
    surface.end(run);
}

}  // namespace theatron::app
