// SPDX-License-Identifier: Apache-2.0
// A file of lines that grows, each on the disk before the next one is made.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace theatron::files {

// One writer at a time; a second one is refused. Functions throw Error, one sentence that names the
// file.
class JournalFile {
public:
    // Opens or makes the file, which only this user may read and write.
    explicit JournalFile(std::filesystem::path path);
    ~JournalFile();
    JournalFile(const JournalFile&) = delete;
    JournalFile& operator=(const JournalFile&) = delete;

    // All of it. A file of more than `max_bytes` is refused.
    std::string text(std::size_t max_bytes) const;
    // The bytes behind these, half a line of a program that was killed, are taken away.
    void keep(std::size_t bytes);
    // Returns when the line is on the disk. Throws Error also if the file was deleted.
    void append(std::string_view line);

private:
    [[noreturn]] void refuse(const char* what) const;

    const std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace theatron::files
