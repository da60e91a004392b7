// SPDX-License-Identifier: Apache-2.0
// Label maps on their way into a case: a surface for each label.
#include <set>

#include "base/error.h"
#include "cases/foreign_files.h"
#include "cases/import_parts.h"
#include "cases/label_surface.h"
#include "cases/manifest.h"
#include "cases/quoted_path.h"
#include "files/file_bytes.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Mesh;
using medical::Part;

// The part of a label as the options have it, else the file, else by its number.
Part part_of(int value, const LabelMap& map, const ImportOptions& options) {
    Part part = usual_part("label " + std::to_string(value));
    for (const LabelName& known : map.names)
        if (known.value == value)
            part = usual_part(known.name);
    for (const LabelChoice& choice : options.labels)
        if (choice.value == value) {
            part = usual_part(choice.name);
            part.role = choice.role;
            part.color = medical::usual_color(choice.role);
            part.opacity = medical::usual_opacity(choice.role);
        }
    return part;
}

// False: the map has no labels.
bool add_parts(const LabelMap& map, const fs::path& file, const ImportOptions& options,
               std::set<int>& found, SurfaceBudget& budget, std::vector<ImportedPart>& parts,
               std::vector<std::string>& remarks, const Progress& progress) {
    const std::vector<LabelCount> labels = labels_in(map);
    if (looks_like_an_image(map))
        throw NotForUs(file,
                       "is an image and no label map: its values change from sample to "
                       "sample; add it as DICOM, as which alone images are read");
    if (labels.size() > max_parts)
        throw NotForUs(file, "has more than " + std::to_string(max_parts) +
                                 " labels; save those that matter as a label map of their own");
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto tell = [&] { progress("Making surfaces", double(i) / double(labels.size())); };
        tell();
        const int value = labels[i].value;
        found.insert(value);
        Part part = part_of(value, map, options);
        Mesh mesh = surface_of_label(map, labels[i], options.max_triangles, budget, tell);
        if (mesh.triangles.empty())
            remarks.push_back("The label " + std::to_string(value) +
                              " has a surface of too many triangles, alone or together with the "
                              "labels before it, and is left out; save the labels that matter as a "
                              "label map of their own.");
        else
            parts.push_back({std::move(part), std::move(mesh)});
    }
    return !labels.empty();
}

// The file beside the head that has its samples, whether it is there or not.
fs::path sample_file_of_pair(const fs::path& head) {
    fs::path name = head.filename();
    if (name.extension() == ".gz")
        name = name.stem();
    const bool is_upper = name.extension() == ".HDR";
    const fs::path plain = head.parent_path() / name.replace_extension(is_upper ? ".IMG" : ".img");
    fs::path packed = plain;
    packed += ".gz";
    std::error_code failed;
    return !fs::exists(plain, failed) && fs::exists(packed, failed) ? packed : plain;
}

// The file with this name in an NRRD header, if it may lie beside the header: a name alone, or a
// path of the computer that wrote it. Nothing for one in a folder below or above, of whose name
// another file may lie here.
std::optional<fs::path> data_beside(const fs::path& header, std::string_view name) {
    while (name.starts_with("./") || name.starts_with(".\\"))
        name.remove_prefix(2);
    const std::size_t at = name.find_last_of("/\\");
    const bool is_whole =
        name.starts_with('/') || name.starts_with('\\') || (name.size() > 2 && name[1] == ':');
    if (at != name.npos && !is_whole)
        return std::nullopt;
    return header.parent_path() / fs::path(name.substr(at == name.npos ? 0 : at + 1));
}

Bytes samples_beside(const fs::path& head, const std::optional<fs::path>& samples,
                     const fs::path& name, const char* in_one_piece) {
    std::error_code failed;
    if (!samples || !fs::is_regular_file(fs::symlink_status(*samples, failed)))
        throw NotForUs(head, "keeps its samples in another file, " + quoted_path(name) +
                                 ", which is not beside it; save it in one piece (" + in_one_piece +
                                 ")");
    return files::read_file(*samples, max_label_file_bytes);
}

}  // namespace

std::optional<fs::path> sample_file_of(const fs::path& header) {
    constexpr std::size_t most = std::size_t(1) << 20;
    std::error_code failed;
    if (is_nifti_head_file(header))
        return sample_file_of_pair(header);
    if (!is_nrrd_file(header) || fs::file_size(header, failed) > most || failed)
        return std::nullopt;
    const std::string name = detached_data_of(files::read_file(header, most));
    if (name.empty())
        return std::nullopt;
    return data_beside(header, name);
}

LabelMap read_label_map(const fs::path& file, std::size_t layer, std::size_t& layers) {
    const Bytes bytes = files::read_file(file, max_label_file_bytes);
    ParsedLabels parsed;
    if (is_nifti_head(bytes)) {
        const fs::path samples = sample_file_of_pair(file);
        parsed = parse_nifti(bytes, samples_beside(file, samples, samples.filename(), ".nii"));
    } else if (!is_nrrd_file(file)) {
        parsed = parse_nifti(bytes);
    } else if (const std::string name = detached_data_of(bytes); name.empty()) {
        parsed = parse_nrrd(bytes, layer);
    } else {
        const std::optional<fs::path> data = data_beside(file, name);
        parsed = parse_nrrd(bytes, layer, samples_beside(file, data, name, ".nrrd"));
    }
    layers = parsed.layers;
    if (!parsed.problem.empty() && parsed.is_other_content)
        throw NotForUs(file, parsed.problem);
    if (!parsed.problem.empty())
        throw Error("The label map " + quoted_path(file) + " " + parsed.problem + ".");
    return std::move(parsed.value);
}

std::vector<ImportedPart> import_labels(const fs::path& file, const ImportOptions& options,
                                        std::set<int>& found, LeftOut& left_out,
                                        std::vector<std::string>& remarks,
                                        const Progress& progress) {
    progress("Reading the label map", 0);
    std::vector<ImportedPart> parts;
    try {
        SurfaceBudget budget;
        std::size_t layers = 1;
        bool any = false;
        for (std::size_t layer = 0; layer < layers; ++layer)
            any = add_parts(read_label_map(file, layer, layers), file, options, found, budget,
                            parts, remarks, progress) ||
                  any;
        if (!any)
            throw NotForUs(file, "marks nothing: there are no labels but 0");
    } catch (const NotForUs& error) {
        left_out.add(file, error.reason());
        return {};
    }
    progress("Making surfaces", 1);
    remark_on_size(parts, remarks);
    return parts;
}

}  // namespace theatron::cases
