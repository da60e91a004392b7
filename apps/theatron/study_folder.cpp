// SPDX-License-Identifier: Apache-2.0
#include "study_folder.h"

#include <algorithm>

#include "base/error.h"
#include "base/outside_text.h"
#include "files/file_bytes.h"
#include "files/private_file.h"
#include "study/built_in.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer/renderer_text.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* protocol_name = "study.conf";
constexpr const char* journals_name = "journals";
constexpr const char* journal_ending = ".journal";
constexpr const char* texts_name = "texts";

std::string text_of_file(const fs::path& path) {
    const Bytes bytes = files::read_file(path, max_config_bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Values that this build does not have.
void check_condition(const study::Condition& condition, std::vector<ConfigMistake>& mistakes) {
    const auto refuse = [&](const char* key, const std::string& why) {
        mistakes.push_back({condition.line, "condition",
                            "'" + condition.id + "': " + key + ": " + clean_text(why, why.size())});
    };
    try {
        if (!condition.renderer.empty())
            viewer::check_renderer_choice(condition.renderer);
    } catch (const Error& error) {
        refuse("renderer", error.what());
    }
    if (!condition.color_codec.empty() && condition.color_codec != video::auto_color)
        if (const auto parsed = video::parse_color_setting(condition.color_codec);
            !parsed.problem.empty())
            refuse("color-codec", parsed.problem);
    if (!condition.depth_codec.empty())
        if (const auto parsed = video::parse_depth_setting(condition.depth_codec);
            !parsed.problem.empty())
            refuse("depth-codec", parsed.problem);
}

void add_lines(std::string& all, const std::string& lines) {
    if (!lines.empty())
        all += (all.empty() ? "" : "\n") + lines;
}

// In the order of their names.
std::vector<fs::path> journal_paths(const Study& study) {
    std::vector<fs::path> paths;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(study.folder / journals_name, none))
        if (entry.path().extension() == journal_ending)
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

study::ReadJournal read_journal(const fs::path& path) {
    const Bytes bytes = files::read_file(path, study::max_journal_bytes);
    return study::parse_journal({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

fs::path Study::journal_of(const std::string& participant) const {
    return folder / journals_name / (participant + journal_ending);
}

fs::path Study::paths_of(const std::string& participant) const {
    return folder / journals_name / (participant + ".paths.csv");
}

Study load_study(const fs::path& place) {
    std::error_code none;
    const bool is_folder = fs::is_directory(place, none);
    const fs::path file = is_folder ? place / protocol_name : place;
    if (!fs::exists(file, none))
        throw Error("There is no protocol '" + file.string() +
                    "'; 'theatron study new FOLDER' makes a study.");
    const std::string text = text_of_file(file);
    study::ReadProtocol read = study::parse_protocol(text);
    Study study;
    study.folder = file.parent_path();
    study.texts.push_back({file.filename().string(), text});
    study.hash = read.protocol.hash;
    std::string mistakes = mistakes_text(file.string(), read.mistakes);
    study.questionnaires = study::built_in_questionnaires();
    for (const std::string& name : read.protocol.text_files) {
        const fs::path other = study.folder / name;
        if (!fs::exists(other, none)) {
            add_lines(mistakes, file.string() + ": questionnaires: there is no '" + name +
                                    "' beside the protocol.");
            continue;
        }
        const std::string questions = text_of_file(other);
        study.texts.push_back({name, questions});
        study.hash = study::text_hash(questions, study.hash);
        add_lines(mistakes, mistakes_text(other.string(), study::add_questionnaires(
                                                              questions, study.questionnaires)));
    }
    std::vector<ConfigMistake> further;
    if (mistakes.empty())
        further = study::check_questionnaires(read.protocol, study.questionnaires);
    for (const study::Condition& condition : read.protocol.conditions)
        check_condition(condition, further);
    add_lines(mistakes, mistakes_text(file.string(), further));
    if (!mistakes.empty())
        throw Error("The study cannot be run:\n" + mistakes);
    study.protocol = std::move(read.protocol);
    return study;
}

std::vector<study::Journal> load_journals(const Study& study, std::vector<std::string>& others) {
    std::vector<study::Journal> journals;
    for (const fs::path& path : journal_paths(study)) {
        study::ReadJournal read = read_journal(path);
        if (!read.problem.empty())
            throw Error("'" + path.string() + "', line " + std::to_string(read.line) + ": " +
                        read.problem + "; move the file away to go on without it.");
        // Killed before its first line was whole: nothing was asked.
        if (read.line == 0)
            continue;
        require_own_journal(path, read.journal, path.stem().string());
        if (read.journal.hash != study.hash) {
            others.push_back(read.journal.participant);
            continue;
        }
        study::StudyRun run(study.protocol, study.questionnaires,
                            *study::participant_number(read.journal.participant));
        if (const std::string problem = run.resume(read.journal); !problem.empty())
            throw Error("'" + path.string() + "': " + problem +
                        " Move the file away to go on without it.");
        journals.push_back(std::move(read.journal));
    }
    return journals;
}

void require_own_journal(const fs::path& file, const study::Journal& journal,
                         const std::string& participant) {
    if (journal.participant != participant)
        throw Error("'" + file.string() + "' is the journal of " + journal.participant +
                    "; move it away, or give it that name if there is no such file.");
}

std::vector<std::string> begun_with_another_text(const Study& study) {
    std::vector<std::string> found;
    for (const fs::path& path : journal_paths(study)) {
        const study::ReadJournal read = read_journal(path);
        if (read.line > 0 && !read.journal.participant.empty() && read.journal.hash != study.hash)
            found.push_back(read.journal.participant);
    }
    return found;
}

void keep_texts(const Study& study) {
    const fs::path kept = study.folder / texts_name / study::hash_text(study.hash);
    files::open_private_folder(kept);
    for (const Study::Text& one : study.texts)
        files::write_private_file(kept / one.name, one.text);
}

std::string another_text_note(const std::vector<std::string>& participants) {
    std::string names;
    for (const std::string& name : participants)
        names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? ""
                         : names +
                               " began with another text of the protocol or its questionnaires, "
                               "and the report leaves them out. A comment is part of the text. To "
                               "go on with their study, put their text back; the folder 'texts' "
                               "keeps it, under the number in the first line of a journal.";
}

void require_other_number(const Study& study, const std::string& participant) {
    const auto number = study::participant_number(participant);
    for (const fs::path& path : journal_paths(study)) {
        const std::string other = path.stem().string();
        if (other != participant && study::participant_number(other) == number)
            throw Error("'" + participant + "' has the same number as " + other +
                        ", who has begun already; write " + other +
                        " to go on with that run, or take another number.");
    }
}

void make_study(const fs::path& folder) {
    const fs::path file = folder / protocol_name;
    std::error_code none;
    if (fs::exists(file, none))
        throw Error("'" + file.string() + "' exists already; name another folder.");
    // Replies are personal even without names.
    files::open_private_folder(folder / journals_name);
    files::write_file(file, as_bytes(study::example_protocol()));
}

}  // namespace theatron::app
