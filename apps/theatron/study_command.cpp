// SPDX-License-Identifier: Apache-2.0
// theatron study
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cases/manifest.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "study/built_in.h"
#include "study/order.h"
#include "study_folder.h"
#include "study_report.h"
#include "study_session.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr int shown_orders = 6;

std::string order_text(const Study& study, int participant) {
    std::string text;
    for (const std::size_t c :
         study::condition_order(study.protocol.order, study.protocol.conditions.size(),
                                study.protocol.seed, participant))
        text += (text.empty() ? "" : ", ") + study.protocol.conditions[c].id;
    return text;
}

void check_study(const std::string& place, bool json) {
    const Study study = load_study(place);
    const std::vector<std::string> others = begun_with_another_text(study);
    const std::vector<std::string> bare =
        study::without_anchors(study.protocol, study.questionnaires);
    const auto steps = study::steps_of(study.protocol, study.questionnaires, 1);
    if (json) {
        nlohmann::ordered_json out{{"study", study.protocol.title},
                                   {"phases", study.protocol.phases.size()},
                                   {"steps", steps.size()},
                                   {"orders", nlohmann::ordered_json::array()},
                                   {"begun_with_another_text", others},
                                   {"without_anchors", bare}};
        for (int p = 1; p <= shown_orders; ++p)
            out["orders"].push_back(order_text(study, p));
        std::cout << files::json_text(out) << std::endl;
        return;
    }
    std::printf("%s: %zu phases, %zu steps for each participant\n", study.protocol.title.c_str(),
                study.protocol.phases.size(), steps.size());
    for (const study::Condition& condition : study.protocol.conditions)
        std::printf("condition %s: %s\n", condition.id.c_str(),
                    study::values_text(condition).c_str());
    if (study.protocol.conditions.size() > 1)
        for (int p = 1; p <= shown_orders; ++p)
            std::printf("P%02d: %s\n", p, order_text(study, p).c_str());
    for (const std::string& name : bare)
        std::printf(
            "Items of '%s' do not say what their lowest and highest points mean; write lines "
            "'anchors = LOWEST | HIGHEST' into its file.\n",
            name.c_str());
    if (const std::string note = another_text_note(others); !note.empty())
        std::printf("%s\n", note.c_str());
    std::printf("The study can be run.\n");
}

void new_study(const std::string& folder) {
    make_study(folder);
    std::printf("Edit %s, then: theatron study check %s\n",
                (fs::path(folder) / "study.conf").c_str(), folder.c_str());
}

// The form of a file with the texts of a questionnaire.
void print_form(const std::string& name) {
    const study::Questionnaires known = study::built_in_questionnaires();
    if (name.empty()) {
        for (const study::Questionnaire& one : known.all)
            std::printf("%-16s %2zu items  %s%s\n", one.id.c_str(), one.items.size(),
                        one.title.c_str(), one.has_texts() ? "" : "; its texts are to be supplied");
        return;
    }
    const study::Questionnaire* one = known.find(name);
    if (!one)
        throw Error("There is no questionnaire '" + name + "'; 'theatron study texts' lists them.");
    if (one->has_texts())
        throw Error("'" + name + "' has its texts already; name it in the protocol.");
    std::printf(
        "# The texts of the %s, as published:\n#   %s\n#   texts: %s\n"
        "# Take the # away before each line that you complete, then name this file in the "
        "protocol.\n\nquestionnaire = %s\n# anchors = lowest point | highest point\n",
        one->title.c_str(), one->source.c_str(), one->texts_at.c_str(), one->id.c_str());
    std::printf("# An item with points of its own has a line 'anchors' below it.\n");
    for (const study::Item& item : one->items) {
        std::string scales;
        for (const std::size_t s : item.scales)
            scales += (scales.empty() ? "" : ", ") + one->scales[s].title;
        std::printf("\n# %s%s; %d to %d\nitem = %s\n# text = \n# anchors = \n", scales.c_str(),
                    item.reversed ? "; reversed" : "", item.lowest, item.highest, item.id.c_str());
    }
}

