// SPDX-License-Identifier: Apache-2.0
#include "record/segment_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <map>
#include <optional>
#include <string>

#include "record/segment_info.h"

namespace theatron::record {
namespace {

struct Name {
    std::string base;  // "a" of "a.002"
    std::uint32_t number = 1;
};

Name parse(const std::string& stem) {
    const std::size_t dot = stem.rfind('.');
    constexpr std::size_t least_digits = 3, most_digits = 4;
    if (dot == std::string::npos)
        return {stem};
    const std::size_t digits = stem.size() - dot - 1;
    std::uint32_t number = 0;
    const char* const end = stem.data() + stem.size();
    const auto parsed = std::from_chars(stem.data() + dot + 1, end, number);
    if (digits < least_digits || digits > most_digits || parsed.ptr != end || number < 2)
        return {stem};
    return {stem.substr(0, dot), number};
}

// Calls `visit(path, name)` with each regular file in the folder of `file` that has its ending.
template <class Visit>
void for_each_beside(const std::filesystem::path& file, Visit visit) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code problem;
    for (std::filesystem::directory_iterator at(folder, problem), end; !problem && at != end;
         at.increment(problem)) {
        const std::filesystem::path& other = at->path();
        std::error_code ignored;
        if (other.extension() == file.extension() && at->is_regular_file(ignored))
            visit(file.parent_path() / other.filename(), parse(other.stem().string()));
    }
}

// Files beside `file` of the same name and ending, whose number is from `least` to `most`.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file, const Name& own,
                                                std::uint32_t least, std::uint32_t most) {
    std::map<std::uint32_t, std::filesystem::path> found;
    for_each_beside(file, [&](std::filesystem::path other, const Name& name) {
        if (name.base == own.base && least <= name.number && name.number <= most)
            found[name.number] = std::move(other);
    });
    std::vector<std::filesystem::path> files;
    for (auto& [number, path] : found)
        files.push_back(std::move(path));
    return files;
}

}  // namespace

std::vector<std::filesystem::path> files_of_later_segments(const std::filesystem::path& file) {
    const Name own = parse(file.stem().string());
    return files_beside(file, own, own.number + 1, max_segments);
}

std::vector<std::filesystem::path> files_of_earlier_segments(const std::filesystem::path& file) {
    const Name own = parse(file.stem().string());
    return files_beside(file, own, 1, own.number - 1);
}

std::vector<std::filesystem::path> files_of_other_names(const std::filesystem::path& file) {
    const std::string base = parse(file.stem().string()).base;
    std::vector<std::filesystem::path> files;
    for_each_beside(file, [&](std::filesystem::path other, const Name& name) {
        if (name.base != base)
            files.push_back(std::move(other));
    });
    std::sort(files.begin(), files.end());
    return files;
}

bool is_in_use(const std::filesystem::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        return false;
    const bool in_use = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(file);
    return in_use;
}

}  // namespace theatron::record
