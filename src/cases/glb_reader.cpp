// SPDX-License-Identifier: Apache-2.0
// glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/outside_text.h"
#include "cases/glb_accessor.h"
#include "cases/glb_buffers.h"
#include "cases/glb_place.h"
#include "cases/mesh_files.h"

namespace theatron::cases {
namespace {

using glb::Json;
using glb::Matrix;

constexpr int deepest_node = 64;
constexpr std::size_t max_nodes = 100'000;
constexpr std::size_t hidden_names = 100;  // further ones are counted only

// Extensions that may be needed without changing where a corner lies.
bool is_harmless(const std::string& name) {
    for (const char* begin : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_",
                              "EXT_lights_", "KHR_xmp", "MSFT_texture_", "ADOBE_materials_"})
        if (name.starts_with(begin))
            return true;
    return name == "KHR_mesh_quantization";
}

constexpr const char* visibility = "KHR_node_visibility";

bool is_read(const std::string& name) {
    return is_harmless(name) || name == glb::draco || name == glb::meshopt ||
           name == glb::meshopt_successor || name == visibility;
}

// The node and all below it.
bool is_hidden(const Json& node) {
    const Json& about = glb::extension_in(node, visibility);
    const auto visible = about.is_object() ? about.find("visible") : about.end();
    return about.is_object() && visible != about.end() && *visible == false;
}

// The version that a reader must know; empty where it knows it: 2.0, or 2.1 in a form that 2.0
// reads. Files that say none are taken for it.
std::string unknown_version(const Json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end())
        return "";
    const std::string least = glb::text_of(*asset, "minVersion");
    if (!least.empty() && least != "2.0" && !least.starts_with("1."))
        return least;
    const std::string version = glb::text_of(*asset, "version");
    return version.empty() || version.starts_with("2.") ? "" : version;
}

class Scene {
public:
    Scene(const Json& root, glb::Buffers& buffers, const TakeMesh& take, std::string& said,
          glb::UnpackDraco unpack_draco)
        : root_(root), accessors_(root, buffers, said, unpack_draco), take_(take), said_(said) {}

    Answer walk() {
        const Json& nodes = glb::list_of(root_, "nodes");
        if (nodes.size() > max_nodes)
            return Answer::too_large;
        visited_.resize(nodes.size());
        const Matrix here{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        for (const std::size_t node : first_nodes(nodes)) {
            if (const Answer sent = send(nodes, node, here, 0, false); sent != Answer::content)
                return sent;
        }
        said_ = hidden_;
        return any_ ? Answer::end : hidden_.empty() ? Answer::no_triangles : Answer::hidden;
    }

private:
    std::vector<std::size_t> first_nodes(const Json& nodes) const {
        const Json& scenes = glb::list_of(root_, "scenes");
        std::vector<std::size_t> first;
        const std::size_t scene = glb::index_of(root_, "scene").value_or(0);
        if (scene < scenes.size()) {
            for (const Json& node : glb::list_of(scenes[scene], "nodes"))
                first.push_back(glb::whole_of(node));
            return first;
        }
        // Without a scene: all that are no children.
        std::vector<bool> is_child(nodes.size());
        for (const Json& node : nodes)
            for (const Json& child : glb::list_of(node, "children"))
                if (const std::size_t at = glb::whole_of(child); at < nodes.size())
                    is_child[at] = true;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!is_child[i])
                first.push_back(i);
        return first;
    }

    Answer send(const Json& nodes, std::size_t at, const Matrix& parent, int depth, bool hidden) {
        // Each node has one place in the tree.
        if (at >= nodes.size() || visited_[at] || depth > deepest_node)
            return Answer::unreadable;
        visited_[at] = true;
        const Json& node = nodes[at];
        Matrix local;
        if (const char* const impossible = glb::read_place(node, local)) {
            said_ = impossible;
            return Answer::property;
        }
        if (glb::has_extension(node, "EXT_mesh_gpu_instancing")) {
            said_ = "EXT_mesh_gpu_instancing";
            return Answer::extension;
        }
        const Matrix place = glb::product(parent, local);
        hidden = hidden || is_hidden(node);
        if (const auto mesh = glb::index_of(node, "mesh")) {
            const Json& meshes = glb::list_of(root_, "meshes");
            if (*mesh >= meshes.size())
                return Answer::unreadable;
            if (hidden)
                note_hidden(name_of(node, meshes[*mesh]), at);
            else if (node.contains("skin"))
                return Answer::skin;
            else if (const Answer sent = send_mesh(node, meshes[*mesh], place);
                     sent != Answer::content)
                return sent;
        }
        for (const Json& child : glb::list_of(node, "children")) {
            if (const Answer sent = send(nodes, glb::whole_of(child), place, depth + 1, hidden);
                sent != Answer::content)
                return sent;
        }
        return Answer::content;
    }

