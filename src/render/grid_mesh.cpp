// SPDX-License-Identifier: Apache-2.0
#include "render/grid_mesh.h"

namespace theatron::render {
namespace {

std::vector<GLuint> grid_indices(Size size) {
    if (size.width < 2 || size.height < 2)
        return {};
    std::vector<GLuint> indices(std::size_t(size.width - 1) * std::size_t(size.height - 1) * 6);
    GLuint* next = indices.data();
    const auto at = [&](int x, int y) { return GLuint(y * size.width + x); };
    // In upright strips, so that a row's vertices are still in the cache for the next row.
    constexpr int strip = 16;
    for (int first = 0; first + 1 < size.width; first += strip)
        for (int y = 0; y + 1 < size.height; ++y)
            for (int x = first; x < first + strip && x + 1 < size.width; ++x) {
                for (const GLuint corner : {at(x + 1, y), at(x + 1, y + 1), at(x, y),
                                            at(x + 1, y + 1), at(x, y + 1), at(x, y)})
                    *next++ = corner;
            }
    return indices;
}

}  // namespace

void GridMesh::draw() {
    if (indices_) {
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_->name());
    } else {
        const std::vector<GLuint> indices = grid_indices(size_);
        indices_.emplace();
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_->name());
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(GLuint)),
                     indices.data(), GL_STATIC_DRAW);
        count_ = GLsizei(indices.size());
    }
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

std::shared_ptr<GridMesh> GridMeshes::of(Size size) {
    std::weak_ptr<GridMesh>& known = grids_[{size.width, size.height}];
    std::shared_ptr<GridMesh> grid = known.lock();
    if (!grid)
        known = grid = std::make_shared<GridMesh>(size);
    std::erase_if(grids_, [](const auto& entry) { return entry.second.expired(); });
    return grid;
}

}  // namespace theatron::render
