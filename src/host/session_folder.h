// SPDX-License-Identifier: Apache-2.0
// The further sessions of a host, each with a state folder of its own below that of the host
// (docs/keys.md): STATE/sessions/NAME. The first session uses STATE itself.
//
// 'theatron session' makes and ends sessions by these files, and a running host follows them: who
// may write into the host's state folder may do so, and nobody else.
//
// All functions throw Error, one sentence that says what to do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace theatron::host {

// Sessions of one host, its first one included; one more is refused.
inline constexpr std::size_t max_sessions = 16;
// Bytes of a session's name, so that its folder has a name that every file system takes.
inline constexpr std::size_t max_session_name = 60;
// Words of a kept session, and bytes of their file; more is refused.
inline constexpr std::size_t max_session_words = 400;

// Throws Error for a name that cannot be shown on one line, or is empty or too long.
void check_session_name(const std::string& name);

// Other characters than ASCII letters, digits, '-' and '_' are written as %XX.
std::string folder_name(const std::string& session);
// Nullopt for a text that folder_name() never gives.
std::optional<std::string> session_of_folder(const std::string& folder);
std::filesystem::path session_folder(const std::filesystem::path& state,
                                     const std::string& session);

struct KeptSession {
    std::string name;
    std::filesystem::path folder;
    // The options with which it was created, as words of a command line. Nullopt: it was not
    // created, but named on the command line of a host.
    std::optional<std::vector<std::string>> words;
    bool ends = false;    // somebody has asked for its end
    std::string problem;  // a sentence; its file of words cannot be used
};

// All that have a folder, by name.
std::vector<KeptSession> kept_sessions(const std::filesystem::path& state);

// Keeps a new session with these words; a running host opens it. Throws Error, also where another
// one has the same name, or nearly the same.
void create_session(const std::filesystem::path& state, const std::string& session,
                    const std::vector<std::string>& words);
// Keeps a session with these words, from now on. Another one of the same name is replaced.
void keep_session(const std::filesystem::path& state, const std::string& session,
                  const std::vector<std::string>& words);
// Asks the running host to end a session for good. It has a folder.
void ask_for_end(const std::filesystem::path& state, const std::string& session);
// Removes a session with its links and its room. No host uses it.
void forget_session(const std::filesystem::path& state, const std::string& session);

// The tokens of the links of this session that are valid now. Files that cannot be used are passed
// over: whoever opens the session says so.
std::vector<std::string> valid_tokens(const std::filesystem::path& state,
                                      const std::string& session);

// The sessions of a running host, as it tells 'theatron session': the first one first.
struct ToldSession {
    enum class State { opening, open, failed };
    std::string name;
    State state = State::opening;
    std::string problem;  // a sentence; of one that failed
    bool operator==(const ToldSession&) const = default;
};
const char* text_of(ToldSession::State state);  // "opening", "open", "failed"
void tell_sessions(const std::filesystem::path& state, const std::vector<ToldSession>& sessions);
// Empty if none were told, or no host runs with this state folder.
std::vector<ToldSession> told_sessions(const std::filesystem::path& state);
void tell_no_sessions(const std::filesystem::path& state) noexcept;

// The state folder of the session of this name, which may be the first one of a running host.
// Throws Error if there is none.
std::filesystem::path find_session_folder(const std::filesystem::path& state,
                                          const std::string& session);

}  // namespace theatron::host
