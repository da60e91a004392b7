// SPDX-License-Identifier: Apache-2.0
#include "export/export_places.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "files/file_bytes.h"
#include "record/segment_files.h"

namespace theatron::exporting {
namespace {

namespace fs = std::filesystem;

struct Found {
    std::vector<fs::path> files;
    std::vector<fs::path> folders;  // inner ones first
};

// True for names of export_folders.cpp: five digits or more. Also for partly written files.
bool is_picture(fs::path name, std::initializer_list<const char*> endings) {
    if (name.extension() == ".part")
        name = name.stem();
    const std::string stem = name.stem().string();
    constexpr std::size_t digits = 5;
    return stem.size() >= digits &&
           std::all_of(stem.begin(), stem.end(), [](char c) { return '0' <= c && c <= '9'; }) &&
           std::any_of(endings.begin(), endings.end(),
                       [&](const char* ending) { return name.extension() == ending; });
}

bool is_camera(const std::string& name) {
    constexpr std::string_view front = "camera-";
    return name.starts_with(front) && name.size() > front.size() &&
           name.find_first_not_of("0123456789", front.size()) == std::string::npos;
}

template <class Visit>
void for_each_in(const fs::path& folder, Visit visit) {
    std::error_code problem;
    for (fs::directory_iterator at(folder, problem), end; !problem && at != end;
         at.increment(problem))
        visit(at->path());
}

// Adds the files and folders in `folder` that an earlier export may have made.
void find(const fs::path& folder, bool may_have_cameras, Found& found) {
    for_each_in(folder, [&](const fs::path& path) {
        const std::string name = path.filename().string();
        std::error_code ignored;
        const std::string whole = path.extension() == ".part" ? path.stem().string() : name;
        if (is_picture(name, {".ply"}) || whole == "calibration.json" || whole == times_name) {
            found.files.push_back(path);
        } else if (fs::is_directory(path, ignored) && (name == "depth" || name == "color")) {
            for_each_in(path, [&](const fs::path& picture) {
                if (is_picture(picture.filename(), {".png", ".jpg"}))
                    found.files.push_back(picture);
            });
            found.folders.push_back(path);
        } else if (may_have_cameras && fs::is_directory(path, ignored) && is_camera(name)) {
            find(path, false, found);
            found.folders.push_back(path);
        }
    });
}

void clear(const fs::path& folder, bool overwrite) {
    Found found;
    find(folder, true, found);
    if (found.files.empty())
        return;
    if (!overwrite)
        throw Error("'" + folder.string() +
                    "' holds an export already; name another folder, or give --overwrite.");
    for (const fs::path& file : found.files) {
        std::error_code problem;
        if (!fs::remove(file, problem) && problem)
            throw Error("Cannot remove '" + file.string() + "': " + problem.message() + ".");
    }
    // Folders with other files stay.
    for (const fs::path& one : found.folders) {
        std::error_code ignored;
        fs::remove(one, ignored);
    }
}

fs::path draft_of(const fs::path& file, std::size_t calibration) {
    const fs::path one = place_of(file, calibration);
    fs::path draft = one.parent_path() / (one.stem() += ".part");
    return draft += one.extension();
}

}  // namespace

fs::path place_of(const fs::path& place, std::size_t calibration) {
    if (calibration == 0)
        return place;
    // "png/" and "." have names of their own, beside which the others belong.
    fs::path named = place.lexically_normal();
    if (!named.has_filename())
        named = named.parent_path();
    if (named.empty() || named == "." || named.filename() == "..")
        named = fs::weakly_canonical(fs::absolute(place));
    fs::path name = named.stem();
    name += "." + std::to_string(calibration + 1);
    name += named.extension();
    return named.parent_path() / name;
}

void clear_folder(const fs::path& folder, bool overwrite) {
    clear(folder, overwrite);
    std::error_code ignored;
    for (std::size_t n = 1; fs::is_directory(place_of(folder, n), ignored); ++n)
        clear(place_of(folder, n), overwrite);
}

void require_free(const fs::path& file, bool overwrite) {
    files::require_new(file, overwrite);
    if (record::is_in_use(file))
        throw Error("'" + file.string() +
                    "' is being recorded or played; name another file, or end that first.");
}

void require_free(const fs::path& file, std::size_t count, bool overwrite,
                  const std::vector<fs::path>& sources) {
    for (std::size_t n = 0; n < count; ++n)
        for (const fs::path& written : {place_of(file, n), draft_of(file, n)}) {
            for (const fs::path& source : sources)
                files::require_other_file(written, source);
            require_free(written, overwrite);
        }
}

void replace_files(const fs::path& file, std::size_t count,
                   const std::function<void(const fs::path&, std::size_t)>& write) {
    std::vector<fs::path> drafts;
    const auto remove_drafts = [&] {
        std::error_code ignored;
        for (const fs::path& draft : drafts)
            fs::remove(draft, ignored);
    };
    try {
        for (std::size_t n = 0; n < count; ++n) {
            drafts.push_back(draft_of(file, n));
            std::error_code ignored;
            fs::remove(drafts.back(), ignored);  // of an export that was killed
            write(drafts.back(), n);
        }
    } catch (...) {
        remove_drafts();
        throw;
    }
    for (std::size_t n = 0; n < count; ++n) {
        std::error_code problem;
        fs::rename(drafts[n], place_of(file, n), problem);
        if (problem && fs::exists(drafts[n]))
            throw Error("Cannot write '" + place_of(file, n).string() + "': " + problem.message() +
                        "; its content is in '" + drafts[n].string() + "'.");
    }
}

}  // namespace theatron::exporting
