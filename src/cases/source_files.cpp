// SPDX-License-Identifier: Apache-2.0
#include "cases/source_files.h"

#include <unistd.h>

#include <algorithm>
#include <span>

#include "base/error.h"
#include "base/small_letters.h"
#include "cases/case_folder.h"
#include "cases/foreign_files.h"
#include "cases/import_case.h"
#include "cases/label_map.h"
#include "cases/left_out.h"
#include "cases/quoted_path.h"
#include "files/file_bytes.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

constexpr int deepest_folder = 32;

bool ends_with(const fs::path& file, std::string_view end) {
    return in_small_letters(file.filename().string()).ends_with(end);
}

// macOS puts such files beside others on discs of other systems and into archives: their names end
// as those do, and they hold no content.
bool is_of_finder(const fs::path& file) {
    return file.filename().string().starts_with("._");
}

// Programs name a file so while they copy it, and leave it where the copy is interrupted.
bool is_unfinished(const fs::path& file) {
    for (const char* end : {".part", ".partial", ".filepart", ".crdownload"})
        if (ends_with(file, end))
            return true;
    return false;
}

void sort_in(const fs::path& file, SourceFiles& files) {
    if (is_of_finder(file) || is_unfinished(file))
        files.others.push_back(file);
    else if (is_mesh_file(file))
        files.meshes.push_back(file);
    else if (is_nifti_file(file) || is_nrrd_file(file))
        files.label_maps.push_back(file);
    else if (is_picture_file(file))
        files.pictures.push_back(file);
    else if (is_dicom_file(file))
        files.images.push_back(file);
    else
        files.others.push_back(file);
}

bool has_nifti_name(const fs::path& file) {
    return ends_with(file, ".nii") || ends_with(file, ".nii.gz") || ends_with(file, ".nii.bz2");
}

// The name says that the file is of a kind that is imported.
bool has_name_of_kind(const fs::path& file) {
    return !is_of_finder(file) &&
           (is_mesh_file(file) || has_nifti_name(file) || is_nrrd_file(file) ||
            is_picture_file(file) || ends_with(file, ".dcm") || ends_with(file, ".ima"));
}

bool is_of_finished_case(const fs::path& file) {
    for (const char* extension : {mesh_extension, volume_extension, picture_extension})
        if (file.extension() == extension)
            return true;
    return false;
}

// This user may not open it.
bool is_closed(const fs::path& path, bool is_folder) {
    return access(path.c_str(), is_folder ? R_OK | X_OK : R_OK) != 0;
}

// Sorted by name. An error in the middle would leave files out without a word.
std::vector<fs::path> files_below(const fs::path& folder, SourceFiles& files) {
    const std::string name = quoted_path(folder);
    std::vector<fs::path> found;
    std::error_code failed, ignored;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        if (at->is_symlink(ignored)) {
            ++files.links;
            continue;
        }
        if (at->is_directory(ignored)) {
            const bool is_too_deep = at.depth() >= deepest_folder;
            // Discs of other systems have folders of the system, which nobody else may open.
            if (!is_too_deep && !is_closed(at->path(), true))
                continue;
            at.disable_recursion_pending();
            (is_too_deep ? files.too_deep : files.closed).push_back(at->path());
            continue;
        }
        if (at->is_regular_file(ignored))
            found.push_back(at->path());
        if (found.size() > max_source_files)
            throw Error(name + " holds more than " + std::to_string(max_source_files) +
                        " files; name the folder of one patient.");
    }
    if (failed)
        throw Error(name + " cannot be read to its end: " + failed.message() + ".");
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

bool is_nifti_file(const fs::path& file) {
    return has_nifti_name(file) || is_nifti_head_file(file);
}

bool is_nifti_head_file(const fs::path& file) {
    constexpr std::size_t most = std::size_t(1) << 20;
    std::error_code failed;
    return (ends_with(file, ".hdr") || ends_with(file, ".hdr.gz")) &&
           fs::file_size(file, failed) <= most && !failed &&
           is_nifti_head(files::read_file(file, most));
}

bool is_nrrd_file(const fs::path& file) {
    return ends_with(file, ".nrrd") || ends_with(file, ".nhdr");
}

const char* reason_of_other_kind(const fs::path& file) {
    constexpr std::string_view archives[] = {".zip", ".7z", ".rar", ".tar", ".tgz", ".gz",
                                             ".bz2", ".xz", ".zst", ".iso", ".mrb"};
    constexpr std::string_view surfaces[] = {".vtk", ".vtp", ".vtu",   ".3mf", ".fbx",  ".dae",
                                             ".off", ".wrl", ".blend", ".x3d", ".step", ".stp"};
    constexpr std::string_view label_maps[] = {".mha", ".mhd", ".mgz", ".mgh", ".mnc", ".nia"};
    constexpr std::string_view pictures[] = {".pdf",  ".tif", ".tiff", ".bmp",
                                             ".heic", ".gif", ".webp", ".svg"};
    const auto is_any = [&](std::span<const std::string_view> ends) {
        return !is_of_finder(file) &&
               std::any_of(ends.begin(), ends.end(),
                           [&](std::string_view end) { return ends_with(file, end); });
    };
    if (is_unfinished(file))
        return "is a copy that did not end; copy it again";
    if (is_any(archives))
        return "is an archive, which is not opened; unpack it and import its folder";
    if (is_any(surfaces))
        return "may hold a surface in a format that is not read; save it as STL, OBJ, PLY or glTF";
    if (is_any(label_maps))
        return "may hold a label map in a format that is not read; save it as NIfTI or NRRD";
    if (is_any(pictures))
        return "may hold pictures in a format that is not read; save what matters as PNG or JPEG";
    return nullptr;
}

SourceFiles find_source_files(const fs::path& source) {
    const std::string name = quoted_path(source);
    SourceFiles files;
    std::error_code failed;
    if (fs::is_regular_file(source, failed)) {
        // Readers follow no links.
        sort_in(fs::is_symlink(source, failed) ? fs::canonical(source) : source, files);
    } else {
        if (!fs::is_directory(source, failed))
            throw Error(fs::exists(source, failed) ? name + " is neither a file nor a folder."
                                                   : "There is no file or folder " + name + ".");
        for (const fs::path& file : files_below(source, files))
            if (is_closed(file, false) && !has_name_of_kind(file))
                files.closed.push_back(file);
            else
                sort_in(file, files);
    }
    if (files.images.empty() && files.meshes.empty() && files.label_maps.empty() &&
        files.pictures.empty()) {
        if (std::any_of(files.others.begin(), files.others.end(), is_of_finished_case))
            throw Error(name +
                        " is a finished case already; a session offers it if it lies in the "
                        "folder of 'theatron host --cases'.");
        throw Error(name +
                    " holds neither DICOM images nor surfaces (STL, OBJ, PLY, GLB, glTF) nor "
                    "label maps (NIfTI, NRRD) nor pictures (PNG, JPEG)" +
                    (files.others.empty() ? "" : ", but " + first_names(files.others)) +
                    (files.closed.empty() ? ""
                                          : ", and " + first_names(files.closed) +
                                                " may not be opened by this user") +
                    (files.too_deep.empty()
                         ? ""
                         : ", and " + first_names(files.too_deep) + " lies too many folders deep") +
                    (files.links > 0 ? "; links in it are not followed." : "."));
    }
    return files;
}

}  // namespace theatron::cases
