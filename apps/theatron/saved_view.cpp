// SPDX-License-Identifier: Apache-2.0
#include "saved_view.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "files/file_bytes.h"
#include "files/utc_text.h"

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

std::string save_view(const std::filesystem::path& folder, const std::string& extension,
                      ByteView bytes) {
    std::string time = files::utc_text(files::utc_now());
    // Some file systems allow no colon in a name.
    std::replace(time.begin(), time.end(), ':', '-');
    try {
        for (int n = 1; n <= names_tried; ++n) {
            const std::filesystem::path path =
                std::filesystem::absolute(folder) /
                ("theatron-" + time + (n > 1 ? "-" + std::to_string(n) : "") + extension);
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
