// SPDX-License-Identifier: Apache-2.0
#include "cases/case_folder.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/patient_texts.h"
#include "cases/quoted_path.h"
#include "files/file_bytes.h"
#include "medical/mesh_measures.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Case;
using medical::Mesh;
using medical::Volume;

constexpr std::size_t max_mesh_bytes = std::size_t(1) << 30;
constexpr std::size_t max_picture_bytes =
    64 + 3 * std::size_t(medical::max_picture_side) * medical::max_picture_side;
constexpr std::size_t max_volume_bytes = (std::size_t(1) << 30) + medical::volume_header_size;

template <class T>
T require(Result<T> result, const fs::path& file, const char* what) {
    if (!result)
        throw Error(quoted_path(file) + " is " +
                    (result.error() == Status::malformed ? "no " + std::string(what)
                                                         : std::string(to_text(result.error()))) +
                    "; import the case again.");
    return std::move(*result);
}

// A name in a manifest leads to a file in the folder itself, never by a link to one elsewhere.
fs::path file_in(const fs::path& folder, const std::string& name) {
    fs::path file = folder / name;
    const fs::file_status status = fs::symlink_status(file);
    if (status.type() == fs::file_type::not_found)
        throw Error("The case in " + quoted_path(folder) + " lacks the file '" + name +
                    "', which its manifest names.");
    if (status.type() != fs::file_type::regular)
        throw Error(quoted_path(file) + " is not a regular file.");
    return file;
}

fs::path part_file(const fs::path& folder, const std::string& name, const char* extension,
                   const char* what) {
    fs::path file = file_in(folder, name);
    if (file.extension() != extension)
        throw Error(quoted_path(file) + " is no " + what + " of a finished case (*" + extension +
                    "): make one with 'theatron case import " + clean_text(folder.string(), 200) +
                    " CASE'.");
    return file;
}

std::string litres(double mm3) {
    char text[32];
    std::snprintf(text, sizeof(text), mm3 < 1e5 ? "%.1f ml" : "%.0f ml", mm3 * 1e-3);
    return text;
}

class Check {
public:
    explicit Check(const fs::path& folder) : folder_(folder) {}

    CheckReport run() {
        attempt([&] { manifest_ = read_manifest(folder_); });
        if (!report_.problems.empty())
            return report_;
        check_manifest();
        for (const medical::Series& series : manifest_.series)
            attempt([&] { check_series(series); });
        for (const medical::Part& part : manifest_.parts)
            attempt([&] { check_part(part); });
        for (const medical::CasePicture& picture : manifest_.pictures)
            attempt([&] { (void)read_picture(file_of(folder_, picture)); });
        check_identifiers();
        check_other_files();
        return report_;
    }

private:
    template <class Action>
    void attempt(Action action) {
        try {
            action();
        } catch (const std::exception& error) {
            problem(error.what());
        }
    }
    void problem(std::string sentence) { report_.problems.push_back(std::move(sentence)); }
    void remark(std::string sentence) { report_.remarks.push_back(std::move(sentence)); }

    void check_manifest() {
        if (manifest_.unit != medical::Unit::mm || manifest_.axes != medical::Axes::lps)
            problem(
                "The manifest's positions are not millimetres in LPS, as those of a finished "
                "case are: make one with 'theatron case import'.");
        if (manifest_.parts.empty() && manifest_.series.empty() && manifest_.pictures.empty())
            problem(
                "The manifest names neither parts nor series nor pictures, so there is nothing to "
                "show.");
        if (!manifest_.deidentified)
            remark("The case is not said to be de-identified.");
        if (manifest_.license.empty())
            remark("The manifest names no licence.");
        std::set<std::string> names;
        for (const medical::Part& part : manifest_.parts) {
            if (!names.insert(part.name).second)
                remark("Two parts are named '" + part.name + "'.");
        }
    }

    void check_series(const medical::Series& series) {
        const Volume volume =
            read_volume(part_file(folder_, series.file, volume_extension, "series of images"));
        boxes_.push_back(medical::box_of(volume.grid));
        for (const int slice : series.missing_slices)
            if (slice >= volume.grid.slices)
                return problem("The manifest says that the series '" + series.name +
                               "' lacks slice " + std::to_string(slice) + ", but it has only " +
                               std::to_string(volume.grid.slices) + ".");
        if (!series.missing_slices.empty())
            remark("The series '" + series.name + "' lacks " +
                   std::to_string(series.missing_slices.size()) + " of " +
                   std::to_string(volume.grid.slices) + " slices.");
    }