    void note_hidden(const std::string& name, std::size_t node) {
        if (hidden_count_++ < hidden_names) {
            const std::string clean = clean_text(name, 64);
            hidden_ += clean.empty() ? "node " + std::to_string(node) : clean;
        }
        hidden_ += "\n";
    }

    static std::string name_of(const Json& node, const Json& mesh) {
        const std::string name = glb::text_of(node, "name");
        return name.empty() ? glb::text_of(mesh, "name") : name;
    }

    Answer send_mesh(const Json& node, const Json& mesh, const Matrix& place) {
        NamedMesh named;
        named.name = name_of(node, mesh);
        const Json& weights = glb::list_of(node.contains("weights") ? node : mesh, "weights");
        for (const Json& primitive : glb::list_of(mesh, "primitives"))
            if (const Answer added = add(primitive, weights, place, named.mesh);
                added != Answer::content)
                return added;
        if (named.mesh.triangles.empty())
            return Answer::content;
        any_ = true;
        return take_(named) ? Answer::content : Answer::end;
    }

    // Corners and triangles as numbers that stand in the file one after another.
    Answer read_plain(const Json& primitive, std::size_t position, glb::RawMesh& out) {
        if (const Answer read = accessors_.read_positions(position, out.corners);
            read != Answer::content)
            return read;
        if (const auto list = glb::index_of(primitive, "indices"))
            return accessors_.read_indices(*list, out.indices);
        for (std::size_t i = 0; i < out.corners.size(); ++i)
            out.indices.push_back(std::uint32_t(i));
        return Answer::content;
    }

    // Moves the corners as far as the weights of other shapes ("morph targets") say.
    Answer move(const Json& primitive, const Json& weights, std::vector<Vec3>& corners) {
        const Json& targets = glb::list_of(primitive, "targets");
        for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
            if (!weights[i].is_number()) {
                said_ = "weights";
                return Answer::property;
            }
            const auto weight = weights[i].get<double>();
            const auto steps_at = glb::index_of(targets[i], "POSITION");
            if (!steps_at || weight == 0)
                continue;
            std::vector<Vec3> steps;
            if (const Answer read = accessors_.read_positions(*steps_at, steps);
                read != Answer::content)
                return read;
            if (steps.size() != corners.size())
                return Answer::unreadable;
            for (std::size_t k = 0; k < corners.size(); ++k)
                corners[k] = corners[k] + steps[k] * weight;
        }
        return Answer::content;
    }

    Answer add(const Json& primitive, const Json& weights, const Matrix& place,
               medical::Mesh& mesh) {
        constexpr std::size_t triangles = 4, strip = 5, fan = 6;
        const std::size_t mode = glb::index_of(primitive, "mode").value_or(triangles);
        if (mode < triangles)
            return Answer::content;  // points and lines
        if (mode > fan) {
            said_ = "mode";
            return Answer::property;
        }
        const Json& attributes =
            primitive.contains("attributes") ? primitive["attributes"] : glb::no_list();
        const auto position = glb::index_of(attributes, "POSITION");
        if (!position)
            return Answer::content;
        glb::RawMesh read;
        const bool packed =
            glb::has_extension(primitive, glb::draco) && !accessors_.has_bytes(*position);
        const Answer found = packed ? accessors_.read_draco(
                                          glb::extension_in(primitive, glb::draco), *position, read)
                                    : read_plain(primitive, *position, read);
        if (found != Answer::content)
            return found;
        if (const Answer moved = move(primitive, weights, read.corners); moved != Answer::content)
            return moved;
        const auto& [corners, indices] = read;
        const std::size_t first = mesh.positions.size();
        if (first + corners.size() > max_loose_vertices ||
            mesh.triangles.size() + indices.size() > max_loose_vertices)
            return Answer::too_large;
        for (const Vec3 corner : corners)
            mesh.positions.push_back(medical::to_float(glb::placed(place, corner)));
        const bool mirrored = glb::is_mirrored(place);
        // Draco has triangles in every mode.
        const bool loose = mode == triangles || packed;
        for (std::size_t i = 0; i + 3 <= indices.size(); i += loose ? 3 : 1) {
            std::size_t a = i, b = i + 1, c = i + 2;
            if (!loose && mode == strip && i % 2 == 1)
                std::swap(a, b);
            if (!loose && mode == fan)
                a = 0;
            medical::Triangle t{indices[a], indices[mirrored ? c : b], indices[mirrored ? b : c]};
            for (std::uint32_t& corner : t) {
                if (corner >= corners.size())
                    return Answer::unreadable;
                corner += std::uint32_t(first);
            }
            mesh.triangles.push_back(t);
        }
        return mesh.triangles.size() > medical::max_mesh_triangles ? Answer::too_large
                                                                   : Answer::content;
    }

    const Json& root_;
    glb::Accessors accessors_;
    const TakeMesh& take_;
    std::string& said_;
    // Names of the meshes that are not shown, one a line; the lines of further ones are empty.
    std::string hidden_;
    std::size_t hidden_count_ = 0;
    std::vector<bool> visited_;
    bool any_ = false;
};

