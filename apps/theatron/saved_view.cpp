// SPDX-License-Identifier: Apache-2.0
#include "saved_view.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "files/file_bytes.h"
#include "files/utc_text.h"
#include "viewer/age_text.h"

namespace theatron::app {
namespace {

constexpr int names_tried = 100;

// Makes the file; false if it exists. Throws Error where none can be made.
bool make_new(const std::filesystem::path& path) {
    if (std::FILE* file = std::fopen(path.c_str(), "wxe")) {
        std::fclose(file);
        return true;
    }
    if (errno == EEXIST)
        return false;
    throw Error("Nothing was saved: " + path.string() + " cannot be written (" +
                std::strerror(errno) + ").");
}

}  // namespace

std::string name_part(const viewer::ShownMoment& moment) {
    std::string part = moment.is_recording ? "-recording" : "";
    if (!moment.is_live)
        part += "-" + viewer::age_text(moment.age_ms) + "-ago";
    std::erase(part, ' ');
    return part;
}

std::string moment_text(const viewer::ShownMoment& moment, UtcTime now) {
    const auto age = std::chrono::microseconds(std::int64_t(moment.age_ms * 1000));
    const std::string ago =
        moment.is_live ? "" : ", " + viewer::age_text(moment.age_ms) + " before it was saved";
    if (moment.is_recording)
        return "of a recording, played " + utc_text(now - age) + ago + ", not live";
    return "captured " + utc_text(now - age) + ago + (moment.is_live ? ", live" : ", not live");
}

std::string save_view(const std::filesystem::path& folder, const std::string& when,
                      const std::string& extension, ByteView bytes) {
    std::string time = files::utc_text(files::utc_now());
    // Some file systems allow no colon in a name.
    std::replace(time.begin(), time.end(), ':', '-');
    try {
        for (int n = 1; n <= names_tried; ++n) {
            const std::filesystem::path path =
                std::filesystem::absolute(folder) /
                ("theatron-" + time + when + (n > 1 ? "-" + std::to_string(n) : "") + extension);
            if (!make_new(path))
                continue;
            try {
                files::write_file(path, bytes);
            } catch (const Error&) {
                std::filesystem::remove(path);
                throw;
            }
            return "Saved: " + path.string();
        }
        return "Nothing was saved: there are too many files of this second.";
    } catch (const std::exception& e) {
        return e.what();
    }
}

}  // namespace theatron::app
