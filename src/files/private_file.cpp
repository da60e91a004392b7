// SPDX-License-Identifier: Apache-2.0
#include "files/private_file.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/descriptor.h"
#include "base/error.h"

namespace theatron::files {
namespace {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) {
    return "'" + path.string() + "'";
}

[[noreturn]] void refuse(const char* what, const fs::path& path) {
    const int reason = errno;
    const char* const advice = reason == ENOSPC || reason == EDQUOT
                                   ? "; delete files there, or name another place."
                                   : "; make its folder writable, or name another place.";
    throw Error(std::string("Cannot ") + what + " " + quoted(path) + ": " + std::strerror(reason) +
                advice);
}

// "theatron (number 997)", or the number alone where the user has no name.
std::string user_text(uid_t user) {
    const std::string number = "number " + std::to_string(user);
    passwd entry{};
    passwd* known = nullptr;
    char texts[4096];
    (void)getpwuid_r(user, &entry, texts, sizeof(texts), &known);
    return known ? std::string(known->pw_name) + " (" + number + ")" : number;
}

[[noreturn]] void refuse_reading(const fs::path& path) {
    const int reason = errno;
    throw Error("Cannot read " + quoted(path) + ": " + std::strerror(reason) +
                (reason == EACCES
                     ? "; this program runs as the user " + user_text(geteuid()) +
                           ": run it as the file's owner, or give that user the file with chown."
                     : std::string(".")));
}

void require_own(const struct stat& info, const fs::path& path,
                 std::optional<Owner> owner = std::nullopt) {
    if (info.st_uid != geteuid() && info.st_uid != 0 && !(owner && info.st_uid == owner->user))
        throw Error(quoted(path) + " belongs to another user, " + user_text(info.st_uid) +
                    ", who could change it; run this as that user (root does so with runuser -u "
                    "USER -- COMMAND), or name another folder with --state.");
}

bool write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(file, text.data(), text.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return false;
        text.remove_prefix(std::size_t(count));
    }
    return true;
}

// A name that is new, or gone, is durable only after its folder has been synchronised.
bool synchronise_folder_of(const fs::path& path) {
    const fs::path parent = path.parent_path();
    const Descriptor folder(
        open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return folder.is_open() && fsync(folder.get()) == 0;
}

}  // namespace

void open_private_folder(const fs::path& folder) {
    fs::path made;
    for (const fs::path& part : folder) {
        made /= part;
        struct stat there {};
        if (stat(made.c_str(), &there) != 0 && mkdir(made.c_str(), 0700) != 0 && errno != EEXIST)
            refuse("make the folder", made);
    }
    struct stat info {};
    if (stat(folder.c_str(), &info) != 0)
        refuse("use the folder", folder);
    if (!S_ISDIR(info.st_mode))
        throw Error(quoted(folder) + " is not a folder; name another with --state.");
    require_own(info, folder);
    if (info.st_mode & (S_IWGRP | S_IWOTH))
        throw Error("Others may write into the folder " + quoted(folder) +
                    " and replace its keys; take that away with: chmod go-w " + quoted(folder) +
                    ".");
}

namespace {

std::optional<std::string> read_text(const fs::path& path, bool is_named, Privacy privacy,
                                     std::size_t max_bytes, std::optional<Owner> owner) {
    // A pipe that nobody writes to is opened at once, so that it can be refused.
    const Descriptor file(
        open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | (is_named ? 0 : O_NONBLOCK)));
    if (!file.is_open() && errno == ENOENT)
        return std::nullopt;
    struct stat info {};
    if (!file.is_open() || fstat(file.get(), &info) != 0)
        refuse_reading(path);
    if (!is_named && !S_ISREG(info.st_mode))
        throw Error(quoted(path) + " is no file; remove it, or put a file in its place.");
    if (S_ISREG(info.st_mode)) {
        require_own(info, path, owner);
        if (info.st_mode & (S_IWGRP | S_IWOTH))
            throw Error("Others may write to " + quoted(path) +
                        "; take that away with: chmod go-w " + quoted(path) + ".");
        if (privacy == Privacy::secret && (info.st_mode & (S_IRGRP | S_IROTH)))
            throw Error("Others may read the secret in " + quoted(path) +
                        "; take that away with: chmod 600 " + quoted(path) +
                        ", or delete it if somebody may have read it.");
    }
    std::string text(max_bytes + 1, '\0');
    std::size_t size = 0;
    while (size < text.size()) {
        const ssize_t count = read(file.get(), text.data() + size, text.size() - size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            refuse_reading(path);
        if (count == 0)
            break;
        size += std::size_t(count);
    }
    if (size > max_bytes)
        throw Error(quoted(path) + " is too long for a key or a token.");
    text.resize(size);
    return text;
}

}  // namespace

std::optional<std::string> read_private_file(const fs::path& path, Privacy privacy,
                                             std::size_t max_bytes, std::optional<Owner> owner) {
    return read_text(path, false, privacy, max_bytes, owner);
}

std::optional<std::string> read_named_file(const fs::path& path, Privacy privacy,
                                           std::size_t max_bytes, std::optional<Owner> owner) {
    return read_text(path, true, privacy, max_bytes, owner);
}

void write_private_file(const fs::path& path, const std::string& text, std::optional<Owner> owner) {
    fs::path draft = path;
    draft += ".part";
    // A crash may have left a draft. O_EXCL refuses a file that another user puts there.
    unlink(draft.c_str());
    Descriptor file(open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (!file.is_open())
        refuse("write", draft);
    const bool is_owned = !owner || fchown(file.get(), owner->user, owner->group) == 0;
    if (!is_owned || !write_all(file.get(), text) || fsync(file.get()) != 0 || !file.close() ||
        rename(draft.c_str(), path.c_str()) != 0) {
        const int reason = errno;
        unlink(draft.c_str());
        errno = reason;
        refuse("write", path);
    }
    if (!synchronise_folder_of(path))
        refuse("write", path);
}

bool remove_private_file(const fs::path& path) {
    if (unlink(path.c_str()) != 0) {
        if (errno == ENOENT)
            return false;
        refuse("delete", path);
    }
    if (!synchronise_folder_of(path))
        refuse("delete", path);
    return true;
}

}  // namespace theatron::files
