// SPDX-License-Identifier: Apache-2.0
#include "client/person_id.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "base/error.h"
#include "files/private_file.h"
#include "net/certificate.h"
#include "wire/control.h"

namespace theatron::client {
namespace {

// Holds the folder's lock, so that programs that begin at the same time agree on the person.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder)
        : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (folder_ >= 0)
            (void)flock(folder_, LOCK_EX);
    }
    FolderLock(const FolderLock&) = delete;
    ~FolderLock() {
        if (folder_ >= 0)
            close(folder_);
    }

private:
    const int folder_;
};

constexpr const char* file_name = "person.id";

std::optional<Bytes> parse(const std::string& text) {
    Bytes id;
    for (std::size_t i = 0; i + 1 < text.size() && id.size() < wire::person_id_size; i += 2) {
        int value = 0;
        for (const char c : text.substr(i, 2)) {
            const bool digit = c >= '0' && c <= '9';
            if (!digit && !(c >= 'a' && c <= 'f'))
                return std::nullopt;
            value = 16 * value + (digit ? c - '0' : c - 'a' + 10);
        }
        id.push_back(std::byte(value));
    }
    return id.size() == wire::person_id_size ? std::optional(id) : std::nullopt;
}

}  // namespace

Bytes load_or_make_person_id(const std::filesystem::path& folder) {
    const std::string fresh = net::random_token();  // 32 hex digits
    try {
        if (!folder.empty()) {
            files::open_private_folder(folder);
            const FolderLock lock(folder);
            const auto kept = files::read_private_file(folder / file_name, files::Privacy::secret);
            if (const auto id = kept ? parse(*kept) : std::nullopt)
                return *id;
            if (!kept)
                files::write_private_file(folder / file_name, fresh + "\n");
        }
    } catch (const Error&) {
        // A person without it is a new one; that is no reason to keep them out.
    }
    return parse(fresh).value_or(Bytes());
}

}  // namespace theatron::client
