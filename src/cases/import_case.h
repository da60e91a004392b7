// SPDX-License-Identifier: Apache-2.0
// Makes a case (case_folder.h) out of the files of surgeons' programs: folders with DICOM images,
// surfaces (STL, OBJ, PLY, glTF), label maps (NIfTI, NRRD) and pictures (PNG, JPEG).
//
// The source is not changed. Large libraries read it in processes of their own. Texts that identify
// the patient go into a separate file that only this user can read.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "medical/case.h"

namespace theatron::cases {

inline constexpr std::size_t max_source_files = 20'000;
inline constexpr std::size_t max_label_file_bytes = std::size_t(1) << 30;

struct LabelChoice {
    int value = 0;
    std::string name;
    medical::Role role = medical::Role::other;
};

struct ImportOptions {
    std::string name;  // empty: that of the case's folder
    std::string license, credit;
    std::optional<bool> deidentified;  // none: as the DICOM files say; without any, false
    // Unit and axes of surfaces; none: as is usual for their format.
    std::optional<medical::Unit> unit;
    std::optional<medical::Axes> axes;
    std::size_t max_triangles = 60'000;  // of a part
    // Parts out of label maps also where the source has surfaces.
    bool surfaces_from_labels = false;
    bool without_pictures = false;
    std::vector<LabelChoice> labels;  // names for labels that the file names not
};

struct ImportReport {
    medical::Case manifest;
    std::vector<std::string> remarks;  // sentences on what was left out or looks unusual
};

// Called during long steps with their name and progress (0 to 1). May throw to stop the import.
using Progress = std::function<void(std::string_view what, double done)>;

// Writes the case's folder, which must not exist yet, whole or not at all. Throws Error with one
// sentence that names the file.
ImportReport import_case(const std::filesystem::path& source, const std::filesystem::path& folder,
                         const ImportOptions& options, const Progress& progress);

}  // namespace theatron::cases
