// SPDX-License-Identifier: Apache-2.0
// DICOM images, meshes and pictures of other programs, read by large libraries in sandboxed
// processes (docs/decisions/foreign-files.md). This module checks the answers of those processes.
//
// One thread at a time uses an object. All functions throw Error with one sentence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cases/dicom_slice.h"
#include "image/image.h"
#include "medical/mesh.h"
#include "sandbox/child.h"
#include "sandbox/inside.h"

namespace theatron::cases {

// Larger files are refused before they are read.
inline constexpr std::size_t max_dicom_file_bytes = std::size_t(256) << 20;
inline constexpr std::size_t max_mesh_file_bytes = std::size_t(256) << 20;
inline constexpr std::size_t max_picture_file_bytes = std::size_t(128) << 20;
inline constexpr std::size_t max_reader_memory_bytes = std::size_t(2) << 30;
inline constexpr std::size_t max_meshes_in_file = 1024;
inline constexpr std::size_t max_buffers_of_file = 64;

// A file that holds nothing that is imported, though nothing in it is damaged: a picture in colour
// or a report beside the series, points instead of a surface, other content than its name says. It
// is left out, and the others are imported.
class NotForUs : public Error {
public:
    // `reason` as in "holds no triangles".
    NotForUs(const std::filesystem::path& file, std::string reason);
    const std::string& reason() const { return reason_; }

private:
    std::string reason_;
};

class ExchangedFile;

// Reads DICOM files, one after another, in one process.
class DicomFiles {
public:
    DicomFiles();
    ~DicomFiles();

    // The image in the file, or the images of one that holds several with a place of each. Throws
    // NotForUs, or Error where the file is damaged.
    std::vector<DicomSlice> read(const std::filesystem::path& file);

    // The texts that identify, in the file that was read last, also where it was left out.
    const std::vector<Identifier>& identifiers() const { return identifiers_; }

private:
    std::unique_ptr<ExchangedFile> input_;
    std::unique_ptr<sandbox::Child> child_;
    std::vector<Identifier> identifiers_;
};

// True if the file begins as DICOM does, with a preamble (PS3.10) or without, or if its name ends
// like a DICOM file's, packed (.dcm.gz) or not.
bool is_dicom_file(const std::filesystem::path& file);
// STL, OBJ, PLY, glTF (.glb, .gltf), by the end of the name.
bool is_mesh_file(const std::filesystem::path& file);

// PNG, JPEG, by the end of the name.
bool is_picture_file(const std::filesystem::path& file);

struct NamedMesh {
    std::string name;    // that the file gives it; may be empty
    medical::Mesh mesh;  // as in the file: not welded, no normals, the file's unit and axes
};
struct MeshFile {
    std::vector<NamedMesh> meshes;              // at least one
    std::vector<std::string> hidden;            // names of those that are hidden in it (glTF)
    std::vector<std::filesystem::path> beside;  // files with its corners (glTF)
};
// All surfaces in a file. Throws NotForUs, or Error where the file is damaged.
MeshFile read_mesh_file(const std::filesystem::path& file);

// The picture in a file as medical/picture.h has it: upright, with sides that it allows. Throws
// NotForUs, or Error where the file is damaged.
ColorImage read_picture_file(const std::filesystem::path& file);

// A mesh as its reader hands it over. Safe for any bytes.
inline constexpr std::size_t max_loose_vertices = 3 * medical::max_mesh_triangles;
Result<NamedMesh> decode_named_mesh(ByteView bytes);

// For run_as_child(): what DicomFiles, read_mesh_file() and read_picture_file() need.
void serve_dicom(sandbox::Inside& inside);
void serve_meshes(sandbox::Inside& inside);
void serve_pictures(sandbox::Inside& inside);
inline constexpr sandbox::Reader foreign_readers[] = {
    {"dicom", sandbox::Profile::library, serve_dicom},
    {"mesh", sandbox::Profile::library, serve_meshes},
    {"picture", sandbox::Profile::library, serve_pictures}};

}  // namespace theatron::cases
