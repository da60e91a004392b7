// SPDX-License-Identifier: Apache-2.0
// Cases as folders: case.json beside meshes and volumes of our own formats.
//
// Folders come from other people. Their manifests, meshes and volumes are read in this process: the
// formats are our own, small and fuzzed. Links are not followed out of the folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/manifest.h"
#include "image/image.h"
#include "medical/case.h"
#include "medical/mesh.h"
#include "medical/volume.h"

namespace theatron::cases {

// Texts that identify the patient, in a file of their own that never leaves the host.
inline constexpr const char* identifiers_name = "identifiers.json";

inline constexpr const char* mesh_extension = ".thmesh";
inline constexpr const char* volume_extension = ".thvolume";
inline constexpr const char* picture_extension = ".thpicture";

// Each throws Error with one sentence that names the file.
medical::Case read_manifest(const std::filesystem::path& folder);
// The manifest of a finished case: millimetres in LPS.
medical::Case read_finished_manifest(const std::filesystem::path& folder);
// A regular file of the folder itself, with the ending of its kind.
std::filesystem::path file_of(const std::filesystem::path& folder, const medical::Part& part);
std::filesystem::path file_of(const std::filesystem::path& folder, const medical::Series& series);
std::filesystem::path file_of(const std::filesystem::path& folder,
                              const medical::CasePicture& picture);
medical::Mesh read_mesh(const std::filesystem::path& file);
medical::Volume read_volume(const std::filesystem::path& file);
ColorImage read_picture(const std::filesystem::path& file);

struct LoadedCase {
    medical::Case manifest;
    std::vector<medical::Mesh> meshes;     // one for each part
    std::vector<medical::Volume> volumes;  // one for each series
    std::vector<ColorImage> pictures;      // one for each picture
};
// Reads the whole case into memory. Throws Error at the first problem.
LoadedCase read_case(const std::filesystem::path& folder);

struct CheckReport {
    std::vector<std::string> problems;  // sentences; without any the case can be shown
    std::vector<std::string> remarks;   // sentences on unusual content
};
// All problems of a case, not only the first one. Does not throw.
CheckReport check_case(const std::filesystem::path& folder);

}  // namespace theatron::cases
