// SPDX-License-Identifier: Apache-2.0
#include "cases/synth_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "base/error.h"
#include "cases/case_folder.h"
#include "cases/dicom_writer.h"
#include "cases/new_folder.h"
#include "cases/synth_body.h"
#include "cases/synth_random.h"
#include "files/file_bytes.h"
#include "medical/isosurface.h"
#include "medical/mesh_shaping.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Mesh;
using medical::Part;
using medical::Role;
using medical::VolumeGrid;

VolumeGrid grid_around(medical::Box box, double step) {
    VolumeGrid grid;
    const Vec3 size = box.high_mm - box.low_mm;
    grid.columns = int(size.x / step) + 2;
    grid.rows = int(size.y / step) + 2;
    grid.slices = int(size.z / step) + 2;
    grid.origin_mm = box.low_mm;
    grid.column_step_mm = {step, 0, 0};
    grid.row_step_mm = {0, step, 0};
    grid.slice_step_mm = {0, 0, step};
    return grid;
}

Mesh surface(medical::Box box, double step, std::size_t max_triangles,
             const std::function<double(Vec3)>& distance_at) {
    const VolumeGrid grid = grid_around(box, step);
    Mesh mesh = medical::isosurface(grid, [&](int slice, std::span<float> out) {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] =
                float(distance_at(grid.point_at(double(i % std::size_t(grid.columns)),
                                                double(i / std::size_t(grid.columns)), slice)));
    });
    medical::simplify(mesh, max_triangles);
    medical::compute_normals(mesh);
    return mesh;
}

Mesh vessel_surface(medical::Box box, const std::vector<VesselPiece>& pieces, double step,
                    std::size_t max_triangles) {
    const VolumeGrid grid = grid_around(box, step);
    Mesh mesh = medical::isosurface(grid, [&](int slice, std::span<float> out) {
        vessel_layer(grid, slice, pieces, 2 * step, out);
    });
    medical::smooth(mesh, 2);
    medical::simplify(mesh, max_triangles);
    medical::compute_normals(mesh);
    return mesh;
}