    void check_part(const medical::Part& part) {
        const Mesh mesh = read_mesh(part_file(folder_, part.file, mesh_extension, "mesh"));
        if (mesh.triangles.empty())
            return problem("The part '" + part.name + "' has no triangles.");
        const medical::MeshShape shape = medical::shape_of(mesh);
        const medical::Box box = medical::box_of(mesh);
        if (!shape.closed)
            remark("The surface of '" + part.name + "' is not closed.");
        else if (shape.volume_mm3 < 0)
            remark("The surface of '" + part.name + "' is inside out.");
        else if (!shape.manifold)
            remark("The surface of '" + part.name + "' touches itself.");
        const double largest = std::max({box.high_mm.x - box.low_mm.x, box.high_mm.y - box.low_mm.y,
                                         box.high_mm.z - box.low_mm.z});
        if (largest < 1 || largest > 2500)
            remark("The part '" + part.name + "' is " + std::to_string(int(largest)) +
                   " mm large, so its unit may be wrong.");
        if (part.role == medical::Role::shell && shape.closed && shape.volume_mm3 > 3e6)
            remark("The shell '" + part.name + "' holds " + litres(shape.volume_mm3) +
                   ", more than livers do.");
        if (!boxes_.empty() && std::none_of(boxes_.begin(), boxes_.end(), [&](const auto& images) {
                return medical::overlap(images, box);
            }))
            problem("The part '" + part.name +
                    "' lies outside of all images: their axes or units differ.");
    }

    void check_identifiers() {
        attempt([&] { (void)read_patient_texts(folder_); });
    }

    void check_other_files() {
        std::set<std::string> known{manifest_name, identifiers_name};
        for (const medical::Part& part : manifest_.parts)
            known.insert(part.file);
        for (const medical::Series& series : manifest_.series)
            known.insert(series.file);
        for (const medical::CasePicture& picture : manifest_.pictures)
            known.insert(picture.file);
        std::error_code failed;
        std::size_t others = 0;
        for (const auto& entry : fs::directory_iterator(folder_, failed))
            others += !known.contains(entry.path().filename().string());
        if (others > 0)
            remark("The folder holds " + std::to_string(others) +
                   (others == 1 ? " file that" : " files that") +
                   " the manifest does not name; they are not shown.");
    }

    fs::path folder_;
    Case manifest_;
    std::vector<medical::Box> boxes_;  // of the series
    CheckReport report_;
};

}  // namespace

Case read_manifest(const fs::path& folder) {
    std::error_code failed;
    if (!fs::is_directory(folder, failed))
        throw Error("There is no folder " + quoted_path(folder) + ".");
    const fs::path file = folder / manifest_name;
    if (!fs::exists(file, failed))
        throw Error(quoted_path(folder) + " is no case: it lacks '" + manifest_name +
                    "'; make a case with 'theatron case import'.");
    const Bytes bytes = files::read_file(file_in(folder, manifest_name), max_manifest_bytes);
    ParsedManifest parsed =
        parse_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!parsed.problem.empty())
        throw Error("The manifest " + quoted_path(file) + " " + parsed.problem + ".");
    return std::move(parsed.value);
}

Mesh read_mesh(const fs::path& file) {
    return require(medical::decode_mesh(files::read_file(file, max_mesh_bytes)), file, "mesh");
}

Volume read_volume(const fs::path& file) {
    return require(medical::decode_volume(files::read_file(file, max_volume_bytes)), file,
                   "volume");
}

ColorImage read_picture(const fs::path& file) {
    return require(medical::decode_picture(files::read_file(file, max_picture_bytes)), file,
                   "picture of a case");
}

Case read_finished_manifest(const fs::path& folder) {
    Case manifest = read_manifest(folder);
    if (manifest.unit != medical::Unit::mm || manifest.axes != medical::Axes::lps)
        throw Error("The case in " + quoted_path(folder) +
                    " is not finished: make one of it with 'theatron case import'.");
    return manifest;
}

fs::path file_of(const fs::path& folder, const medical::Part& part) {
    return part_file(folder, part.file, mesh_extension, "mesh");
}

fs::path file_of(const fs::path& folder, const medical::Series& series) {
    return part_file(folder, series.file, volume_extension, "series of images");
}

fs::path file_of(const fs::path& folder, const medical::CasePicture& picture) {
    return part_file(folder, picture.file, picture_extension, "picture");
}

LoadedCase read_case(const fs::path& folder) {
    LoadedCase loaded;
    loaded.manifest = read_finished_manifest(folder);
    for (const medical::Part& part : loaded.manifest.parts)
        loaded.meshes.push_back(read_mesh(file_of(folder, part)));
    for (const medical::Series& series : loaded.manifest.series)
        loaded.volumes.push_back(read_volume(file_of(folder, series)));
    for (const medical::CasePicture& picture : loaded.manifest.pictures)
        loaded.pictures.push_back(read_picture(file_of(folder, picture)));
    return loaded;
}

CheckReport check_case(const fs::path& folder) {
    return Check(folder).run();
}

}  // namespace theatron::cases
