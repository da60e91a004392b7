// SPDX-License-Identifier: Apache-2.0
#include "certificate_place.h"

#include <pwd.h>
#include <unistd.h>

#include "base/config_text.h"
#include "base/error.h"
#include "base/outside_text.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* config_folder = "/etc/theatron";
constexpr const char* host_user = "theatron";
constexpr std::size_t shown_of_path = 120;

// The only configuration of this machine. Throws Error.
fs::path only_config() {
    std::vector<fs::path> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(config_folder, error))
        if (entry.path().extension() == ".conf")
            found.push_back(entry.path());
    if (found.size() == 1)
        return found.front();
    throw Error(error ? std::string("There is no folder ") + config_folder +
                            " that can be read, so say for which host: --config FILE."
                : found.empty() ? std::string("There is no configuration in ") + config_folder +
                                      ", so say for which host: --config FILE."
                                : std::string("There are several hosts in ") + config_folder +
                                      ", so say for which one: --config FILE.");
}

}  // namespace

CertificatePlace certificate_place(const fs::path& file, std::string_view text) {
    CertificatePlace place;
    place.config = file;
    place.certificate = fs::path(file).replace_extension(".pem");
    place.key = fs::path(file).replace_extension(".key");
    bool names_certificate = false, names_key = false;
    for (const ConfigLine& line : parse_config(text).lines) {
        if (line.key == "certificate" && fs::path(line.value).is_absolute()) {
            place.certificate = line.value;
            names_certificate = true;
        } else if (line.key == "key" && fs::path(line.value).is_absolute()) {
            place.key = line.value;
            names_key = true;
        } else if (line.key == "public-name") {
            place.name = line.value.substr(0, line.value.find(':'));
        } else if (line.key == "state") {
            place.state = line.value;
        } else if (line.key == "behind-proxy") {
            place.is_behind_proxy = true;
        }
    }
    place.is_named = names_certificate && names_key;
    if (!names_certificate)
        place.missing_lines.push_back("certificate = " + place.certificate.string());
    if (!names_key)
        place.missing_lines.push_back("key = " + place.key.string());
    return place;
}

CertificatePlace find_certificate_place(const std::string& file) {
    const fs::path config = file.empty() ? only_config() : fs::absolute(file);
    const std::string shown = "'" + clean_text(config.string(), shown_of_path) + "'";
    std::error_code error;
    if (!fs::is_regular_file(config, error))
        throw Error("There is no configuration " + shown + " that can be read.");
    // The administrator's own file, which only root or the host's user may have written.
    const auto text = files::read_private_file(config, files::Privacy::readable, max_config_bytes,
                                               certificate_owner("", config));
    if (!text)
        throw Error("There is no configuration " + shown + ".");
    CertificatePlace place = certificate_place(config, *text);
    if (place.state.empty() && config.parent_path() == config_folder)
        place.state = "/var/lib/theatron/" + config.stem().string();  // as theatron-host@ does
    return place;
}

std::optional<files::Owner> certificate_owner(const std::string& user, const fs::path& key) {
    const bool is_root = geteuid() == 0;
    const bool is_service =
        fs::absolute(key).string().starts_with(std::string(config_folder) + "/");
    if (user.empty() && !(is_root && is_service))
        return std::nullopt;
    const passwd* found = getpwnam(user.empty() ? host_user : user.c_str());
    if (!found && user.empty())
        return std::nullopt;
    if (!found)
        throw Error("This machine has no user '" + clean_text(user, shown_of_path) +
                    "'; --user names the one that the host runs as.");
    if (found->pw_uid == geteuid())
        return std::nullopt;
    if (!is_root)
        throw Error("Only root can make files of the user '" + clean_text(user, shown_of_path) +
                    "'; say it as that user, or as root.");
    return files::Owner{found->pw_uid, found->pw_gid};
}

}  // namespace theatron::app
