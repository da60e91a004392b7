// SPDX-License-Identifier: Apache-2.0
#include "host_config.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "base/error.h"
#include "base/options.h"
#include "base/outside_text.h"
#include "capture/camera_kind.h"
#include "capture/camera_places.h"
#include "files/private_file.h"
#include "host/filter_choice.h"
#include "host/host_identity.h"
#include "host/session_folder.h"
#include "host_flags.h"
#include "net/certificate.h"
#include "net/http.h"
#include "net/listen_address.h"
#include "net/proxies.h"
#include "region_text.h"

namespace theatron::app {
namespace {

constexpr std::size_t shown_of_config = 80;
constexpr std::uint16_t https_port = 443;

// Options of the command line alone.
const std::set<std::string> no_keys = {"help", "config", "check-config"};
// A service runs in another folder than the person who writes the file.
const std::set<std::string> paths = {
    "places", "cases",      "certificate", "key",     "proxy-certificate",
    "audit",  "token-file", "state",       "summary", "recordings"};
const std::set<std::string> read_paths = {
    "places", "cases", "certificate", "key", "proxy-certificate", "token-file"};
// Files that the host makes, in a folder that it does not make.
const std::set<std::string> written_paths = {"audit", "summary"};

bool names_session(const std::string& key) {
    return key == "session" || key == "name";
}

// The options of one session, which may stand again behind another `session`.
bool is_of_session(const std::string& key) {
    SessionFlags flags;
    CLI::App session;
    add_session_options(session, flags);
    return key != "help" && session.get_option_no_throw("--" + key);
}

std::string without_name(std::string sentence, const std::string& key) {
    const std::string name = "--" + key + ": ";
    return sentence.starts_with(name) ? sentence.substr(name.size()) : sentence;
}

void check_path(const ConfigLine& line) {
    namespace fs = std::filesystem;
    if (!paths.contains(line.key) || (line.key == "audit" && line.value == "none"))
        return;
    const std::string shown = "'" + clean_text(line.value, shown_of_config) + "'";
    if (!fs::path(line.value).is_absolute())
        throw Error(shown + " is no absolute path, which begins with /");
    std::error_code error;
    if (read_paths.contains(line.key) &&
        fs::status(line.value, error).type() == fs::file_type::not_found)
        throw Error("there is no " + shown);
    const fs::path folder = fs::path(line.value).parent_path();
    if (written_paths.contains(line.key) && !fs::is_directory(folder, error))
        throw Error("there is no '" + clean_text(folder.string(), shown_of_config) +
                    "'; make this folder, and give it to the host's user");
}

// A camera that is read from a file or a folder. A recording that is missing keeps a host from
// starting; the others may come later.
void check_camera(const std::string& text) {
    capture::check_camera_kind(text);
    const Options options = Options::parse(text);
    const std::set<std::string> of_files = {"folder", "mkv", "recording", "video"};
    if (!of_files.contains(options.kind()) || options.value().find("://") != std::string::npos)
        return;
    const std::string shown = "'" + clean_text(options.value(), shown_of_config) + "'";
    if (!std::filesystem::path(options.value()).is_absolute())
        throw Error(shown + " is no absolute path, which begins with /");
    if (options.kind() == "recording" && access(options.value().c_str(), R_OK) != 0)
        throw Error("Cannot open " + shown + ": " + std::strerror(errno) + ".");
}

// "FILTER" or "CAMERA=FILTER". A file and the parameters of a filter may have '=' in them, too.
void check_filter(const std::string& text) {
    const std::size_t equals = text.find('=');
    const bool names_camera = equals < text.find(':') && !text.starts_with('/');
    (void)host::FilterSource(names_camera ? text.substr(equals + 1) : text).load();
}

// Throws Error if the values of one line cannot be used.
void check_values(const ConfigLine& line, const HostFlags& flags) {
    check_path(line);
    if (line.key == "listen")
        (void)net::listen_address(net::parse_endpoint(flags.listen));
    if (line.key == "public-name")
        (void)net::parse_public_name(flags.port.public_name, https_port);
    if (line.key == "behind-proxy")
        (void)net::Proxies(flags.port.proxies);
    if (line.key == "proxy-certificate")
        (void)net::read_certificate(flags.proxy_certificate, "");
    if (line.key == "token")
        host::check_token(flags.first.options.token);
    // A pipe can be read only once.
    std::error_code error;
    const bool is_file = std::filesystem::is_regular_file(line.value, error);
    if (line.key == "token-file" && is_file)
        (void)host::read_token(flags.token_file);
    if (line.key == "key" && is_file)
        (void)files::read_named_file(line.value, files::Privacy::secret);
    if (line.key == "camera")
        check_camera(line.value);
    if (line.key == "places")
        (void)capture::load_places(flags.first.places);
    if (line.key == "region")
        (void)parse_region(line.value);
    if (line.key == "filter")
        check_filter(line.value);
    if (names_session(line.key))
        host::check_session_name(flags.first.options.name);
    (void)session_options(flags.first);
}

// Empty: the line means something by itself. `words` are those that it stands for.
std::string mistake_of(const ConfigLine& line, std::vector<std::string>& words) {
    HostFlags flags;
    CLI::App app;
    add_host_options(app, flags);
    const std::string name = "--" + line.key;
    const CLI::Option* option = app.get_option_no_throw(name);
    if (!option || no_keys.contains(line.key))
        return "there is no such option; 'theatron host --help' lists them";
    if (option->get_items_expected_max() == 0) {
        if (line.value != "yes" && line.value != "no")
            return "'" + clean_text(line.value, shown_of_config) + "' is neither yes nor no";
        if (line.value == "yes")
            words = {name};
    } else {
        words = {name + "=" + line.value};
    }
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::RequiresError&) {
        // The file as a whole is asked for the other option.
    } catch (const CLI::ParseError& error) {
        return without_name(error.what(), line.key);
    }
    try {
        check_values(line, flags);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

bool is_given(const std::string& key, const std::vector<std::string>& given) {
    const auto is_word = [&](const std::string& name) {
        return std::ranges::any_of(given, [&](const std::string& word) {
            return word == name || word.starts_with(name + "=");
        });
    };
    // Two names of one option.
    return names_session(key) ? is_word("--session") || is_word("--name") : is_word("--" + key);
}

// The option of a session that is given; empty: none is.
std::string given_of_session(const std::vector<std::string>& given) {
    for (const std::string& word : given) {
        const std::string option = word.substr(0, word.find('='));
        if (option.starts_with("--") &&
            (names_session(option.substr(2)) || is_of_session(option.substr(2))))
            return option;
    }
    return "";
}

// Finds what would give a room the cameras of another one. Empty: nothing would.
std::string mistake_of_sessions(const std::vector<ConfigLine>& lines,
                                const std::vector<std::string>& given) {
    const auto in_file = std::ranges::count_if(
        lines, [](const ConfigLine& line) { return names_session(line.key); });
    const std::string option = given_of_session(given);
    if (in_file > 1 && !option.empty())
        return "it has several sessions, so no option of a session may stand on the command "
               "line, where '" +
               option + "' does";
    const auto on_command_line = std::ranges::count_if(
        given, [](const std::string& word) { return is_given("session", {word}); });
    if (on_command_line > 1)
        return "several sessions stand in the file, and not on the command line";
    return "";
}

// Finds lines that are right by themselves and stand twice, or in the wrong place.
class Order {
public:
    explicit Order(const std::vector<ConfigLine>& lines) {
        for (const ConfigLine& line : lines)
            sessions_ += names_session(line.key);
        add_host_options(app_, flags_);
    }

    // Lines one after the other. Empty: it may stand here.
    std::string mistake_of(const ConfigLine& line) {
        if (names_session(line.key))
            return mistake_of_session(line);
        const bool of_session = is_of_session(line.key);
        if (of_session && sessions_ > 1 && session_ == 0)
            return "with several sessions it stands behind the 'session' that it is for";
        if (!of_session && session_ > 1)
            return "it is for all sessions, so it stands before the second 'session'";
        const bool repeats = app_.get_option("--" + line.key)->get_items_expected_max() > 1;
        auto& seen = of_session ? seen_in_session_ : seen_;
        const auto [first, is_new] = seen.emplace(line.key, line.line);
        return is_new || repeats ? ""
                                 : "it stands already in line " + std::to_string(first->second);
    }

private:
    std::string mistake_of_session(const ConfigLine& line) {
        ++session_;
        seen_in_session_.clear();
        if (session_ > int(host::max_sessions))
            return "a host has at most " + std::to_string(host::max_sessions) + " sessions";
        const auto [first, is_new] = names_.emplace(line.value, line.line);
        return is_new ? ""
                      : "the session in line " + std::to_string(first->second) +
                            " has the same name; each needs a name of its own";
    }

    CLI::App app_;
    HostFlags flags_;
    int sessions_ = 0, session_ = 0;
    std::map<std::string, int> seen_, seen_in_session_;  // lines by key
    std::map<std::string, int> names_;                   // lines by the name of a session
};

// Adds regions for which their session has no camera. A name is known once the cameras are open.
void check_regions(const std::vector<ConfigLine>& lines, HostConfig& config,
                   const std::vector<std::string>& given) {
    if (is_given("camera", given))
        return;
    const auto is_next = [](const ConfigLine& line) { return names_session(line.key); };
    for (auto begin = lines.begin(); begin != lines.end();) {
        const auto end = std::find_if(std::next(begin), lines.end(), is_next);
        const auto cameras =
            std::count_if(begin, end, [](const auto& line) { return line.key == "camera"; });
        for (auto line = begin; line != end; ++line)
            if (line->key == "region" && cameras == 0)
                config.mistakes.push_back(
                    {line->line, "region", "it needs 'camera' in its session, too"});
        begin = end;
    }
}

// Adds mistakes of the file as a whole.
void check_together(const std::vector<ConfigLine>& lines, HostConfig& config,
                    const std::vector<std::string>& given) {
    const auto value_of = [&](const char* key) -> const ConfigLine* {
        const auto found = std::ranges::find(lines, key, &ConfigLine::key);
        return found == lines.end() ? nullptr : &*found;
    };
    const auto need = [&](const char* key, const char* other) {
        const ConfigLine* line = value_of(key);
        if (line && line->value != "no" && !value_of(other) && !is_given(other, given))
            config.mistakes.push_back(
                {line->line, key, "it needs '" + std::string(other) + "', too"});
    };
    check_regions(lines, config, given);
    need("certificate", "key");
    need("key", "certificate");
    need("hsts", "certificate");
    need("behind-proxy", "public-name");
    need("behind-proxy", "proxy-certificate");
    need("proxy-certificate", "behind-proxy");
    const ConfigLine* link_host = value_of("link-host");
    if (link_host && (value_of("public-name") || is_given("public-name", given)))
        config.mistakes.push_back({link_host->line, "link-host",
                                   "'public-name' is also the name in the links; leave this out"});
    const ConfigLine *token = value_of("token"), *token_file = value_of("token-file");
    if (token && token_file)
        config.mistakes.push_back({token_file->line, "token-file", "'token' stands there, too"});
    const ConfigLine *certificate = value_of("certificate"), *key = value_of("key");
    if (certificate && key) {
        try {
            (void)net::read_certificate(certificate->value, key->value);
        } catch (const Error& error) {
            config.mistakes.push_back({certificate->line, "certificate", error.what()});
        }
    }
}

}  // namespace

HostConfig host_config(std::string_view text, const std::vector<std::string>& given,
                       bool is_public) {
    ConfigText parsed = parse_config(text);
    HostConfig config{{}, std::move(parsed.mistakes)};
    if (std::string mistake = mistake_of_sessions(parsed.lines, given); !mistake.empty())
        config.mistakes.push_back({0, "", std::move(mistake)});
    Order order(parsed.lines);
    std::vector<ConfigLine> good;
    for (const ConfigLine& line : parsed.lines) {
        std::vector<std::string> words;
        std::string mistake = mistake_of(line, words);
        if (mistake.empty())
            mistake = order.mistake_of(line);
        if (mistake.empty() && line.key == "token" && is_public)
            mistake =
                "others may read this file; 'chgrp theatron' and 'chmod 640' it, or use "
                "'token-file'";
        if (!mistake.empty()) {
            config.mistakes.push_back({line.line, line.key, mistake});
            continue;
        }
        good.push_back(line);
        if (!is_given(line.key, given))
            config.words.insert(config.words.end(), words.begin(), words.end());
    }
    // A line that is wrong may be the one that another one needs.
    if (config.mistakes.empty())
        check_together(good, config, given);
    std::ranges::stable_sort(config.mistakes, {}, &ConfigMistake::line);
    return config;
}

namespace {

struct ConfigFile {
    std::string text;
    bool is_public = false;
};

// Throws ConfigError.
ConfigFile read_config(const std::string& file, const std::string& shown) {
    // A pipe is not waited for.
    const int in = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (in < 0)
        throw ConfigError("Cannot open the configuration '" + shown + "': " + std::strerror(errno) +
                          (errno == EACCES
                               ? "; the host's user must be able to read it: chgrp theatron and "
                                 "chmod 640."
                               : "."));
    struct stat facts {};
    const bool is_file = fstat(in, &facts) == 0 && S_ISREG(facts.st_mode);
    ConfigFile config{std::string(max_config_bytes + 1, '\0'), (facts.st_mode & S_IROTH) != 0};
    std::size_t size = 0;
    bool is_read = is_file;
    while (is_read && size < config.text.size()) {
        const ssize_t count = read(in, config.text.data() + size, config.text.size() - size);
        if (count == 0)
            break;
        if (count > 0)
            size += std::size_t(count);
        else if (errno != EINTR)
            is_read = false;
    }
    close(in);
    if (!is_read)
        throw ConfigError("The configuration '" + shown + "' is no file that can be read.");
    if (facts.st_uid != geteuid() && facts.st_uid != 0)
        throw ConfigError("The configuration '" + shown + "' belongs to another user (number " +
                          std::to_string(facts.st_uid) +
                          "), who could change it; make it root's with chown.");
    if (facts.st_mode & (S_IWGRP | S_IWOTH))
        throw ConfigError("Others may write to the configuration '" + shown +
                          "'; take that away with: chmod go-w '" + shown + "'.");
    config.text.resize(size);
    return config;
}

}  // namespace

std::vector<std::string> with_config(const std::vector<std::string>& arguments) {
    std::string file;
    bool names_file = false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        constexpr std::string_view name = "--config", joined = "--config=";
        if (arguments[i] == name && i + 1 < arguments.size())
            file = arguments[i + 1];
        else if (arguments[i].starts_with(joined))
            file = arguments[i].substr(joined.size());
        else
            continue;
        names_file = true;
    }
    if (!names_file)
        return arguments;
    const std::string shown = clean_text(file, shown_of_config);
    const ConfigFile content = read_config(file, shown);
    const HostConfig config = host_config(content.text, arguments, content.is_public);
    if (!config.mistakes.empty())
        throw ConfigError("The configuration cannot be used:\n" +
                          mistakes_text(shown, config.mistakes));
    std::vector<std::string> words = arguments;
    words.insert(words.end(), config.words.begin(), config.words.end());
    return words;
}

}  // namespace theatron::app
