// SPDX-License-Identifier: Apache-2.0
#include "files/state_folder.h"

#include <cstdlib>

namespace theatron::files {

std::filesystem::path state_folder() {
    const auto folder_in = [](const char* variable) {
        const char* set = std::getenv(variable);
        const std::filesystem::path folder = set ? set : "";
        return folder.is_absolute() ? folder : std::filesystem::path();
    };
    if (const auto state = folder_in("XDG_STATE_HOME"); !state.empty())
        return state / "theatron";
    if (const auto home = folder_in("HOME"); !home.empty())
        return home / ".local/state/theatron";
    return {};
}

}  // namespace theatron::files
