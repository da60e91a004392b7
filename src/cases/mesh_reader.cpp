// SPDX-License-Identifier: Apache-2.0
// Reads STL, PLY and glTF with readers of our own (mesh_files.h), packed corners of glTF with Draco
// and meshoptimizer, OBJ with assimp. Runs in a sandbox, because the libraries are large and the
// files are untrusted.
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <new>

#include "cases/foreign_answer.h"
#include "cases/foreign_files.h"
#include "cases/foreign_input.h"
#include "cases/mesh_files.h"
#include "cases/text_words.h"

namespace theatron::cases {
namespace {

constexpr std::size_t max_name_bytes = 255;
constexpr int deepest_node = 64;

class Stream final : public Assimp::IOStream {
public:
    // Without the mark that some programs put before their text, since the library knows none.
    explicit Stream(int descriptor)
        : descriptor_(descriptor), size_(std::size_t(lseek(descriptor, 0, SEEK_END))) {
        char head[3];
        if (pread(descriptor, head, 3, 0) == 3 && std::memcmp(head, "\xef\xbb\xbf", 3) == 0)
            begin_ = 3;
        size_ -= begin_;
    }

    std::size_t Read(void* out, std::size_t size, std::size_t count) override {
        if (size == 0 || count > size_ || size > size_)
            count = size == 0 ? 0 : std::min(count, size_ / size);
        std::size_t done = 0;
        const std::size_t wanted = std::min(size * count, size_ - place_);
        while (done < wanted) {
            const ssize_t got = pread(descriptor_, static_cast<char*>(out) + done, wanted - done,
                                      off_t(begin_ + place_ + done));
            if (got <= 0)
                break;
            done += std::size_t(got);
        }
        place_ += done;
        return size == 0 ? 0 : done / size;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_SET   ? 0
                                 : origin == aiOrigin_CUR ? place_
                                                          : size_;
        std::size_t to;
        if (__builtin_add_overflow(base, offset, &to) || to > size_)
            return aiReturn_FAILURE;
        place_ = to;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return place_; }
    std::size_t FileSize() const override { return size_; }
    void Flush() override {}

private:
    int descriptor_;
    std::size_t begin_ = 0, size_, place_ = 0;
};

// The one file that there is; those that it refers to are not there.
class OneFile final : public Assimp::IOSystem {
public:
    OneFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

    bool Exists(const char* name) const override { return name_ == name; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char*) override {
        return name_ == name ? new Stream(descriptor_) : nullptr;
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    int descriptor_;
    std::string name_;
};

// Only the format that is asked for: fewer ways to be misled by a file's content.
void keep_loaders(Assimp::Importer& importer, const std::string& extension) {
    std::vector<Assimp::BaseImporter*> others;
    for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        // Extensions are parted by blanks.
        const std::string extensions =
            " " + std::string(about && about->mFileExtensions ? about->mFileExtensions : "") + " ";
        if (extensions.find(" " + extension + " ") == std::string::npos)
            others.push_back(importer.GetImporter(i));
    }
    for (Assimp::BaseImporter* const other : others)
        importer.UnregisterLoader(other);
}

// Hands one mesh after another to the parent, each when the next is asked for.
class Sender {
public:
    explicit Sender(sandbox::Inside& inside) : inside_(inside) {}

    // False once no further one is wanted.
    bool send(const NamedMesh& named) {
        const medical::Mesh& mesh = named.mesh;
        if (!wanted_ || mesh.triangles.empty())
            return wanted_;
        const std::size_t name_bytes = std::min<std::size_t>(named.name.size(), max_name_bytes);
        const std::size_t size =
            1 + name_bytes + 8 + 12 * mesh.positions.size() + 12 * mesh.triangles.size();
        if (size > inside_.area().size()) {
            answer(inside_, Answer::too_large);
            return wanted_ = false;
        }
        std::byte* at = inside_.area().data();
        *at++ = std::byte(name_bytes);
        std::memcpy(at, named.name.data(), name_bytes);
        at += name_bytes;
        store_le(at, std::uint32_t(mesh.positions.size()));
        store_le(at + 4, std::uint32_t(mesh.triangles.size()));
        at += 8;
        for (const medical::Vec3f& p : mesh.positions) {
            const float coordinates[] = {p.x, p.y, p.z};
            std::memcpy(at, coordinates, 12);
            at += 12;
        }
        for (const medical::Triangle& t : mesh.triangles)
            for (const std::uint32_t corner : t) {
                store_le(at, corner);
                at += 4;
            }
        answer(inside_, Answer::content, size);
        return wanted_ = inside_.receive().has_value();
    }
    bool wanted() const { return wanted_; }

private:
    sandbox::Inside& inside_;
    bool wanted_ = true;
};

void add(const aiMesh& mesh, const aiMatrix4x4& place, medical::Mesh& out) {
    const auto first = std::uint32_t(out.positions.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D p = place * mesh.mVertices[i];
        out.positions.push_back({p.x, p.y, p.z});
    }
    const bool mirrored = place.Determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices == 3)
            out.triangles.push_back({first + face.mIndices[0],
                                     first + face.mIndices[mirrored ? 2 : 1],
                                     first + face.mIndices[mirrored ? 1 : 2]});
    }
}

