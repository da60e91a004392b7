// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/foreign_files.h"
#include "cases/foreign_reply.h"
#include "cases/import_parts.h"
#include "cases/manifest.h"
#include "cases/quoted_path.h"
#include "medical/mesh_measures.h"
#include "medical/mesh_shaping.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Axes;
using medical::Case;
using medical::Mesh;
using medical::Part;
using medical::Unit;

struct Frame {
    Unit unit = Unit::mm;
    Axes axes = Axes::lps;
};

// 3D Slicer writes the axes into a comment: "SPACE=RAS" or "SPACE=LPS".
bool says_ras(const fs::path& file) {
    char head[4096] = {};
    std::ifstream(file, std::ios::binary).read(head, sizeof(head));
    return std::string_view(head, sizeof(head)).find("SPACE=RAS") != std::string_view::npos;
}

Frame frame_of(const fs::path& file, const std::optional<Case>& manifest,
               const ImportOptions& options) {
    Frame frame;
    if (const std::string end = lower_extension(file); end == ".glb" || end == ".gltf")
        frame = {Unit::m, Axes::y_up};
    else if (says_ras(file))
        frame.axes = Axes::ras;
    if (manifest)
        frame = {manifest->unit, manifest->axes};
    return {options.unit.value_or(frame.unit), options.axes.value_or(frame.axes)};
}

void to_patient(Mesh& mesh, Frame frame) {
    const float scale = frame.unit == Unit::mm ? 1.0f : frame.unit == Unit::cm ? 10.0f : 1000.0f;
    for (medical::Vec3f& p : mesh.positions) {
        p = {p.x * scale, p.y * scale, p.z * scale};
        if (frame.axes == Axes::ras)
            p = {-p.x, -p.y, p.z};
        else if (frame.axes == Axes::y_up)
            p = {p.x, -p.z, p.y};
    }
}

bool is_near(const Mesh& mesh) {
    const auto limit = float(medical::max_coordinate_mm);
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](medical::Vec3f p) {
        return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
    });
}

void finish(Mesh& mesh, std::size_t max_triangles) {
    medical::weld(mesh);
    medical::simplify(mesh, max_triangles);
    const medical::MeshShape shape = medical::shape_of(mesh);
    if (shape.closed && shape.volume_mm3 < 0)
        for (medical::Triangle& t : mesh.triangles)
            std::swap(t[1], t[2]);
    medical::compute_normals(mesh);
}

const Part* named_in(const std::optional<Case>& manifest, const fs::path& file) {
    if (!manifest)
        return nullptr;
    for (const Part& part : manifest->parts)
        if (part.file == file.filename())
            return &part;
    return nullptr;
}

void add_part(const fs::path& file, Part part, Mesh mesh, const ImportOptions& options,
              std::vector<ImportedPart>& parts, std::vector<std::string>& remarks) {
    const std::string in_file = " in " + quoted_path(file);
    if (parts.size() == max_parts)
        throw Error("The source holds more than " + std::to_string(max_parts) +
                    " surfaces; the next one is" + in_file + ".");
    if (!is_near(mesh))
        throw Error("The surface '" + part.name + "'" + in_file +
                    " lies more than 100 m away; give its unit with --unit.");
    const std::size_t before = mesh.triangles.size();
    finish(mesh, options.max_triangles);
    if (mesh.triangles.empty()) {
        remarks.push_back("The surface '" + part.name + "'" + in_file +
                          " has no area and is left out.");
        return;
    }
    if (mesh.triangles.size() < before * 9 / 10)
        remarks.push_back("The surface '" + part.name + "'" + in_file + " was simplified from " +
                          std::to_string(before) + " to " + std::to_string(mesh.triangles.size()) +
                          " triangles.");
    parts.push_back({std::move(part), std::move(mesh)});
}

void append(Mesh& mesh, const Mesh& more) {
    const auto begin = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
    for (const medical::Triangle& t : more.triangles)
        mesh.triangles.push_back({t[0] + begin, t[1] + begin, t[2] + begin});
}

bool is_closed(Mesh mesh) {
    medical::weld(mesh);
    return medical::shape_of(mesh).closed;
}

