// SPDX-License-Identifier: Apache-2.0
// By which a person is known again: 128 random bits, kept by the person's own program.
#pragma once

#include <filesystem>

#include "base/bytes.h"

namespace theatron::client {

// The id in this folder, made at first use; readable by its owner only. Where it cannot be kept
// (an empty folder, one that cannot be written to, a damaged file) it is of this run alone.
Bytes load_or_make_person_id(const std::filesystem::path& folder);

}  // namespace theatron::client