void write_text(const fs::path& path, const std::string& text) {
    files::write_file(path, as_bytes(text));
    std::printf("%s\n", path.c_str());
}

// "#c4281b".
Rgb color_of(const std::string& code) {
    const unsigned long value = std::stoul(code.substr(1), nullptr, 16);
    return {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

// One construction: a plan to print, its answers, and its bricks by colour for a case.
void write_plan(const Study& study, std::size_t phase, int position, const fs::path& out) {
    const study::Phase& from = study.protocol.phases[phase];
    const std::string name =
        from.id + (position >= 0 ? "-" + std::to_string(position + 1) : std::string());
    const study::Construction made = study::construction_at(study.protocol, phase, position);
    write_text(out / (name + ".svg"),
               study::construction_plan(made, study.protocol.title + ": " + name));
    nlohmann::ordered_json json{{"task", name}, {"bricks", nlohmann::ordered_json::array()}};
    for (const study::Brick& brick : made.bricks)
        json["bricks"].push_back({{"color", study::name_of(brick.color)},
                                  {"width", brick.width},
                                  {"depth", brick.depth},
                                  {"x", brick.x},
                                  {"y", brick.y},
                                  {"layer", brick.layer + 1}});
    for (const study::Step& step : study::steps_of(study.protocol, study.questionnaires, 1))
        if (step.phase == phase && step.position == position && !step.item.empty())
            json["questions"].push_back(
                {{"question", step.texts[0]},
                 {"answer", step.kind == study::Step::Kind::yes_no
                                ? nlohmann::ordered_json(step.expected ? "yes" : "no")
                                : nlohmann::ordered_json(step.expected)}});
    write_text(out / (name + ".json"), files::json_text(json, 1) + "\n");
    write_text(out / (name + ".txt"), study::construction_text(made));
    fs::create_directories(out / name);
    medical::Case parts;
    parts.name = study.protocol.title + ": " + name;
    parts.deidentified = true;  // no patient has ever been in it
    for (int c = 0; c < study::brick_colors; ++c) {
        const auto color = study::BrickColor(c);
        const std::string obj = study::construction_obj(made, color);
        if (obj.empty())
            continue;
        medical::Part part;
        part.name = std::string(study::name_of(color)) + " bricks";
        part.file = part.name + ".obj";
        part.color = color_of(study::code_of(color));
        write_text(out / name / part.file, obj);
        parts.parts.push_back(std::move(part));
    }
    // The import takes colours from it.
    write_text(out / name / cases::manifest_name, cases::manifest_text(parts));
}

void write_plans(const std::string& folder, const std::string& out) {
    const Study study = load_study(folder);
    bool any = false;
    fs::create_directories(out);
    for (std::size_t p = 0; p < study.protocol.phases.size(); ++p) {
        const study::Phase& phase = study.protocol.phases[p];
        if (phase.kind != study::Phase::Kind::bricks)
            continue;
        any = true;
        const int places = phase.each_condition ? int(study.protocol.conditions.size()) : 1;
        for (int place = 0; place < places; ++place)
            write_plan(study, p, phase.each_condition ? place : -1, out);
    }
    if (!any)
        throw Error("The protocol has no phase of the kind bricks, so there is nothing to plan.");
}

CLI::App* add_part(CLI::App& group, const char* name, const char* what, const char* examples) {
    CLI::App* command = group.add_subcommand(name, what);
    command->footer(examples);
    return command;
}

}  // namespace

void add_study_command(CLI::App& app) {
    CLI::App* group =
        app.add_subcommand("study", "Run a study with people, from consent to report");
    group->require_subcommand(1);
    group->footer(
        "Examples:\n"
        "  theatron study new our-study\n"
        "  theatron study check our-study\n"
        "  theatron study plan our-study --out plans\n"
        "  theatron study run our-study --participant P01\n"
        "  theatron study report our-study");
    const auto folder = std::make_shared<std::string>();
    const auto json = std::make_shared<bool>(false);

    CLI::App* made = add_part(*group, "new", "Make a study with a protocol that explains itself",
                              "Example:\n  theatron study new our-study");
    made->add_option("FOLDER", *folder, "The folder to make")->required();
    made->callback([folder] { new_study(*folder); });

    CLI::App* check = add_part(*group, "check", "Say what is wrong with a protocol, line by line",
                               "Examples:\n  theatron study check our-study\n"
                               "  theatron study check our-study/study.conf --json");
    check->add_option("FOLDER", *folder, "The study's folder, or its protocol")->required();
    check->add_flag("--json", *json, "Print one line of JSON");
    check->callback([folder, json] { check_study(*folder, *json); });

    const auto name = std::make_shared<std::string>();
    CLI::App* texts =
        add_part(*group, "texts", "List questionnaires, or print the form for the texts of one",
                 "Examples:\n  theatron study texts\n"
                 "  theatron study texts ipq > our-study/ipq.conf");
    texts->add_option("NAME", *name, "A questionnaire whose texts are to be supplied");
    texts->callback([name] { print_form(*name); });

    const auto out = std::make_shared<std::string>();
    CLI::App* plan = add_part(
        *group, "plan", "Write the constructions of the task with bricks: plans, answers, meshes",
        "Each construction has a plan to print (.svg), its answers (.json), the list of its\n"
        "bricks (.txt), and a folder of surfaces that becomes a case of a session.\n"
        "\nExamples:\n  theatron study plan our-study --out plans\n"
        "  theatron case import plans/build-1 cases/build-1");
    plan->add_option("FOLDER", *folder, "The study's folder")->required();
    plan->add_option("--out", *out, "The folder to write into")->required();
    plan->callback([folder, out] { write_plans(*folder, *out); });

    const auto flags = std::make_shared<StudyRunFlags>();
    CLI::App* run = add_part(
        *group, "run", "Run the study with one participant, or go on where it ended",
        "Each reply is on the disk before the next question. After a crash the same command\n"
        "goes on. A pseudonym is a capital letter and a number; who it is stays on your paper.\n"
        "\nExamples:\n  theatron study run our-study --participant P07\n"
        "  theatron study run our-study --participant P07 --link @operator.link\n"
        "  theatron study run our-study --participant P07 --link @operator.link --person '#3'\n"
        "  theatron study run our-study --participant P07 --host-input host.pipe\n"
        "  theatron study run our-study --participant P07 --json < replies.txt");
    run->add_option("FOLDER", flags->folder, "The study's folder")->required();
    run->add_option("--participant", flags->participant, "The participant's pseudonym, such as P07")
        ->required();
    run->add_option(
        "--link", flags->link,
        "The session's link for operators, or @FILE with it: the steps are shown to the "
        "participant there, in the window, the page or the headset, and conditions are set and "
        "locked by the host");
    run->add_option("--person", flags->person,
                    "Who takes part in that session: the name there, or # and the number; without "
                    "it the only one who is no operator")
        ->needs(run->get_option("--link"));
    run->add_option("--host-input", flags->host_input,
                    "A named pipe from which the session's host reads its lines: each condition's "
                    "renderer is set there for everybody and locked")
        ->excludes(run->get_option("--link"));
    run->add_flag("--json", flags->json, "Print each step as a line of JSON");
    run->callback([flags] { run_study(*flags); });

    CLI::App* report = add_part(
        *group, "report", "Compute scales, statistics and figures of all participants",
        "It writes FOLDER/report: report.html, figures as SVG, and tables as CSV. It needs\n"
        "  sudo apt install python3-scipy python3-pandas python3-matplotlib\n"
        "\nExample:\n  theatron study report our-study");
    report->add_option("FOLDER", *folder, "The study's folder")->required();
    report->add_flag("--json", *json, "Print one line of JSON");
    report->callback([folder, json] { write_study_report(*folder, *json); });
}

}  // namespace theatron::app
