// SPDX-License-Identifier: Apache-2.0
// The parts of an import: series out of DICOM images, parts out of surfaces and label maps, and
// pictures.
// Only for this module.
#pragma once

#include <set>

#include "cases/dicom_slice.h"
#include "cases/import_case.h"
#include "cases/label_map.h"
#include "cases/source_files.h"
#include "image/image.h"
#include "medical/mesh.h"
#include "medical/volume.h"

namespace theatron::cases {

struct ImportedSeries {
    medical::Series series;  // without a file yet
    medical::Volume volume;
    std::vector<Identifier> identifiers;
    std::string frame_uid;
    bool deidentified = false;
};

// Adds the texts that identify patients in any of the files, also in those that are left out, to
// `identifiers`.
std::vector<ImportedSeries> import_series(const std::vector<std::filesystem::path>& files,
                                          std::set<Identifier>& identifiers,
                                          std::vector<std::string>& remarks,
                                          const Progress& progress);

struct ImportedPart {
    medical::Part part;  // without a file yet
    medical::Mesh mesh;
};

// `manifest`: the parts as a case.json in the source describes them; without one, defaults apply.
std::vector<ImportedPart> import_meshes(const std::vector<std::filesystem::path>& files,
                                        const std::optional<medical::Case>& manifest,
                                        const ImportOptions& options,
                                        std::vector<std::string>& remarks,
                                        const Progress& progress);
// Adds the values of the labels to `found`.
std::vector<ImportedPart> import_labels(const std::filesystem::path& file,
                                        const ImportOptions& options, std::set<int>& found,
                                        std::vector<std::string>& remarks,
                                        const Progress& progress);

struct ImportedPicture {
    medical::CasePicture picture;  // without a file yet
    ColorImage image;
};
// In the order of their files. `manifest` may name them.
std::vector<ImportedPicture> import_pictures(const std::vector<std::filesystem::path>& files,
                                             const std::optional<medical::Case>& manifest,
                                             std::vector<std::string>& remarks,
                                             const Progress& progress);

// The label map in a file. Throws Error with one sentence.
LabelMap read_label_map(const std::filesystem::path& file);

}  // namespace theatron::cases
