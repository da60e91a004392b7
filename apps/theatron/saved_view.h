// SPDX-License-Identifier: Apache-2.0
// Files of what a window shows.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/utc.h"
#include "viewer/shown_moment.h"

namespace theatron::app {

// For the name of a file of this moment: "-31s-ago", "-recording"; empty: it is the present.
std::string name_part(const viewer::ShownMoment& moment);
// For its content: "captured 2026-11-23T14:40:29.000Z, live", "captured 2026-11-23T14:40:29.000Z,
// 31 s before it was saved, not live". `now` is when it is saved.
std::string moment_text(const viewer::ShownMoment& moment, UtcTime now);

// Writes the bytes into a new file in this folder, whose name has the time in UTC, this part of
// name_part() and this extension (".png"). No file is replaced. Returns a sentence for the person:
// the file's path, or what is wrong.
std::string save_view(const std::filesystem::path& folder, const std::string& when,
                      const std::string& extension, ByteView bytes);

}  // namespace theatron::app
