// SPDX-License-Identifier: Apache-2.0
// Surfaces of other programs, as their reader's process gives them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/exchanged_file.h"
#include "cases/foreign_files.h"
#include "cases/foreign_reply.h"
#include "cases/quoted_path.h"

namespace theatron::cases {

namespace fs = std::filesystem;

bool is_mesh_file(const fs::path& file) {
    const std::string extension = lower_extension(file);
    for (const char* known : {".stl", ".obj", ".ply", ".glb", ".gltf"})
        if (extension == known)
            return true;
    return false;
}

namespace {

constexpr std::size_t mesh_area_bytes = std::size_t(512) << 20;

// The file of this name in the folder of `mesh`, if it is there and its ending says that it holds
// numbers: a surface cannot make a shape of just any file beside it. Throws NotForUs for a link.
std::optional<fs::path> buffer_beside(const fs::path& mesh, const std::string& name) {
    const fs::path file = mesh.parent_path() / name;
    const bool is_name = name.find_first_of(std::string_view("/\\\0", 3)) == name.npos;
    const std::string extension = lower_extension(name);
    if (!is_name || (extension != ".bin" && extension != ".glbin" && extension != ".glbuf"))
        return std::nullopt;
    std::error_code failed;
    const fs::file_status status = fs::symlink_status(file, failed);
    if (fs::is_symlink(status))
        throw NotForUs(mesh, "keeps its corners in '" + clean_text(name, 60) +
                                 "', which is a link and not followed; put the file itself there, "
                                 "or export it as one file (.glb)");
    return fs::is_regular_file(status) ? std::optional(file) : std::nullopt;
}

// The sentences name the extension, property, version or file of glTF.
[[noreturn]] void refuse(const fs::path& path, Answer what, const std::string& said) {
    const std::string name = "'" + clean_text(said, 60) + "'";
    switch (what) {
        case Answer::extension:
            throw NotForUs(path, "needs the glTF extension " + name +
                                     ", which is not read; export it without");
        case Answer::version:
            throw NotForUs(path, "is of version " + name +
                                     " of glTF, which is not read; export it as glTF 2.0");
        case Answer::other_buffer:
            throw NotForUs(path, "keeps its corners in " + name +
                                     ", which must lie beside it and end in .bin; copy it there, "
                                     "or export it as one file (.glb)");
        case Answer::property:
            throw Error(quoted_path(path) + " has an impossible " + name +
                        " (a property of glTF); export it again.");
        default:
            refuse(path, what);
    }
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        lines.push_back(clean_text(text.substr(at, end - at), 64));
    }
    return lines;
}

}  // namespace

MeshFile read_mesh_file(const fs::path& path) {
    require_size(path, max_mesh_file_bytes, "simplify the surface in the program that wrote it");
    ExchangedFile input;
    input.load(path, max_mesh_file_bytes);
    sandbox::Limits limits;
    limits.memory_bytes = max_reader_memory_bytes;
    limits.area_bytes = mesh_area_bytes;
    limits.cpu_seconds = 60;
    limits.answer = 120s;
    sandbox::Child child("mesh", input.descriptor(), "the file " + quoted_path(path), limits);
    child.send(as_bytes(lower_extension(path).substr(1)));

    constexpr std::size_t longest_text = 200'000;
    const std::byte next{1};
    MeshFile found;
    while (true) {
        const Reply reply = reply_of(child);
        // The child can still change the shared memory: a copy is checked, not the memory itself.
        const Bytes copy(reply.content.begin(), reply.content.end());
        const std::string said(reinterpret_cast<const char*>(copy.data()),
                               std::min(copy.size(), longest_text));
        if (reply.what == Answer::end) {
            found.hidden = lines_of(said);
            break;
        }
        if (found.meshes.size() == max_meshes_in_file)
            break;  // further ones are left out
        if (reply.what == Answer::other_buffer) {
            const std::optional<fs::path> beside = buffer_beside(path, said);
            if (!beside)
                refuse(path, reply.what, said);
            if (found.beside.size() == max_buffers_of_file)
                throw NotForUs(path, "needs more than " + std::to_string(max_buffers_of_file) +
                                         " files of corners; store it as one .glb");
            require_size(*beside, max_mesh_file_bytes,
                         "simplify the surface in the program that wrote it");
            input.load(*beside, max_mesh_file_bytes);
            found.beside.push_back(*beside);
        } else if (reply.what != Answer::content) {
            refuse(path, reply.what, said);
        } else {
            Result<NamedMesh> mesh = decode_named_mesh(copy);
            if (!mesh)
                throw Error(quoted_path(path) +
                            " has impossible vertices or triangles; export it again.");
            found.meshes.push_back(std::move(*mesh));
        }
        child.send({&next, 1});
    }
    if (found.meshes.empty())
        refuse(path, Answer::no_triangles);
    return found;
}

Result<NamedMesh> decode_named_mesh(ByteView bytes) {
    ByteReader reader(bytes);
    NamedMesh named;
    const ByteView name = reader.get_bytes(reader.get<std::uint8_t>());
    named.name = clean_text({reinterpret_cast<const char*>(name.data()), name.size()}, 64);
    const std::size_t vertices = reader.get<std::uint32_t>(),
                      triangles = reader.get<std::uint32_t>();
    if (!reader.ok())
        return Status::truncated;
    if (vertices > max_loose_vertices || triangles > medical::max_mesh_triangles)
        return Status::too_large;
    if (reader.rest().size() != 12 * (vertices + triangles))
        return Status::size_mismatch;
    named.mesh.positions.resize(vertices);
    const std::byte* at = reader.rest().data();
    for (medical::Vec3f& p : named.mesh.positions) {
        std::memcpy(&p, at, 12);
        at += 12;
        if (!(std::abs(p.x) <= 1e6f && std::abs(p.y) <= 1e6f && std::abs(p.z) <= 1e6f))
            return Status::malformed;
    }
    named.mesh.triangles.resize(triangles);
    for (medical::Triangle& t : named.mesh.triangles)
        for (std::uint32_t& v : t) {
            v = load_le<std::uint32_t>(at);
            at += 4;
            if (v >= vertices)
                return Status::malformed;
        }
    return named;
}

}  // namespace theatron::cases
