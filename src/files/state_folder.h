// SPDX-License-Identifier: Apache-2.0
// The folder for files that a program keeps between runs.
#pragma once

#include <filesystem>

namespace theatron::files {

// The user's folder for Theatron's state: below $XDG_STATE_HOME, else below $HOME. Empty where the
// environment names neither: a folder that everybody may write to, such as /tmp, is none, since
// another user could put keys there.
std::filesystem::path state_folder();

}  // namespace theatron::files
