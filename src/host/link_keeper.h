// SPDX-License-Identifier: Apache-2.0
// The links by which a session's host admits people. It follows the files of the state folder and
// fails closed: a link whose file is gone or cannot be used is invalid, and the others are judged
// without it. A link that an operator has revoked stays invalid whatever the files say; its file is
// changed again and again until that works.
//
// Safe from any thread; files are read by follow(), make() and revoke() only.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/link_book.h"
#include "session/admission.h"

namespace theatron::host {

class LinkKeeper {
public:
    // Between two attempts to read or change files that could not be.
    static constexpr Duration again_after = std::chrono::seconds(1);

    struct Options {
        std::filesystem::path folder;
        std::string own_token;                  // replaces that of the expert's link; may be empty
        std::optional<TimePoint> roles_expire;  // the links of the roles, in the session's time
    };
    // Throws Error where a role has no link and none can be made.
    explicit LinkKeeper(Options options);

    // Reads the files where they have changed, and again where something failed. True if tokens()
    // may be others.
    bool follow(TimePoint now);
    // The links are as the session knows them since the last follow(): 'theatron link --revoke'
    // waits for that.
    void tell_followed(TimePoint now);

    // Those that are valid, or only expired.
    std::vector<session::Admission::Token> tokens() const;
    std::vector<KnownLink> links() const;
    // Makes a link, as make_link() (link_book.h) does, which is valid at once. Throws Error.
    KnownLink make(wire::Role role, std::optional<files::UtcSeconds> expires,
                   const std::string& label, const std::string& maker);
    // By the names of links: who made those that make() has made.
    std::map<std::string, std::string> makers() const;
    // Makes a link invalid from now on.
    void revoke(const std::string& link, TimePoint now);

    // A sentence for operators; empty: all is well.
    std::string problem() const;

private:
    void load(TimePoint now);
    void save_revocations();

    const std::filesystem::path folder_;
    const std::optional<TimePoint> roles_expire_;

    // By the thread of follow().
    LinkFiles seen_;
    std::optional<LinkFiles> told_;
    TimePoint next_tell_;

    std::mutex making_;         // a link has its maker when follow() finds it
    mutable std::mutex mutex_;  // guards all below
    std::string own_token_;
    std::string replaced_;  // the first token of the expert's file, whose place own_token_ takes
    std::vector<KnownLink> links_;               // those that are valid, or only expired
    std::map<std::string, std::string> makers_;  // by link
    std::vector<std::string> problems_;          // of files
    std::set<std::string> revoked_;              // secrets
    std::set<std::string> unsaved_;              // names of revoked links whose files are as before
    std::string save_problem_;
    TimePoint next_try_;
};

}  // namespace theatron::host
