// SPDX-License-Identifier: Apache-2.0
// The cases that a host offers: each folder with a case in one directory. A thread of low priority
// watches the directory, reads new cases, and keeps their shareable content in memory, so that a
// file that changes meanwhile never gives two participants different organs.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/time.h"
#include "cases/patient_texts.h"
#include "cases/share_case.h"
#include "session/case_objects.h"
#include "session/offered_cases.h"
#include "wire/control.h"

namespace theatron::host {

class CaseShelf {
public:
    static constexpr Duration interval = std::chrono::milliseconds(200);
    // Bytes of all cases together; a case beyond it is not offered.
    static constexpr std::uint64_t max_content_bytes = std::uint64_t(2) << 30;
    // Folders of the directory that are read; the first ones by name.
    static constexpr std::size_t max_folders = 64;

    // The cases, their patients as far as they are known, and a sentence for each thing that the
    // operator of the host should mend. Sentences name no folder, since folders are often named
    // after patients; the log does.
    struct Offer {
        std::vector<session::CaseFacts> cases;
        std::vector<wire::Patient> patients;
        session::OfferedCases::Content content;
        std::vector<std::string> problems;
    };
    // This is offered from now on: once the folders were read for the first time, and after each
    // change. From the thread of the shelf.
    using Changed = std::function<void(Offer)>;

    // Throws Error with one sentence if there is no such directory.
    CaseShelf(std::filesystem::path directory, Changed changed);
    ~CaseShelf();

    // From any thread. Null if no offered case has this content.
    std::shared_ptr<const Bytes> content(const ContentHash& hash) const;

private:
    struct Folder {
        std::string signature;  // sizes, times and rights of its files
        bool is_read = false;   // in this state of its files
        std::optional<cases::ShareableCase> shared;
        std::optional<cases::PatientTexts> patient;
        bool is_refused = false;         // it cannot be offered
        bool hides_its_patient = false;  // its file of identifiers cannot be read
    };
    void run();
    void look();
    std::vector<std::string> problems() const;
    // True if what is offered changes.
    bool look_at(const std::string& name, Folder& folder);
    static void read_patient(const std::filesystem::path& path, Folder& folder);
    static void add_patient(const Folder& folder, std::vector<wire::Patient>& patients);
    // Gives each offered folder a name of its own, since people choose by name, and leaves it the
    // name that it has: nobody opens another patient than the one who had this name a minute ago.
    void name_offers();
    void publish();

    struct OfferedName {
        std::string own, offered;
    };

    const std::filesystem::path directory_;
    const Changed changed_;
    std::map<std::string, Folder> folders_;             // the thread's only; by name
    std::map<std::string, OfferedName> offered_names_;  // the thread's only; by the folder's name
    std::string listing_problem_;                       // the thread's only
    bool has_too_many_ = false;                         // the thread's only
    int looks_ = 0;                                     // the thread's only; the second one reads
    mutable std::mutex mutex_;                          // guards all below
    std::condition_variable stop_;
    std::map<ContentHash, std::shared_ptr<const Bytes>> content_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host
