// SPDX-License-Identifier: Apache-2.0
// The parts of an import: series out of DICOM images, parts out of surfaces and label maps, and
// pictures.
// Only for this module.
#pragma once

#include <set>

#include "cases/dicom_slice.h"
#include "cases/import_case.h"
#include "cases/label_map.h"
#include "cases/left_out.h"
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
                                          std::set<Identifier>& identifiers, LeftOut& left_out,
                                          std::vector<std::string>& remarks,
                                          const Progress& progress);

struct ImportedPart {
    medical::Part part;  // without a file yet
    medical::Mesh mesh;
};

// `manifest`: the parts as a case.json in the source describes them; without one, defaults apply.
// `beside` gets the files that hold corners of others.
std::vector<ImportedPart> import_meshes(const std::vector<std::filesystem::path>& files,
                                        const std::optional<medical::Case>& manifest,
                                        const ImportOptions& options, LeftOut& left_out,
                                        std::set<std::filesystem::path>& beside,
                                        std::vector<std::string>& remarks,
                                        const Progress& progress);
// None where the file is no label map, but an image for example. Adds the values of the labels to
// `found`.
std::vector<ImportedPart> import_labels(const std::filesystem::path& file,
                                        const ImportOptions& options, std::set<int>& found,
                                        LeftOut& left_out, std::vector<std::string>& remarks,
                                        const Progress& progress);

struct ImportedPicture {
    medical::CasePicture picture;  // without a file yet
    ColorImage image;
};
// In the order of their files. `manifest` may name them.
std::vector<ImportedPicture> import_pictures(const std::vector<std::filesystem::path>& files,
                                             const std::optional<medical::Case>& manifest,
                                             LeftOut& left_out, std::vector<std::string>& remarks,
                                             const Progress& progress);

// The label map in a file, or one layer of several, whose number goes to `layers`. Throws NotForUs,
// or Error where the file is damaged.
LabelMap read_label_map(const std::filesystem::path& file, std::size_t layer, std::size_t& layers);
inline LabelMap read_label_map(const std::filesystem::path& file) {
    std::size_t layers = 1;
    return read_label_map(file, 0, layers);
}

// The file that holds the samples of an NRRD header (.nhdr); nothing where they follow it.
std::optional<std::filesystem::path> sample_file_of(const std::filesystem::path& header);

// A part of this name as it usually looks.
medical::Part usual_part(const std::string& name);

// A wrong unit makes organs a thousand times too small or too large.
void remark_on_size(const std::vector<ImportedPart>& parts, std::vector<std::string>& remarks);

}  // namespace theatron::cases
