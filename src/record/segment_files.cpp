// SPDX-License-Identifier: Apache-2.0
#include "record/segment_files.h"

#include <algorithm>
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

// Files beside `file` of the same name and ending, whose number is from `least` to `most`.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file, const Name& own,
                                                std::uint32_t least, std::uint32_t most) {
    std::map<std::uint32_t, std::filesystem::path> found;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code problem;
    for (std::filesystem::directory_iterator at(folder, problem), end; !problem && at != end;
         at.increment(problem)) {
        const std::filesystem::path& other = at->path();
        if (other.extension() != file.extension())
            continue;
        const Name name = parse(other.stem().string());
        std::error_code ignored;
        if (name.base == own.base && least <= name.number && name.number <= most &&
            at->is_regular_file(ignored))
            found[name.number] = file.parent_path() / other.filename();
    }
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

}  // namespace theatron::record
