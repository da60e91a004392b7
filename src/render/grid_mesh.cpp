// SPDX-License-Identifier: Apache-2.0
#include "render/grid_mesh.h"

namespace theatron::render {
namespace {

std::vector<GLuint> grid_indices(Size size) {
    std::vector<GLuint> indices;
    indices.reserve(std::size_t(size.width - 1) * std::size_t(size.height - 1) * 6);
    const auto at = [&](int x, int y) { return GLuint(y * size.width + x); };
    // In upright strips, so that a row's vertices are still at hand for the next row.
    constexpr int strip = 16;
    for (int first = 0; first + 1 < size.width; first += strip)
        for (int y = 0; y + 1 < size.height; ++y)
            for (int x = first; x < first + strip && x + 1 < size.width; ++x) {
                const GLuint cell[] = {at(x + 1, y),     at(x + 1, y + 1), at(x, y),
                                       at(x + 1, y + 1), at(x, y + 1),     at(x, y)};
                indices.insert(indices.end(), std::begin(cell), std::end(cell));
            }
    return indices;
}

}  // namespace

void GridMesh::draw(Size size, int instances) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    if (size != size_) {
        const std::vector<GLuint> indices = grid_indices(size);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(GLuint)),
                     indices.data(), GL_STATIC_DRAW);
        size_ = size;
        count_ = GLsizei(indices.size());
    }
    glDrawElementsInstanced(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr, instances);
}

}  // namespace theatron::render
