// SPDX-License-Identifier: Apache-2.0
#include "render/line_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/matrix.h"

namespace theatron::render {
namespace {

// As the OR screen's letters and lines, in shares of a picture's smaller side.
constexpr double line_share = 0.0045, label_share = 0.0165;
constexpr double least_width = 4, least_outline = 1.5, outline_part = 0.4, least_letter = 11;

double smaller_side(Size picture) {
    return std::min(picture.width, picture.height);
}

// WCAG 2.1: 0 is black, 1 white.
double relative_luminance(Rgb color) {
    const auto linear = [](double byte) {
        const double c = byte / 255;
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

struct Corner {
    float from[3], to[3], radii[4];
};

}  // namespace

double least_line_width(Size picture) {
    return std::max(least_width, line_share * smaller_side(picture));
}

double outline_width(Size picture) {
    return std::max(least_outline, outline_part * least_line_width(picture));
}

double label_height(Size picture) {
    return std::max(least_letter, label_share * smaller_side(picture));
}

Rgb outline_color(Rgb line) {
    // Black and white stand out equally well from this grey.
    constexpr double middle = 0.179;
    return relative_luminance(line) > middle ? Rgb{8, 9, 10} : Rgb{248, 250, 250};
}

struct SceneLineMesh::Buffers {
    VertexArray attributes;  // 0: from, 1: to, 2: radii
    Buffer corners, indices;
    GLsizei count = 0;
};

SceneLineMesh::SceneLineMesh(const std::vector<LinePiece>& pieces)
    : buffers_(std::make_unique<Buffers>()) {
    std::vector<Corner> corners;
    std::vector<std::uint32_t> indices;
    for (const LinePiece& piece : pieces) {
        const auto first = std::uint32_t(corners.size());
        const Vec3 a = piece.from, b = piece.to;
        // The shader tells the corners apart by their numbers.
        corners.insert(corners.end(), 4,
                       {{float(a.x), float(a.y), float(a.z)},
                        {float(b.x), float(b.y), float(b.z)},
                        {float(piece.from_radius_m), float(piece.to_radius_m),
                         float(piece.from_half_widths), float(piece.to_half_widths)}});
        for (const std::uint32_t corner : {0, 1, 2, 2, 1, 3})
            indices.push_back(first + corner);
    }
    buffers_->count = GLsizei(indices.size());
    glBindVertexArray(buffers_->attributes.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffers_->corners.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(Corner)), corners.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_->indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    const auto attribute = [](GLuint number, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(number);
        glVertexAttribPointer(number, size, GL_FLOAT, GL_FALSE, sizeof(Corner),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(Corner, from));
    attribute(1, 3, offsetof(Corner, to));
    attribute(2, 4, offsetof(Corner, radii));
    glBindVertexArray(0);
}
SceneLineMesh::~SceneLineMesh() = default;
SceneLineMesh::SceneLineMesh(SceneLineMesh&&) noexcept = default;
SceneLineMesh& SceneLineMesh::operator=(SceneLineMesh&&) noexcept = default;

LinePass::LinePass()
    : program_(line_files(
          [](ShaderFiles vertex, ShaderFiles fragment) { return Program(vertex, fragment); })) {}

void LinePass::draw(const std::vector<SceneLine>& lines, const CameraView& view,
                    const DrawTarget& target) const {
    if (lines.empty())
        return;
    const Mat4 clip_from_room = projection(view) * matrix(inverse(view.room_from_eye));
    program_.use();
    glUniform2f(picture_, float(target.size.width), float(target.size.height));
    glUniform2f(origin_, float(target.x), float(target.y));
    glUniform1f(pixels_per_slope_, float(target.size.height / std::abs(view.bottom - view.top)));
    glUniform1f(least_radius_, float(least_line_width(target.size) / 2));
    glUniform1f(near_m_, float(view.near_m));
    set_depth_from_w(view, depth_from_w_);
    const auto draw_part = [&](const SceneLine& line, double around, Rgb color, double opacity) {
        glUniform1f(outline_, float(around));
        glUniform4f(ink_, float(color.r) / 255, float(color.g) / 255, float(color.b) / 255,
                    float(opacity));
        const SceneLineMesh::Buffers& buffers = line.mesh->buffers();
        glBindVertexArray(buffers.attributes.name());
        glDrawElements(GL_TRIANGLES, buffers.count, GL_UNSIGNED_INT, nullptr);
    };
    for (const SceneLine& line : lines) {
        set_matrix(clip_from_line_, clip_from_room * matrix(line.room_from_line));
        glUniform2f(nearer_, float(line.nearer_m), float(line.nearer_per_distance));
        const Cut whole{{0, 0, 0}, 0};
        const Cut& plane = line.cut ? *line.cut : whole;
        const Vec3 normal = rotate(conjugate(line.room_from_line.rotation), plane.normal);
        glUniform4f(cut_, float(normal.x), float(normal.y), float(normal.z),
                    float(plane.distance_m - dot(plane.normal, line.room_from_line.translation)));
        if (line.hidden_opacity > 0) {
            glDepthFunc(GL_GREATER);
            draw_part(line, 0, line.color, line.hidden_opacity);
            glDepthFunc(GL_LESS);
        }
        // First around all pieces, so that no piece's outline covers its neighbour.
        draw_part(line, outline_width(target.size), outline_color(line.color), 1);
        draw_part(line, 0, line.color, 1);
    }
    glBindVertexArray(0);
}

}  // namespace theatron::render
