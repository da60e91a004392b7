// SPDX-License-Identifier: Apache-2.0
#include "render/scene_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "image/image.h"
#include "image/scratch.h"
#include "render/complete_framebuffer.h"

namespace theatron::render {

MeshData make_box_mesh(Vec3 low, Vec3 high) {
    MeshData mesh;
    const double l[] = {low.x, low.y, low.z}, h[] = {high.x, high.y, high.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto first = std::uint32_t(mesh.vertices.size());
            for (int corner = 0; corner < 4; ++corner) {
                double p[3], n[3] = {0, 0, 0};
                p[axis] = side ? h[axis] : l[axis];
                p[u] = corner == 1 || corner == 2 ? h[u] : l[u];
                p[v] = corner >= 2 ? h[v] : l[v];
                n[axis] = side ? 1 : -1;
                mesh.vertices.push_back(
                    {float(p[0]), float(p[1]), float(p[2]), float(n[0]), float(n[1]), float(n[2]),
                     corner == 1 || corner == 2 ? 1.0f : 0.0f, corner >= 2 ? 0.0f : 1.0f});
            }
            const std::uint32_t outside[] = {0, 1, 2, 0, 2, 3}, inside[] = {0, 2, 1, 0, 3, 2};
            for (const std::uint32_t i : side ? outside : inside)
                mesh.indices.push_back(first + i);
        }
    return mesh;
}

MeshData make_panel_mesh(double width_m, double height_m) {
    const auto x = float(width_m / 2), y = float(height_m / 2);
    return {{{-x, -y, 0, 0, 0, -1, 0, 0},
             {x, -y, 0, 0, 0, -1, 1, 0},
             {x, y, 0, 0, 0, -1, 1, 1},
             {-x, y, 0, 0, 0, -1, 0, 1}},
            {0, 2, 1, 0, 3, 2}};
}

MeshData make_sphere_mesh(double radius, int rings) {
    MeshData mesh;
    const int columns = 2 * rings;
    for (int r = 0; r <= rings; ++r)
        for (int c = 0; c <= columns; ++c) {
            const double down = std::numbers::pi * r / rings, around = std::numbers::pi * c / rings;
            const Vec3 n{std::sin(down) * std::sin(around), std::cos(down),
                         std::sin(down) * std::cos(around)};
            mesh.vertices.push_back({float(n.x * radius), float(n.y * radius), float(n.z * radius),
                                     float(n.x), float(n.y), float(n.z), float(c) / float(columns),
                                     float(r) / float(rings)});
        }
    const auto at = [&](int r, int c) { return std::uint32_t(r * (columns + 1) + c); };
    for (int r = 0; r < rings; ++r)
        for (int c = 0; c < columns; ++c) {
            const std::uint32_t cell[] = {at(r, c), at(r + 1, c),     at(r + 1, c + 1),
                                          at(r, c), at(r + 1, c + 1), at(r, c + 1)};
            mesh.indices.insert(mesh.indices.end(), std::begin(cell), std::end(cell));
        }
    return mesh;
}

SceneMesh::SceneMesh(const MeshData& data) : buffers_(std::make_unique<Buffers>()) {
    using Vertex = MeshData::Vertex;
    glBindVertexArray(buffers_->attributes.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffers_->vertices.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(data.vertices.size() * sizeof(Vertex)),
                 data.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_->indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(data.indices.size() * sizeof(std::uint32_t)),
                 data.indices.data(), GL_STATIC_DRAW);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(offsetof(Vertex, px)));
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(offsetof(Vertex, nx)));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(offsetof(Vertex, u)));
    if (!data.colors.empty()) {
        assert(data.colors.size() == data.vertices.size());
        glBindBuffer(GL_ARRAY_BUFFER, buffers_->colors.name());
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(data.colors.size() * sizeof(Rgb)),
                     data.colors.data(), GL_STATIC_DRAW);
        glEnableVertexAttribArray(3);
        glVertexAttribPointer(3, 3, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Rgb), nullptr);
    }
    glBindVertexArray(0);
    buffers_->has_colors = !data.colors.empty();
    buffers_->count = GLsizei(data.indices.size());
    const auto corner = [&](std::size_t i) {
        const Vertex& v = data.vertices[data.indices[i]];
        return Vec3{v.px, v.py, v.pz};
    };
    Vec3 low{1e30, 1e30, 1e30}, high = low * -1;
    for (const Vertex& v : data.vertices) {
        low = {std::min<double>(low.x, v.px), std::min<double>(low.y, v.py),
               std::min<double>(low.z, v.pz)};
        high = {std::max<double>(high.x, v.px), std::max<double>(high.y, v.py),
                std::max<double>(high.z, v.pz)};
    }
    if (!data.vertices.empty())
        buffers_->middle = (low + high) * 0.5;
    for (const Vertex& v : data.vertices)
        buffers_->radius_m =
            std::max(buffers_->radius_m, length(Vec3{v.px, v.py, v.pz} - buffers_->middle));
    for (std::size_t i = 0; i + 2 < data.indices.size(); i += 3)
        buffers_->triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
}

