// SPDX-License-Identifier: Apache-2.0
// Answers of the processes that read foreign files, on the side that checks them. Only for this
// module.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "sandbox/child.h"

namespace theatron::cases {

std::string lower_extension(const std::filesystem::path& file);

// Throws NotForUs where the file is empty, and Error where this is no file, or one of more than
// `limit` bytes; `advice` is what to do then.
void require_size(const std::filesystem::path& file, std::size_t limit, const char* advice);

struct Reply {
    Answer what;
    ByteView content;  // in the shared memory, until the next request
};

Reply reply_of(sandbox::Child& child);

// The end of a sentence that begins with the file's name.
const char* reason_of(Answer what);

// Throws NotForUs where nothing is damaged, else Error.
[[noreturn]] void refuse(const std::filesystem::path& file, Answer what);

}  // namespace theatron::cases
