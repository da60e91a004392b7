// SPDX-License-Identifier: Apache-2.0
#include "host/session_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/outside_text.h"
#include "base/shown_name.h"
#include "files/json_text.h"
#include "files/private_file.h"
#include "host/host_identity.h"
#include "host/link_book.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

constexpr const char *words_file = "session.json", *end_file = "ends", *told_file = "sessions.json";
constexpr std::string_view hex_digits = "0123456789ABCDEF";
constexpr const char* state_texts[] = {"opening", "open", "failed"};

fs::path folder_of_sessions(const fs::path& state) {
    return state / "sessions";
}

bool is_plain(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '_';
}

// Throws Error.
std::vector<std::string> parse_words(const fs::path& path, const std::string& text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    std::vector<std::string> words;
    const bool is_list = json.is_object() && json.contains("words") && json["words"].is_array() &&
                         json["words"].size() <= max_session_words;
    if (is_list)
        for (const auto& word : json["words"])
            if (word.is_string())
                words.push_back(word.get<std::string>());
    if (!is_list || words.size() != json["words"].size())
        throw Error("'" + path.string() +
                    "' does not say how the session was created; end the session and create it "
                    "again.");
    return words;
}

KeptSession read_session(const fs::path& folder, std::string name) {
    KeptSession session{std::move(name), folder, std::nullopt, false, ""};
    std::error_code none;
    session.ends = fs::exists(folder / end_file, none);
    try {
        if (const auto text = files::read_private_file(folder / words_file, files::Privacy::secret))
            session.words = parse_words(folder / words_file, *text);
    } catch (const Error& error) {
        session.problem = error.what();
    }
    return session;
}

}  // namespace

void check_session_name(const std::string& name) {
    if (name.empty() || name.size() > max_session_name)
        throw Error("A session's name has 1 to " + std::to_string(max_session_name) +
                    " bytes; this one has " + std::to_string(name.size()) + ".");
    if (name != clean_name(name, max_session_name))
        throw Error(
            "A session's name is text on one line, without spaces at its ends and without "
            "characters that nobody sees.");
}

std::string folder_name(const std::string& session) {
    std::string folder;
    for (const char c : session)
        if (is_plain(c)) {
            folder += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            folder += {'%', hex_digits[byte >> 4], hex_digits[byte & 15]};
        }
    return folder;
}

std::optional<std::string> session_of_folder(const std::string& folder) {
    std::string session;
    for (std::size_t i = 0; i < folder.size(); ++i) {
        if (folder[i] != '%') {
            session += folder[i];
            continue;
        }
        const auto digit = [&](std::size_t at) {
            return at < folder.size() ? hex_digits.find(folder[at]) : std::string_view::npos;
        };
        const std::size_t high = digit(i + 1), low = digit(i + 2);
        if (high == std::string_view::npos || low == std::string_view::npos)
            return std::nullopt;
        session += char(high << 4 | low);
        i += 2;
    }
    // One spelling per name.
    if (folder_name(session) != folder)
        return std::nullopt;
    try {
        check_session_name(session);
    } catch (const Error&) {
        return std::nullopt;
    }
    return session;
}

fs::path session_folder(const fs::path& state, const std::string& session) {
    check_session_name(session);
    return folder_of_sessions(state) / folder_name(session);
}

std::vector<KeptSession> kept_sessions(const fs::path& state) {
    std::vector<KeptSession> sessions;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_of_sessions(state), none))
        if (auto name = session_of_folder(entry.path().filename().string()))
            sessions.push_back(read_session(entry.path(), std::move(*name)));
    std::ranges::sort(sessions, {}, &KeptSession::name);
    return sessions;
}

void create_session(const fs::path& state, const std::string& session,
                    const std::vector<std::string>& words) {
    check_session_name(session);
    std::vector<std::string> names;
    for (const ToldSession& there : told_sessions(state))
        names.push_back(there.name);
    const std::vector<KeptSession> kept = kept_sessions(state);
    for (const KeptSession& there : kept)
        names.push_back(there.name);
    if (std::ranges::find(names, session) != names.end() ||
        fs::exists(session_folder(state, session)))
        throw Error("There is a session '" + session +
                    "' already; end it first, or take another name.");
    // Somebody would enter or end the other one by mistake.
    if (const auto other = std::ranges::find(names, look_of(session), look_of);
        other != names.end())
        throw Error("The session '" + *other + "' has nearly the same name; take another one.");
    if (kept.size() + 1 >= max_sessions)
        throw Error("A host has at most " + std::to_string(max_sessions) +
                    " sessions; end one of them first.");
    keep_session(state, session, words);
}

