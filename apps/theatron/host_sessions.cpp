// SPDX-License-Identifier: Apache-2.0
#include "host_sessions.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/log.h"
#include "base/log_scope.h"
#include "base/steady_clock.h"
#include "cli/progress.h"
#include "host/host_identity.h"
#include "host/link_book.h"
#include "region_text.h"

namespace theatron::app {

void draw_regions(host::Host& host, const std::vector<std::string>& texts) {
    std::map<std::size_t, codec::strata::Region> regions;
    for (const std::string& text : texts) {
        RegionText part = parse_region(text);
        regions[find_camera(part.camera, host.camera_names())].push_back(std::move(part.polygon));
    }
    for (auto& [camera, region] : regions)
        host.set_region(camera, std::move(region));
}

namespace {

std::unique_ptr<host::Host> open_beside(const host::Host& first, const std::filesystem::path& state,
                                        const SessionFlags& flags,
                                        const capture::Progress& progress) {
    host::SessionOptions options = session_options(flags);
    options.state = host::session_folder(state, options.name);
    auto host = std::make_unique<host::Host>(options, first, progress);
    draw_regions(*host, flags.regions);
    return host;
}

// The sessions of a command line, with that of `first` at the beginning.
void check_names(const std::string& first, const std::vector<SessionFlags>& further) {
    host::check_session_name(first);
    std::vector<std::string> names{first};
    for (const SessionFlags& flags : further) {
        if (std::ranges::find(names, flags.options.name) != names.end())
            throw Error("Two sessions are called '" + flags.options.name +
                        "'; each needs a name of its own.");
        names.push_back(flags.options.name);
    }
    if (names.size() > host::max_sessions)
        throw Error("A host has at most " + std::to_string(host::max_sessions) +
                    " sessions; these are " + std::to_string(names.size()) + ".");
}

}  // namespace

HostSessions::HostSessions(const host::HostOptions& options, const SessionFlags& first,
                           const std::vector<SessionFlags>& further)
    : state_(options.state.empty() ? host::default_state_folder() : options.state),
      first_name_(options.name) {
    check_names(first_name_, further);
    // Its links and its room would become those of another session.
    if (std::filesystem::exists(host::session_folder(state_, first_name_)))
        throw Error("Session '" + first_name_ + "' is a further one in the state folder '" +
                    state_.string() +
                    "', so it cannot be the first: name the session first that was first, or use "
                    "another folder with --state.");
    host::HostOptions with_others = options;
    const auto comes = [&](const std::string& name) {
        with_others.closed.push_back({name, "", host::valid_tokens(state_, name)});
    };
    for (const SessionFlags& flags : further)
        comes(flags.options.name);
    for (const host::KeptSession& kept : host::kept_sessions(state_))
        if (kept.words && !kept.ends)
            comes(kept.name);
    const capture::Progress progress = cli::show_progress();
    first_ = std::make_unique<host::Host>(with_others, progress);
    draw_regions(*first_, first.regions);
    for (const SessionFlags& flags : further) {
        auto session = std::make_unique<Further>();
        session->flags = flags;
        session->opened.host = open_beside(*first_, state_, flags, progress);
        further_.push_back(std::move(session));
    }
    follow();
}

HostSessions::~HostSessions() {
    for (const auto& session : further_)
        if (session->opening.valid())
            session->opened = session->opening.get();
    host::tell_no_sessions(state_);
    further_.clear();
}

std::vector<std::pair<std::string, host::Host*>> HostSessions::open() const {
    std::vector<std::pair<std::string, host::Host*>> open{{first_name_, first_.get()}};
    for (const auto& session : further_)
        if (session->opened.host)
            open.emplace_back(session->flags.options.name, session->opened.host.get());
    return open;
}

void HostSessions::follow() {
    for (const auto& [name, host] : open()) {
        const log::SessionScope scope(name_in_log(name));
        host->follow_links();
    }
    take_opened();
    if (steady_now() < next_look_)
        return;
    next_look_ = steady_now() + 500ms;
    for (const auto& [name, host] : open()) {
        const log::SessionScope scope(name_in_log(name));
        host->follow_filter_files();
    }
    first_->follow_certificates();
    std::string problem;
    try {
        follow_folders();
    } catch (const Error& error) {
        problem = error.what();
    }
    if (!problem.empty() && problem != folder_problem_)
        log::warning("host", "sessions stay as they were", {{"problem", problem}});
    folder_problem_ = std::move(problem);
}

void HostSessions::follow_folders() {
    const std::vector<host::KeptSession> kept = host::kept_sessions(state_);
    for (const host::KeptSession& session : kept)
        take_kept(session);
    std::vector<std::string> gone;  // by hand
    for (const auto& session : further_)
        if (session->is_kept && std::ranges::find(kept, session->flags.options.name,
                                                  &host::KeptSession::name) == kept.end())
            gone.push_back(session->flags.options.name);
    for (const std::string& name : gone) {
        const bool was_open = find(name)->was_open;
        end(name);
        if (was_open)
            first_->note_deleted(name);
    }
    open_due();
    first_->set_closed(closed());
    tell();
}

std::vector<host::ClosedSession> HostSessions::closed() const {
    std::vector<host::ClosedSession> closed;
    for (const auto& session : further_)
        if (const std::string& name = session->flags.options.name; !session->opened.host)
            closed.push_back({name, session->opened.problem, host::valid_tokens(state_, name)});
    return closed;
}

void HostSessions::take_kept(const host::KeptSession& kept) {
    const Further* known = find(kept.name);
    if (kept.ends && !(known && known->opening.valid())) {
        // One that could never be opened has nothing that is deleted.
        const bool was_open = host::has_links(kept.folder);
        end(kept.name);
        host::forget_session(state_, kept.name);
        if (was_open)
            first_->note_deleted(kept.name);
        return;
    }
    if (known || kept.ends || (!kept.words && kept.problem.empty()))
        return;
    auto session = std::make_unique<Further>();
    session->is_kept = true;
    session->was_open = host::has_links(kept.folder);
    try {
        if (!kept.problem.empty())
            throw Error(kept.problem);
        if (kept.name == first_name_)
            throw Error("The first session of this host has the same name.");
        std::vector<std::string> words{"--session", kept.name};
        words.insert(words.end(), kept.words->begin(), kept.words->end());
        session->flags = parse_session(words);
    } catch (const Error& error) {
        session->opened.problem = error.what();
        session->next_try = TimePoint::max();
        log::error("host", "a session cannot be opened",
                   {{"session", kept.name}, {"problem", error.what()}});
    }
    session->flags.options.name = kept.name;
    further_.push_back(std::move(session));
}

void HostSessions::open_due() {
    const TimePoint now = steady_now();
    std::size_t places = open().size();
    for (const auto& session : further_)
        places += session->opening.valid();
    for (const auto& session : further_) {
        if (session->opened.host || session->opening.valid() || session->next_try > now)
            continue;
        if (places >= host::max_sessions) {
            session->opened.problem = "A host has at most " + std::to_string(host::max_sessions) +
                                      " sessions at once; end another one.";
            session->next_try = now + retry_interval;
            continue;
        }
        ++places;
        session->opening = std::async(std::launch::async, [this, flags = session->flags] {
            return open(*first_, state_, flags);
        });
    }
}

HostSessions::Opened HostSessions::open(const host::Host& first, const std::filesystem::path& state,
                                        const SessionFlags& flags) {
    Opened opened;
    try {
        opened.host = open_beside(first, state, flags, {});
    } catch (const std::exception& error) {
        opened.problem = error.what();
    }
    return opened;
}

void HostSessions::take_opened() {
    for (const auto& session : further_) {
        if (!session->opening.valid() ||
            session->opening.wait_for(Duration(0)) != std::future_status::ready)
            continue;
        Opened opened = session->opening.get();
        const std::string& name = session->flags.options.name;
        if (opened.host)
            log::info("host", "session is open", {{"session", name}});
        else if (opened.problem != session->opened.problem)
            log::error("host", "a session cannot be opened",
                       {{"session", name}, {"problem", opened.problem}});
        session->opened = std::move(opened);
        session->was_open = session->was_open || session->opened.host;
        session->next_try = steady_now() + retry_interval;
        next_look_ = {};
    }
}

void HostSessions::end(const std::string& name) {
    const auto found =
        std::ranges::find(further_, name, [](const auto& s) { return s->flags.options.name; });
    if (found == further_.end() || (*found)->opening.valid())
        return;
    if (host::Host* open = (*found)->opened.host.get())
        open->end_by_host();
    further_.erase(found);
    log::info("host", "session has ended", {{"session", name}});
}

HostSessions::Further* HostSessions::find(const std::string& name) {
    const auto found =
        std::ranges::find(further_, name, [](const auto& s) { return s->flags.options.name; });
    return found == further_.end() ? nullptr : found->get();
}

void HostSessions::tell() {
    using State = host::ToldSession::State;
    std::vector<host::ToldSession> now{{first_name_, State::open, ""}};
    for (const auto& session : further_)
        now.push_back({session->flags.options.name,
                       session->opened.host              ? State::open
                       : session->opened.problem.empty() ? State::opening
                                                         : State::failed,
                       session->opened.problem});
    if (now == told_)
        return;
    host::tell_sessions(state_, now);
    told_ = std::move(now);
}

host::PortFigures HostSessions::figures() const {
    host::PortFigures figures{{}, closed()};
    for (const auto& [name, host] : open())
        figures.sessions.push_back(host->figures());
    return figures;
}

std::string HostSessions::room_problem() const {
    for (const auto& [name, host] : open())
        if (std::string problem = host->room_problem(); !problem.empty())
            return problem;
    return "";
}

}  // namespace theatron::app