std::vector<Mesh> segment_surfaces(const SynthLiver& liver, std::size_t max_triangles) {
    const VolumeGrid grid = grid_around(liver.box(), 2.5);
    const auto point = [&](int slice, std::size_t i) {
        return grid.point_at(double(i % std::size_t(grid.columns)),
                             double(i / std::size_t(grid.columns)), slice);
    };
    const std::size_t layer = std::size_t(grid.columns) * std::size_t(grid.rows);
    std::vector<float> to_liver(grid.size());
    for (int slice = 0; slice < grid.slices; ++slice)
        for (std::size_t i = 0; i < layer; ++i)
            to_liver[std::size_t(slice) * layer + i] = float(liver.distance(point(slice, i)));
    std::vector<Mesh> meshes;
    for (int segment = 1; segment <= liver_segments; ++segment) {
        Mesh mesh = medical::isosurface(grid, [&](int slice, std::span<float> out) {
            for (std::size_t i = 0; i < layer; ++i)
                out[i] = float(liver.segment_distance(
                    point(slice, i), segment, double(to_liver[std::size_t(slice) * layer + i])));
        });
        medical::smooth(mesh, 6);  // the samples' steps along the edges between segments
        medical::simplify(mesh, max_triangles);
        medical::compute_normals(mesh);
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

medical::Box box_of(const SynthTumour& tumour) {
    const double reach = 1.6 * tumour.radius_mm;
    const Vec3 room{reach, reach, reach};
    return {tumour.center_mm - room, tumour.center_mm + room};
}

Part part(std::string name, Role role) {
    Part p;
    p.name = std::move(name);
    p.role = role;
    p.color = medical::usual_color(role);
    p.opacity = medical::usual_opacity(role);
    return p;
}

// Colours that differ also for colour-blind eyes (Okabe and Ito), and a grey.
constexpr Rgb segment_colors[liver_segments] = {{230, 159, 0},   {86, 180, 233}, {0, 158, 115},
                                                {240, 228, 66},  {0, 114, 178},  {213, 94, 0},
                                                {204, 121, 167}, {153, 153, 153}};

// A UUID of DICOM's kind out of the seed.
std::string uid(std::uint64_t seed, std::uint64_t what) {
    return "2.25." + std::to_string(mixed(mixed(seed + 77) + what));
}

void write_series(const SynthCase& synth, const fs::path& folder, const Progress& progress) {
    const std::uint64_t seed = synth.seed;
    const medical::Volume& volume = synth.volume;
    const VolumeGrid& grid = volume.grid;
    DicomSlice slice;
    slice.series_uid = uid(seed, 2);
    slice.frame_uid = uid(seed, 3);
    slice.modality = "CT";
    slice.columns = grid.columns;
    slice.rows = grid.rows;
    slice.right = {1, 0, 0};
    slice.down = {0, 1, 0};
    slice.column_spacing_mm = grid.column_step_mm.x;
    slice.row_spacing_mm = grid.row_step_mm.y;
    slice.has_place = slice.has_window = slice.deidentified = true;
    slice.intercept = volume.intercept;
    slice.window = volume.window;
    DicomTexts texts;
    texts.study_uid = uid(seed, 1);
    texts.series_description = "Generated, no patient";
    texts.patient_name = "Generated";
    texts.patient_id = "GENERATED";
    for (int k = 0; k < grid.slices; ++k) {
        progress("Writing", double(k) / grid.slices);
        slice.position_mm = grid.point_at(0, 0, k);
        const auto begin = volume.samples.begin() + std::ptrdiff_t(grid.index(0, 0, k));
        slice.samples.assign(begin, begin + std::ptrdiff_t(grid.columns) * grid.rows);
        texts.instance = k + 1;
        texts.instance_uid = uid(seed, 100 + std::uint64_t(k));
        char name[32];
        std::snprintf(name, sizeof(name), "%04d.dcm", k + 1);
        files::write_file(folder / name, write_dicom(slice, texts));
    }
}

}  // namespace

SynthCase make_synth_case(const SynthOptions& options, const Progress& progress) {
    progress("Making organs", 0);
    SynthCase synth;
    synth.seed = options.seed;
    const SynthLiver liver(options.seed);
    synth.vessels = grow_vessels(liver, options.seed);
    const std::vector<SynthTumour> tumours = place_tumours(liver, synth.vessels, options.seed);
    const std::size_t budget = options.max_triangles;
    constexpr double part_count = 16;

    const auto add = [&](Part p, Mesh mesh) {
        p.file = "part_" + std::to_string(synth.meshes.size() + 1) + mesh_extension;
        synth.manifest.parts.push_back(std::move(p));
        synth.meshes.push_back(std::move(mesh));
        progress("Making organs", double(synth.meshes.size()) / part_count);
    };
    add(part("liver", Role::shell),
        surface(liver.box(), 1.8, budget, [&](Vec3 p) { return liver.distance(p); }));
    add(part("portal vein", Role::portal_vein),
        vessel_surface(liver.box(), synth.vessels.portal_vein, 0.9, budget));
    add(part("hepatic artery", Role::artery),
        vessel_surface(liver.box(), synth.vessels.artery, 0.65, budget));
    add(part("hepatic veins", Role::hepatic_vein),
        vessel_surface(liver.box(), synth.vessels.hepatic_veins, 0.9, budget));
    Part bladder = part("gall bladder", Role::other);
    bladder.color = {92, 150, 84};
    add(std::move(bladder), surface(liver.box(), 1.5, budget / 8,
                                    [&](Vec3 p) { return liver.gall_bladder_distance(p); }));
    for (std::size_t i = 0; i < tumours.size(); ++i)
        add(part("tumour " + std::to_string(i + 1), Role::tumour),
            surface(box_of(tumours[i]), 0.8, budget / 10,
                    [&](Vec3 p) { return distance(p, tumours[i]); }));
    const std::vector<Mesh> segments = segment_surfaces(liver, budget / 4);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Part p = part("segment " + std::to_string(i + 1), Role::other);
        p.color = segment_colors[i];
        p.opacity = 0;  // hidden until somebody shows them
        add(std::move(p), segments[i]);
    }
    synth.volume = scan_body(liver, synth.vessels, tumours, options, progress);
    synth.manifest.name = "Generated liver " + std::to_string(options.seed);
    synth.manifest.deidentified = true;
    synth.manifest.license = "CC0 1.0";
    synth.manifest.credit = "Generated by Theatron; no person's data.";
    synth.manifest.series = {{"CT", "CT", std::string("series_1") + volume_extension, {}}};
    return synth;
}

void write_synth_case(const SynthCase& synth, const fs::path& folder, const fs::path& dicom,
                      const Progress& progress) {
    NewFolder target(folder);
    std::optional<NewFolder> images;
    if (!dicom.empty()) {
        images.emplace(dicom);
        write_series(synth, images->path(), progress);
    }
    for (std::size_t i = 0; i < synth.meshes.size(); ++i)
        files::write_file(target.path() / synth.manifest.parts[i].file,
                          medical::encode_mesh(synth.meshes[i]));
    files::write_file(target.path() / synth.manifest.series[0].file,
                      medical::encode_volume(synth.volume));
    files::write_file(target.path() / manifest_name, as_bytes(manifest_text(synth.manifest)));
    progress("Writing", 1);
    if (images)
        images->keep();
    target.keep();
}

}  // namespace theatron::cases