void keep_session(const fs::path& state, const std::string& session,
                  const std::vector<std::string>& words) {
    const fs::path folder = session_folder(state, session);
    if (words.size() > max_session_words)
        throw Error("A session is created with at most " + std::to_string(max_session_words) +
                    " words of options.");
    const bool is_new = !fs::exists(folder);
    try {
        files::open_private_folder(folder);
        files::write_private_file(folder / words_file, files::json_text({{"words", words}}) + "\n");
    } catch (const Error&) {
        // A disk may be full; nothing of the session is to stay.
        std::error_code ignored;
        if (is_new)
            fs::remove_all(folder, ignored);
        throw;
    }
}

void ask_for_end(const fs::path& state, const std::string& session) {
    files::write_private_file(session_folder(state, session) / end_file, "");
}

// The words go first: a session that is half removed must not come back.
void forget_session(const fs::path& state, const std::string& session) {
    const fs::path folder = session_folder(state, session);
    std::error_code problem;
    fs::remove(folder / words_file, problem);
    fs::remove_all(folder, problem);
    if (problem)
        throw Error("Cannot remove '" + folder.string() + "': " + problem.message() +
                    "; remove it by hand.");
}

std::vector<std::string> valid_tokens(const fs::path& state, const std::string& session) {
    std::vector<std::string> tokens;
    const fs::path folder = session_folder(state, session);
    // Their files may be made at this moment, when the session is opened.
    if (!has_links(folder))
        return tokens;
    for (const KnownLink& link : load_links(folder).links)
        if (!link.has_expired(files::utc_now()))
            tokens.push_back(link.token);
    return tokens;
}

const char* text_of(ToldSession::State state) {
    return state_texts[std::size_t(state)];
}

void tell_sessions(const fs::path& state, const std::vector<ToldSession>& sessions) {
    nlohmann::json list = nlohmann::json::array();
    for (const ToldSession& session : sessions)
        list.push_back({{"name", session.name},
                        {"state", text_of(session.state)},
                        {"problem", session.problem}});
    files::write_private_file(state / told_file, files::json_text({{"sessions", list}}) + "\n");
}

void tell_no_sessions(const fs::path& state) noexcept {
    std::error_code none;
    fs::remove(state / told_file, none);
}

std::vector<ToldSession> told_sessions(const fs::path& state) {
    const auto text = files::read_private_file(state / told_file, files::Privacy::secret);
    // A host that was killed has left its file.
    if (!text || !is_host_running(state))
        return {};
    std::vector<ToldSession> sessions;
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    if (json.is_object() && json.contains("sessions") && json["sessions"].is_array())
        for (const auto& entry : json["sessions"]) {
            const auto text_of = [&](const char* field) {
                return entry.contains(field) && entry[field].is_string()
                           ? entry[field].get<std::string>()
                           : std::string();
            };
            ToldSession session;
            session.name = text_of("name");
            session.problem = text_of("problem");
            const auto told = std::ranges::find(state_texts, text_of("state"));
            if (told != std::end(state_texts))
                session.state = ToldSession::State(told - std::begin(state_texts));
            sessions.push_back(std::move(session));
        }
    return sessions;
}

fs::path find_session_folder(const fs::path& state, const std::string& session) {
    const std::vector<ToldSession> told = told_sessions(state);
    if (!told.empty() && told.front().name == session)
        return state;
    std::string names = told.empty() ? "" : "'" + told.front().name + "'";
    for (const KeptSession& kept : kept_sessions(state)) {
        if (kept.name == session)
            return kept.folder;
        names += (names.empty() ? "'" : ", '") + kept.name + "'";
    }
    throw Error("There is no session '" + clean_text(session, max_session_name) + "'" +
                (names.empty() ? "" : "; there are " + names) + ".");
}

}  // namespace theatron::host