// The library makes a mesh of each material; an organ is all meshes of a node.
void send(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, int depth,
          Sender& sender) {
    if (depth > deepest_node || !sender.wanted())
        return;
    const aiMatrix4x4 place = parent * node.mTransformation;
    NamedMesh named;
    named.name.assign(node.mName.data, node.mName.length);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        if (named.name.empty())
            named.name.assign(mesh.mName.data, mesh.mName.length);
        add(mesh, place, named.mesh);
    }
    sender.send(named);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        send(scene, *node.mChildren[i], place, depth + 1, sender);
}

// The library takes a polygon of fewer than three corners for a line or a point: at the file's end
// it is the rest of one.
bool ends_in_polygon(int descriptor) {
    char tail[512];
    const off_t size = lseek(descriptor, 0, SEEK_END);
    const off_t begin = std::max<off_t>(0, size - off_t(sizeof(tail)));
    const ssize_t got = pread(descriptor, tail, std::size_t(size - begin), begin);
    std::string_view text(tail, std::size_t(std::max<ssize_t>(got, 0)));
    text = text.substr(0, text.find_last_not_of("\r\n") + 1);
    const std::size_t line_end = text.find_last_of("\r\n");
    if (line_end == text.npos || text.substr(0, line_end).ends_with('\\'))
        return false;
    TextWords words(as_bytes(text.substr(line_end)));
    if (words.next() != "f")
        return false;
    words.next();
    words.next();
    return words.next().empty();
}

Answer read_obj(int descriptor, Sender& sender) {
    if (ends_in_polygon(descriptor))
        return Answer::lacks;
    const std::string name = "mesh.obj";
    Assimp::Importer importer;
    keep_loaders(importer, "obj");
    importer.SetIOHandler(new OneFile(descriptor, name));
    const aiScene* scene = nullptr;
    try {
        scene = importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
    }
    if (!scene) {
        // The library turns a lack of memory into a text.
        if (std::strstr(importer.GetErrorString(), "bad_alloc"))
            throw std::bad_alloc();
        return Answer::unreadable;
    }
    send(*scene, *scene->mRootNode, aiMatrix4x4(), 0, sender);
    return Answer::end;
}

}  // namespace

void serve_meshes(sandbox::Inside& inside) {
    const std::optional<Bytes> request = inside.receive();
    if (!request)
        return;
    const std::string extension(reinterpret_cast<const char*>(request->data()), request->size());
    Sender sender(inside);
    const TakeMesh take = [&](const NamedMesh& named) { return sender.send(named); };
    std::string said;
    const glb::FindBeside find_beside = [&](const std::string& name) -> std::optional<Bytes> {
        answer(inside, Answer::other_buffer, as_bytes(name));
        if (!inside.receive())
            return std::nullopt;
        return bytes_of(inside, max_mesh_file_bytes);
    };
    Answer result = Answer::no_mesh;
    if (extension == "obj") {
        result = read_obj(inside.input(), sender);
    } else {
        const Bytes file = bytes_of(inside, max_mesh_file_bytes);
        if (extension == "stl")
            result = read_stl(file, take);
        else if (extension == "ply")
            result = read_ply(file, take);
        else
            result = read_gltf(file, take, said, find_beside, glb::unpack_draco);
    }
    if (sender.wanted())
        answer(inside, result, as_bytes(said));
    while (inside.receive()) {
    }
}

}  // namespace theatron::cases
