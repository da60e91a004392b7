// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/foreign_files.h"
#include "cases/import_parts.h"
#include "cases/manifest.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

std::string picture_name(const fs::path& file, const std::optional<medical::Case>& manifest) {
    if (manifest)
        for (const medical::CasePicture& one : manifest->pictures)
            if (one.file == file.filename())
                return one.name;
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), '_', ' ');
    return clean_text(name, max_name_characters);
}

}  // namespace

std::vector<ImportedPicture> import_pictures(const std::vector<fs::path>& files,
                                             const std::optional<medical::Case>& manifest,
                                             LeftOut& left_out, std::vector<std::string>& remarks,
                                             const Progress& progress) {
    if (files.size() > max_pictures)
        throw Error(
            "The source holds " + std::to_string(files.size()) +
            " pictures (PNG, JPEG), and a case has at most " + std::to_string(max_pictures) +
            "; take the others out of the folder, or leave all out with --without-pictures.");
    std::vector<ImportedPicture> pictures;
    for (std::size_t i = 0; i < files.size(); ++i) {
        progress("Reading pictures", double(i) / double(files.size()));
        try {
            pictures.push_back(
                {{picture_name(files[i], manifest), ""}, read_picture_file(files[i])});
        } catch (const NotForUs& error) {
            left_out.add(files[i], error.reason());
        }
    }
    if (!pictures.empty())
        remarks.push_back(
            std::string(pictures.size() == 1 ? "The picture is" : "The pictures are") +
            " shown to everybody as " + (pictures.size() == 1 ? "it is" : "they are") +
            ": look for names and dates in the pixels, or leave pictures out with "
            "--without-pictures.");
    return pictures;
}

}  // namespace theatron::cases
