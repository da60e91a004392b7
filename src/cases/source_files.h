// SPDX-License-Identifier: Apache-2.0
// Lists the files of a folder that is imported as a case, by kind.
#pragma once

#include <filesystem>
#include <vector>

namespace theatron::cases {

struct SourceFiles {
    std::vector<std::filesystem::path> images;  // DICOM
    std::vector<std::filesystem::path> meshes;
    std::vector<std::filesystem::path> label_maps;
    std::vector<std::filesystem::path> pictures;  // PNG, JPEG
    std::vector<std::filesystem::path> others;
    std::size_t links = 0;                        // that were not followed
    std::vector<std::filesystem::path> too_deep;  // folders
    std::vector<std::filesystem::path> closed;    // files and folders that may not be opened
};

// All regular files in the folder and those below it, or `source` itself, in the order of their
// names. A link is followed if it is `source`, not in the folder. Throws Error where there is
// nothing, or far too much, or a folder cannot be read to its end.
SourceFiles find_source_files(const std::filesystem::path& source);

// By its name; a file that may be the head of a pair (.hdr, .hdr.gz) also by its content.
bool is_nifti_file(const std::filesystem::path& file);
bool is_nifti_head_file(const std::filesystem::path& file);
bool is_nrrd_file(const std::filesystem::path& file);

// The end of a sentence on a file of a kind that is not read: what it may hold, by its name, and
// what to do, as in "is an archive, ...". Null where nothing is known.
const char* reason_of_other_kind(const std::filesystem::path& file);

}  // namespace theatron::cases