// Programs part one organ into groups, for its colours or its sides. Open ones that are closed
// together are one part.
void join_open_groups(std::vector<NamedMesh>& meshes) {
    NamedMesh joined;
    std::size_t count = 0;
    std::vector<bool> is_open;
    for (const NamedMesh& one : meshes) {
        is_open.push_back(!is_closed(one.mesh));
        if (!is_open.back())
            continue;
        append(joined.mesh, one.mesh);
        joined.name = count++ == 0 ? one.name : joined.name;
    }
    if (count < 2 || !is_closed(joined.mesh))
        return;
    std::vector<NamedMesh> kept;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (!is_open[i])
            kept.push_back(std::move(meshes[i]));
    kept.insert(kept.begin(), std::move(joined));
    meshes = std::move(kept);
}

// Surfaces that the program that wrote the file does not show are not shown here, either.
void remark_on_hidden(const fs::path& file, const std::vector<std::string>& names,
                      std::vector<std::string>& remarks) {
    if (names.empty())
        return;
    const std::vector<fs::path> shown(names.begin(), names.end());
    remarks.push_back(first_names(shown) + (names.size() == 1 ? " is" : " are") + " hidden in " +
                      quoted_path(file) +
                      " and left out; show what you need there and export it "
                      "again.");
}

}  // namespace

Part usual_part(const std::string& name) {
    Part part;
    part.name = clean_text(name, max_name_characters);
    std::replace(part.name.begin(), part.name.end(), '_', ' ');
    part.role = medical::role_of_name(part.name);
    part.color = medical::usual_color(part.role);
    part.opacity = medical::usual_opacity(part.role);
    return part;
}

void remark_on_size(const std::vector<ImportedPart>& parts, std::vector<std::string>& remarks) {
    constexpr double least_mm = 10, most_mm = 2000;
    double largest_mm = 0;
    for (const ImportedPart& one : parts) {
        const medical::Box box = medical::box_of(one.mesh);
        const Vec3 size = box.high_mm - box.low_mm;
        largest_mm = std::max({largest_mm, size.x, size.y, size.z});
    }
    if (parts.empty() || (largest_mm >= least_mm && largest_mm <= most_mm))
        return;
    char text[100];
    std::snprintf(text, sizeof(text), "The largest part is %.3g mm long", largest_mm);
    remarks.push_back(std::string(text) + ", which no organ is; check the unit (--unit).");
}

std::vector<ImportedPart> import_meshes(const std::vector<fs::path>& files,
                                        const std::optional<Case>& manifest,
                                        const ImportOptions& options, LeftOut& left_out,
                                        std::set<fs::path>& beside,
                                        std::vector<std::string>& remarks,
                                        const Progress& progress) {
    if (files.size() > max_parts)
        throw Error("The source holds " + std::to_string(files.size()) +
                    " files with surfaces, and a case has at most " + std::to_string(max_parts) +
                    " parts; take the others out of the folder.");
    std::vector<ImportedPart> parts;
    for (std::size_t i = 0; i < files.size(); ++i) {
        progress("Reading surfaces", double(i) / double(files.size()));
        const Frame frame = frame_of(files[i], manifest, options);
        MeshFile file;
        try {
            file = read_mesh_file(files[i]);
        } catch (const NotForUs& error) {
            left_out.add(files[i], error.reason());
        }
        beside.insert(file.beside.begin(), file.beside.end());
        remark_on_hidden(files[i], file.hidden, remarks);
        if (file.meshes.size() > 1 && lower_extension(files[i]) == ".obj")
            join_open_groups(file.meshes);
        for (NamedMesh& named : file.meshes) {
            const bool alone = file.meshes.size() == 1 || named.name.empty();
            Part part = usual_part(alone ? files[i].stem().string() : named.name);
            if (const Part* known = named_in(manifest, files[i]); known && alone)
                part = *known;
            to_patient(named.mesh, frame);
            add_part(files[i], std::move(part), std::move(named.mesh), options, parts, remarks);
        }
    }
    progress("Reading surfaces", 1);
    remark_on_size(parts, remarks);
    return parts;
}

}  // namespace theatron::cases
