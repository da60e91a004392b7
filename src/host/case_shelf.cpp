// SPDX-License-Identifier: Apache-2.0
#include "host/case_shelf.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/outside_text.h"
#include "base/thread_name.h"
#include "cases/manifest.h"
#include "host/cases_folder.h"
#include "net/content_digest.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

constexpr int niceness = 10;
// Files of one folder whose sizes and times are compared.
constexpr int max_watched_files = 1000;

// Empty for a folder without a manifest.
std::string signature_of(const fs::path& folder) {
    std::error_code failed;
    if (!fs::is_regular_file(fs::symlink_status(folder / cases::manifest_name, failed)))
        return "";
    std::set<std::string> files;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        std::error_code ignored;
        files.insert(entry->path().filename().string() + " " +
                     std::to_string(entry->file_size(ignored)) + " " +
                     std::to_string(entry->last_write_time(ignored).time_since_epoch().count()) +
                     " " + std::to_string(int(entry->status(ignored).permissions())));
        if (int(files.size()) >= max_watched_files)
            break;
    }
    std::string text;
    for (const std::string& file : files)
        text += file + "\n";
    return text;
}

session::CaseFacts facts_of(const cases::ShareableCase& shared) {
    session::CaseFacts facts;
    facts.id = shared.id;
    facts.name = shared.description.name;
    facts.bytes = shared.bytes;
    for (const medical::SharedPart& part : shared.description.parts)
        facts.opacities.push_back(part.opacity);
    if (shared.window)
        facts.screen = session::CaseScreen{
            shared.id, 0, 0, shared.middle_slice_mm, shared.window->center, shared.window->width};
    else if (!shared.description.pictures.empty())
        facts.screen = session::CaseScreen{shared.id, 0, 0, 0, 40, 400, std::uint16_t(0)};
    return facts;
}

}  // namespace

CaseShelf::CaseShelf(fs::path directory, Changed changed)
    : directory_(std::move(directory)), changed_(std::move(changed)) {
    std::error_code failed;
    if (!fs::is_directory(directory_, failed))
        throw Error("There is no folder '" + clean_text(directory_.string(), 300) +
                    "' for cases; make it, or name another with --cases.");
    if (const std::string advice = advice_on_cases_folder(directory_); !advice.empty())
        log::say(advice);
    thread_ = std::thread([this] { run(); });
}

CaseShelf::~CaseShelf() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    stop_.notify_all();
    thread_.join();
}

std::shared_ptr<const Bytes> CaseShelf::content(const ContentHash& hash) const {
    const std::lock_guard lock(mutex_);
    const auto found = content_.find(hash);
    return found == content_.end() ? nullptr : found->second;
}

void CaseShelf::run() {
    name_this_thread("cases");
    setpriority(PRIO_PROCESS, id_t(gettid()), niceness);
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        lock.unlock();
        (void)contain("cases", [this] { look(); });
        lock.lock();
        stop_.wait_for(lock, interval, [this] { return stopping_; });
    }
}

