// SPDX-License-Identifier: Apache-2.0
#include "cases/source_files.h"

#include <algorithm>

#include "base/error.h"
#include "cases/foreign_files.h"
#include "cases/import_case.h"
#include "cases/quoted_path.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

constexpr int deepest_folder = 8;

bool ends_with(const fs::path& file, std::string_view end) {
    std::string name = file.filename().string();
    for (char& c : name)
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return name.ends_with(end);
}

void sort_in(const fs::path& file, SourceFiles& files) {
    if (is_mesh_file(file))
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

}  // namespace

bool is_nifti_file(const fs::path& file) {
    return ends_with(file, ".nii") || ends_with(file, ".nii.gz");
}

bool is_nrrd_file(const fs::path& file) {
    return ends_with(file, ".nrrd");
}

SourceFiles find_source_files(const fs::path& source) {
    const std::string name = quoted_path(source);
    SourceFiles files;
    std::error_code failed;
    if (fs::is_regular_file(source, failed)) {
        sort_in(source, files);
    } else {
        if (!fs::is_directory(source, failed))
            throw Error(fs::exists(source, failed) ? name + " is neither a file nor a folder."
                                                   : "There is no file or folder " + name + ".");
        std::vector<fs::path> found;
        const auto options = fs::directory_options::skip_permission_denied;
        for (fs::recursive_directory_iterator at(source, options, failed), end; at != end;
             at.increment(failed)) {
            if (failed)
                break;
            if (at->is_symlink(failed))
                continue;
            if (at.depth() >= deepest_folder)
                at.disable_recursion_pending();
            if (at->is_regular_file(failed))
                found.push_back(at->path());
            if (found.size() > max_source_files)
                throw Error(name + " holds more than " + std::to_string(max_source_files) +
                            " files; name the folder of one patient.");
        }
        std::sort(found.begin(), found.end());
        for (const fs::path& file : found)
            sort_in(file, files);
    }
    if (files.images.empty() && files.meshes.empty() && files.label_maps.empty() &&
        files.pictures.empty())
        throw Error(name +
                    " holds neither DICOM images nor surfaces (STL, OBJ, PLY, GLB) nor label "
                    "maps (NIfTI, NRRD) nor pictures (PNG, JPEG).");
    return files;
}

}  // namespace theatron::cases
