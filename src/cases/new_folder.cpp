// SPDX-License-Identifier: Apache-2.0
#include "cases/new_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/outside_text.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) {
    return "'" + clean_text(path.string(), 300) + "'";
}

[[noreturn]] void refuse_present(const fs::path& folder) {
    throw Error(quoted(folder) + " is there already; name a folder that is not, or remove it.");
}

[[noreturn]] void refuse(const fs::path& folder, int reason) {
    throw Error("Cannot make the folder " + quoted(folder) + ": " + std::strerror(reason) + ".");
}

// Without the slash that a shell's completion leaves at the end.
fs::path named(const fs::path& folder) {
    const fs::path normal = folder.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

NewFolder::NewFolder(const fs::path& folder) : folder_(named(folder)) {
    require_new_folder(folder_);
    const fs::path parent = folder_.has_parent_path() ? folder_.parent_path() : ".";
    std::error_code failed;
    fs::create_directories(parent, failed);
    std::string name = (parent / ".theatron-case-XXXXXX").string();
    if (failed || !mkdtemp(name.data()))
        refuse(folder_, failed ? failed.value() : errno);
    making_ = name;
    // A folder like others: mkdtemp() makes one for its user only.
    const mode_t mask = umask(0);
    umask(mask);
    fs::permissions(making_, fs::perms(0777 & ~mask), failed);
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (!making_.empty())
        fs::remove_all(making_, ignored);
}

void NewFolder::keep() {
    if (renameat2(AT_FDCWD, making_.c_str(), AT_FDCWD, folder_.c_str(), RENAME_NOREPLACE) == 0) {
        making_.clear();
        return;
    }
    if (errno == EEXIST)
        refuse_present(folder_);
    // Some file systems of networks have no such rename; a plain one replaces an empty folder only.
    if (errno != EINVAL || std::rename(making_.c_str(), folder_.c_str()) != 0)
        refuse(folder_, errno);
    making_.clear();
}

void require_new_folder(const fs::path& folder) {
    std::error_code failed;
    if (fs::exists(fs::symlink_status(named(folder), failed)))
        refuse_present(folder);
}

}  // namespace theatron::cases