// The JSON and the buffer in a file of one piece (GLB).
Answer find_chunks(ByteView file, ByteView& json, ByteView& buffer, std::string& said) {
    constexpr std::size_t header_bytes = 12, chunk_head = 8;
    if (file.size() < header_bytes)
        return Answer::no_mesh;
    constexpr std::uint32_t largest_version = 9;  // beyond it are other bytes
    if (const auto version = load_le<std::uint32_t>(file.data() + 4); version != 2) {
        if (version == 0 || version > largest_version)
            return Answer::no_mesh;
        said = std::to_string(version);
        return Answer::version;
    }
    constexpr std::uint32_t json_kind = 0x4e4f534a, buffer_kind = 0x004e4942;
    std::size_t at = header_bytes;
    while (file.size() - at >= chunk_head) {
        const std::size_t size = load_le<std::uint32_t>(file.data() + at);
        const auto kind = load_le<std::uint32_t>(file.data() + at + 4);
        at += chunk_head;
        if (size > file.size() - at)
            return Answer::unreadable;
        if (kind == json_kind && json.empty())
            json = file.subspan(at, size);
        if (kind == buffer_kind && buffer.empty())
            buffer = file.subspan(at, size);
        at += size;
    }
    return Answer::content;
}

}  // namespace

Answer read_gltf(ByteView file, const TakeMesh& take, std::string& said,
                 const glb::FindBeside& find_beside, glb::UnpackDraco unpack_draco) {
    ByteView json = file, buffer;
    const bool is_binary = file.size() >= 4 && std::memcmp(file.data(), "glTF", 4) == 0;
    if (is_binary) {
        json = {};
        if (const Answer found = find_chunks(file, json, buffer, said); found != Answer::content)
            return found;
    }
    const char* text = reinterpret_cast<const char*>(json.data());
    const std::string_view begin(text, std::min<std::size_t>(json.size(), 64));
    const std::size_t first = begin.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (!is_binary && (first == begin.npos || begin[first] != '{'))
        return Answer::no_mesh;
    const Json root = Json::parse(text, text + json.size(), nullptr, false);
    if (!root.is_object())
        return Answer::unreadable;
    said = clean_text(unknown_version(root), 20);
    if (!said.empty())
        return Answer::version;
    for (const Json& name : glb::list_of(root, "extensionsRequired"))
        if (name.is_string() && !is_read(name.get<std::string>())) {
            said = name.get<std::string>();
            return Answer::extension;
        }
    glb::Buffers buffers(root, buffer, find_beside, said);
    return Scene(root, buffers, take, said, unpack_draco).walk();
}

}  // namespace theatron::cases