void CaseShelf::look() {
    std::set<std::string> names;
    std::error_code failed;
    bool is_beyond = false;
    for (fs::directory_iterator entry(directory_, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        std::error_code ignored;
        std::string name = entry->path().filename().string();
        // An import works in a hidden folder until the case is whole.
        if (!name.starts_with('.') && entry->is_directory(ignored))
            names.insert(std::move(name));
        if (names.size() > max_folders) {
            names.erase(std::prev(names.end()));
            is_beyond = true;
        }
    }
    if (is_beyond && !has_too_many_)
        log::say("The folder of cases '" + clean_text(directory_.string(), 300) +
                 "' holds more than " + std::to_string(max_folders) +
                 " folders; only the first ones by name are read.");
    const std::string problem = failed ? failed.message() : "";
    if (!problem.empty() && problem != listing_problem_)
        log::warning("host", "the folder of cases cannot be read",
                     {{"folder", directory_.string()}, {"why", problem}});
    bool changed = is_beyond != has_too_many_ || problem != listing_problem_;
    has_too_many_ = is_beyond;
    listing_problem_ = problem;
    if (failed) {
        if (changed)
            publish();
        return;
    }
    for (auto folder = folders_.begin(); folder != folders_.end();) {
        const bool is_gone = !names.contains(folder->first);
        changed = changed || (is_gone && (folder->second.shared || folder->second.is_refused));
        folder = is_gone ? folders_.erase(folder) : std::next(folder);
    }
    for (const std::string& name : names)
        changed = look_at(name, folders_[name]) || changed;
    constexpr int reading_look = 2;
    looks_ = std::min(looks_ + 1, reading_look + 1);
    if (changed || looks_ == reading_look)
        publish();
}

// A case is read once its files have stayed the same from one look to the next: one that is still
// being copied is not complete.
bool CaseShelf::look_at(const std::string& name, Folder& folder) {
    const fs::path path = directory_ / name;
    std::string signature = signature_of(path);
    if (signature != folder.signature) {
        folder.signature = std::move(signature);
        folder.is_read = false;
        return false;
    }
    if (folder.is_read)
        return false;
    folder.is_read = true;
    const bool was_told = folder.shared || folder.is_refused;
    folder.shared.reset();
    folder.patient.reset();
    folder.is_refused = folder.hides_its_patient = false;
    if (folder.signature.empty())
        return was_told;
    std::uint64_t taken = 0;
    for (const auto& [other, known] : folders_)
        taken += known.shared ? known.shared->bytes : 0;
    try {
        folder.shared = cases::share_case(path, net::content_hash, max_content_bytes - taken);
        read_patient(path, folder);
        log::info("host", "case is offered",
                  {log::outside("name", folder.shared->description.name),
                   {"parts", folder.shared->description.parts.size()},
                   {"series", folder.shared->description.series.size()},
                   {"pictures", folder.shared->description.pictures.size()},
                   {"bytes", folder.shared->bytes}});
    } catch (const std::exception& error) {
        log::say(std::string(error.what()) + " This case is not offered.");
        folder.shared.reset();
        folder.is_refused = true;
    }
    return true;
}

void CaseShelf::read_patient(const fs::path& path, Folder& folder) {
    try {
        folder.patient = cases::read_patient_texts(path);
    } catch (const cases::MoreThanOnePatient&) {
        throw;  // the case is not offered
    } catch (const std::exception& error) {
        log::say(std::string(error.what()) + " Nobody is told who the patient is.");
        folder.hides_its_patient = true;
    }
}

// A case of this content may lie in two folders. If they name two patients, neither is known.
void CaseShelf::add_patient(const Folder& folder, std::vector<wire::Patient>& patients) {
    const auto& id = folder.shared->id.bytes;
    wire::Patient patient{Bytes(id.begin(), id.end()), {}, {}, {}, {}};
    if (folder.patient) {
        patient.name = folder.patient->name;
        patient.birth_date = folder.patient->birth_date;
        patient.id = folder.patient->id;
        patient.study_date = folder.patient->study_dates;
    }
    const auto known = std::find_if(patients.begin(), patients.end(), [&](const auto& other) {
        return other.of_case == patient.of_case;
    });
    if (known == patients.end())
        patients.push_back(std::move(patient));
    else if (*known != patient)
        *known = {known->of_case, {}, {}, {}, {}};
}

std::vector<std::string> CaseShelf::problems() const {
    constexpr const char* more = "; the host's log says why.";
    std::vector<std::string> problems;
    if (!listing_problem_.empty())
        problems.push_back(std::string("The folder of cases cannot be read") + more);
    if (has_too_many_)
        problems.push_back("The folder of cases holds more than " + std::to_string(max_folders) +
                           " folders; only the first ones by name are read.");
    const auto refused = std::count_if(folders_.begin(), folders_.end(),
                                       [](const auto& folder) { return folder.second.is_refused; });
    if (refused > 0)
        problems.push_back(std::to_string(refused) + (refused == 1 ? " case is" : " cases are") +
                           " not offered" + more);
    for (const auto& [name, folder] : folders_)
        if (folder.hides_its_patient)
            problems.push_back("Nobody is told who the patient of the case '" +
                               folder.shared->description.name + "' is" + more);
    return problems;
}

void CaseShelf::name_offers() {
    std::erase_if(offered_names_, [&](const auto& known) {
        const auto folder = folders_.find(known.first);
        return folder == folders_.end() || !folder->second.shared ||
               folder->second.shared->description.name != known.second.own;
    });
    const auto is_taken = [&](const std::string& text) {
        return std::any_of(offered_names_.begin(), offered_names_.end(),
                           [&](const auto& known) { return known.second.offered == text; });
    };
    for (const auto& [name, folder] : folders_) {
        if (!folder.shared || offered_names_.contains(name))
            continue;
        const std::string& own = folder.shared->description.name;
        std::string offered = own;
        for (int number = 2; is_taken(offered); ++number)
            offered = own + " (" + std::to_string(number) + ")";
        offered_names_[name] = {own, offered};
    }
}

void CaseShelf::publish() {
    name_offers();
    Offer offer;
    std::vector<session::CaseFacts>& offered = offer.cases;
    std::map<ContentHash, std::shared_ptr<const Bytes>> content;
    for (const auto& [name, folder] : folders_)
        if (folder.shared) {
            offered.push_back(facts_of(*folder.shared));
            offered.back().name = offered_names_.at(name).offered;
            for (const auto& [hash, bytes] : folder.shared->content) {
                content.insert({hash, bytes});
                offer.content[folder.shared->id].insert(hash);
            }
            add_patient(folder, offer.patients);
        }
    offer.problems = problems();
    {
        const std::lock_guard lock(mutex_);
        content_ = std::move(content);
    }
    changed_(std::move(offer));
}

}  // namespace theatron::host