const TriangleTree& SceneMesh::triangles() const {
    if (!buffers_->tree)
        buffers_->tree.emplace(std::exchange(buffers_->triangles, {}));
    return *buffers_->tree;
}

SceneMesh::~SceneMesh() = default;
SceneMesh::SceneMesh(SceneMesh&&) noexcept = default;
SceneMesh& SceneMesh::operator=(SceneMesh&&) noexcept = default;

namespace {

// As OpenGL has it: half of a side, rounded down, at least 1.
Size level_size(Size size, int level) {
    return {std::max(size.width >> level, 1), std::max(size.height >> level, 1)};
}

// The next level of a texture, in place: each pixel is the mean of four. Pixels are four bytes.
void halve(std::vector<std::uint32_t>& pixels, Size size, Size half) {
    constexpr std::uint32_t even = 0x00ff00ffu, round = 0x00020002u;
    for (int y = 0; y < half.height; ++y) {
        const std::uint32_t* above = pixels.data() + std::size_t(2 * y) * std::size_t(size.width);
        const std::uint32_t* below = size.height > 1 ? above + size.width : above;
        std::uint32_t* out = pixels.data() + std::size_t(y) * std::size_t(half.width);
        for (int x = 0; x < half.width; ++x) {
            const int left = 2 * x, right = size.width > 1 ? left + 1 : left;
            const std::uint32_t a = above[left], b = above[right], c = below[left],
                                d = below[right];
            const std::uint32_t low = (a & even) + (b & even) + (c & even) + (d & even) + round,
                                high = (a >> 8 & even) + (b >> 8 & even) + (c >> 8 & even) +
                                       (d >> 8 & even) + round;
            out[x] = (low >> 2 & even) | (high >> 2 & even) << 8;
        }
    }
}

}  // namespace

SceneTexture::SceneTexture(Size size) : parts_(std::make_unique<Parts>()) {
    parts_->size = size;
    int levels = 1;
    while (std::max(size.width, size.height) >> levels > 0)
        ++levels;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, parts_->texture.name());
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA8, size.width, size.height);
    set_sampling(GL_TEXTURE_2D, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, parts_->framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           parts_->texture.name(), 0);
    if (!is_complete_framebuffer<SceneTexture>())
        throw Error("The graphics driver cannot draw into a texture of " +
                    std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels.");
    const float nothing[] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, nothing);
    finish();
}

SceneTexture::~SceneTexture() = default;
SceneTexture::SceneTexture(SceneTexture&&) noexcept = default;
SceneTexture& SceneTexture::operator=(SceneTexture&&) noexcept = default;

Size SceneTexture::size() const {
    return parts_->size;
}

void SceneTexture::set(ColorView picture) {
    assert(picture.size == size());
    // All machines that this is built for are little-endian.
    // Fresh memory would cost more than the conversion.
    auto& rgba = scratch_of_this_thread<Image<std::uint32_t>>(picture.size).pixels;
    std::uint32_t* at = rgba.data();
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const Rgb p = picture.row(y)[x];
            *at++ = p.r | std::uint32_t(p.g) << 8 | std::uint32_t(p.b) << 16 | 0xff000000u;
        }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, parts_->texture.name());
    // glGenerateMipmap() of software drivers takes several times as long.
    for (int level = 0;; ++level) {
        const Size size = level_size(picture.size, level);
        glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, size.width, size.height, GL_RGBA,
                        GL_UNSIGNED_BYTE, rgba.data());
        if (size == Size{1, 1})
            break;
        halve(rgba, size, level_size(picture.size, level + 1));
    }
}

DrawTarget SceneTexture::target() const {
    return {parts_->framebuffer.name(), 0, 0, parts_->size};
}

void SceneTexture::finish() {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, parts_->texture.name());
    glGenerateMipmap(GL_TEXTURE_2D);
}

void SceneMesh::Buffers::draw() const {
    glBindVertexArray(attributes.name());
    // The value of corners without colours is no part of the array object.
    if (!has_colors)
        glVertexAttrib3f(3, 1, 1, 1);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace theatron::render
