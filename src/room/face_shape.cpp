// SPDX-License-Identifier: Apache-2.0
#include "room/face_shape.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace theatron::room {
namespace {

using render::MeshData;
using namespace face;

// The model's eyes are at this height; in the head's frame they are at 0. The skin lies on the
// bust's head when it is this much further back.
constexpr double eye_y = 25, eye_x = 32, back_mm = 12;

// Eyes: half of the width, heights of the open lids, the iris, and how far gaze moves it.
constexpr double eye_half = 15, upper_lid = 7.6, lower_lid = 5, iris = 6.4, gaze_x = 5,
                 gaze_y = 2.5;
constexpr int eye_columns = 16;
// Heights of the skin's places below and above the eye's middle.
constexpr double eye_low = -6, eye_high = 10;

constexpr double mouth_y = -48, mouth_half = 25;
constexpr int mouth_columns = 24, brow_columns = 10;

// How far before the skin parts lie, so that it never covers them.
constexpr double white_lift = 2.2, white_dome = 2, iris_lift = 0.5, lid_lift = 1.2, lid_edge = 1.5,
                 brow_lift = 2.5, lip_lift = 0.8, lip_dome = 1.8, mouth_lift = 0.5,
                 mouth_dome = 0.25;
// Closed lips leave a line.
constexpr double least_gap = 0.9;
// Brows and lips move further than the skin below them, so that they are understood from afar.
constexpr double brow_reach = 1.5, lip_reach = 1.3;
// An open mouth draws its corners down, by this share of its height.
constexpr double corner_fall = 0.35;

// Under a cap a head is wider than the generated one, whose forehead is that of an ellipsoid.
constexpr double forehead_wider = 0.43, forehead_before = 0.22, forehead_mm = 60;

MeshData::Vertex vertex(Vec3 mm) {
    const double above = std::max(0.0, mm.y - eye_y) / forehead_mm;
    mm.x *= 1 + forehead_wider * above * above;
    mm.z *= 1 + (mm.z > 0 ? forehead_before : 0) * above * above;
    return {float(-mm.x / 1000), float((mm.y - eye_y) / 1000), float((back_mm - mm.z) / 1000)};
}

// Normals of the surface through the vertices from `first_vertex` and the triangles from
// `first_index` on.
void set_normals(MeshData& mesh, std::size_t first_vertex, std::size_t first_index) {
    const auto place = [&](std::uint32_t i) {
        const MeshData::Vertex& v = mesh.vertices[i];
        return Vec3{v.px, v.py, v.pz};
    };
    for (std::size_t i = first_index; i < mesh.indices.size(); i += 3) {
        const Vec3 a = place(mesh.indices[i]);
        const Vec3 normal = cross(place(mesh.indices[i + 1]) - a, place(mesh.indices[i + 2]) - a);
        for (std::size_t k = 0; k < 3; ++k) {
            MeshData::Vertex& v = mesh.vertices[mesh.indices[i + k]];
            v.nx += float(normal.x);
            v.ny += float(normal.y);
            v.nz += float(normal.z);
        }
    }
    for (std::size_t i = first_vertex; i < mesh.vertices.size(); ++i) {
        MeshData::Vertex& v = mesh.vertices[i];
        const float size = std::sqrt(v.nx * v.nx + v.ny * v.ny + v.nz * v.nz);
        if (size > 0) {
            v.nx /= size;
            v.ny /= size;
            v.nz /= size;
        } else {
            v.nz = -1;  // of a part that is closed
        }
    }
}

using Line = std::vector<Vec3>;

// Appends the surface between lines of equal length that follow each other downwards; each goes to
// the left of the head.
void append_strip(MeshData& mesh, std::span<const Line> lines) {
    const std::size_t first_vertex = mesh.vertices.size(), first_index = mesh.indices.size();
    const auto count = std::uint32_t(lines.front().size());
    for (const Line& line : lines)
        for (const Vec3 place : line)
            mesh.vertices.push_back(vertex(place));
    for (std::uint32_t row = 0; row + 1 < lines.size(); ++row)
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const std::uint32_t a = std::uint32_t(first_vertex) + row * count + i, b = a + count;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    set_normals(mesh, first_vertex, first_index);
}

// From -1 at the first of `columns` to 1 at the last.
double across(int column, int columns) {
    return 2.0 * column / columns - 1;
}

}  // namespace

// How one eye is: shares of the open lids, and where it looks.
struct FaceShape::Lids {
    double upper = 1, lower = 1, closed = 0;
    double gaze_left = 0, gaze_up = 0;

    double low(double t) const { return -lower_lid * (1 - t * t) * lower; }
    double high(double t) const {
        const double open = upper_lid * (1 - t * t) * upper;
        return open + closed * (low(t) - open);
    }
};

FaceShape::FaceShape() : model_(generated_head()) {
    eyes_ = {make_eye(eye_x), make_eye(-eye_x)};
    brows_ = {make_brow(1), make_brow(-1)};
    upper_ = make_lip(true);
    lower_ = make_lip(false);
}

// The foremost triangle of the head at rest that is there, seen from the front.
FaceShape::Anchor FaceShape::anchor_at(double x, double y) const {
    Anchor best;
    double foremost = -1e9;
    const auto place = [&](std::uint32_t i) {
        return Vec3{model_.neutral[3 * i], model_.neutral[3 * i + 1], model_.neutral[3 * i + 2]};
    };
    for (const auto& corners : model_.triangles) {
        const Vec3 a = place(corners[0]), b = place(corners[1]), c = place(corners[2]);
        const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (area <= 0)
            continue;  // seen from behind
        const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
        const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
        const double z = a.z + u * (b.z - a.z) + v * (c.z - a.z);
        if (u < 0 || v < 0 || u + v > 1 || z <= foremost)
            continue;
        foremost = z;
        best = {corners, {1 - u - v, u, v}};
    }
    return best;
}

Vec3 FaceShape::on(const Anchor& anchor, const std::vector<float>& skin) {
    Vec3 place;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 3 * std::size_t(anchor.corners[k]);
        place = place + anchor.shares[k] * Vec3{skin[at], skin[at + 1], skin[at + 2]};
    }
    return place;
}

FaceShape::Eye FaceShape::make_eye(double middle_x) const {
    Eye eye{middle_x, {}};
    for (int i = 0; i <= eye_columns; ++i) {
        const double x = middle_x + eye_half * across(i, eye_columns);
        eye.columns.push_back(
            {anchor_at(x, eye_y + eye_low), anchor_at(x, eye_y), anchor_at(x, eye_y + eye_high)});
    }
    return eye;
}

std::vector<std::array<FaceShape::Anchor, 2>> FaceShape::make_brow(double side) const {
    std::vector<std::array<Anchor, 2>> brow;
    for (int i = 0; i <= brow_columns; ++i) {
        const double along = double(i) / brow_columns;  // from the nose outwards
        const double x = 14 + 34 * along, y = 46 + 13 * along - 15 * along * along;
        const double half = 2.6 * (1 - 0.6 * along);
        brow.push_back({anchor_at(side * x, y + half), anchor_at(side * x, y - half)});
    }
    if (side < 0)
        std::reverse(brow.begin(), brow.end());
    return brow;
}

FaceShape::Lip FaceShape::make_lip(bool is_upper) const {
    Lip lip;
    for (int i = 0; i <= mouth_columns; ++i) {
        const double t = across(i, mouth_columns), x = mouth_half * t;
        const double dip = 1.6 * std::exp(-t * t / 0.02);
        const double outer = is_upper ? 7.5 * (1 - t * t) - dip : -9 * (1 - t * t);
        lip.outer.push_back(anchor_at(x, mouth_y + outer));
        lip.inner.push_back(anchor_at(x, mouth_y - 0.8 * (1 - t * t)));
    }
    return lip;
}

void FaceShape::add_skin(const std::vector<float>& skin, FaceMeshes& out) const {
    MeshData& mesh = out.skin;
    mesh.vertices.reserve(model_.vertex_count());
    for (std::size_t i = 0; i < model_.vertex_count(); ++i)
        mesh.vertices.push_back(vertex({skin[3 * i], skin[3 * i + 1], skin[3 * i + 2]}));
    mesh.indices.reserve(3 * model_.triangles.size());
    for (const auto& corners : model_.triangles)
        mesh.indices.insert(mesh.indices.end(), corners.begin(), corners.end());
    set_normals(mesh, 0, 0);
}

void FaceShape::add_eye(const Eye& eye, const Lids& lids, FaceMeshes& out) const {
    // The skin at rest, since lids slide over the eye.
    const auto depth = [&](int column, double y) {
        const auto& at = eye.columns[std::size_t(column)];
        const double low = on(at[0], model_.neutral).z, middle = on(at[1], model_.neutral).z,
                     high = on(at[2], model_.neutral).z;
        const double t = across(column, eye_columns);
        // In front of the hollow between the heights, as an eyeball is.
        return std::max(middle, low + (high - low) * (y - eye_low) / (eye_high - eye_low)) +
               white_lift + white_dome * (1 - t * t);
    };
    const auto place = [&](int column, double y, double lift) {
        const double x = eye.middle_x + eye_half * across(column, eye_columns);
        return Vec3{x, eye_y + y, depth(column, y) + lift};
    };
    Line high, low, upper_edge, lower_edge, iris_high, iris_low;
    for (int i = 0; i <= eye_columns; ++i) {
        const double t = across(i, eye_columns), top = lids.high(t), bottom = lids.low(t);
        high.push_back(place(i, top, 0));
        low.push_back(place(i, bottom, 0));
        const double edge = lid_edge * (0.4 + 0.6 * (1 - t * t));
        upper_edge.push_back(place(i, top + edge / 2, lid_lift));
        lower_edge.push_back(place(i, top - edge / 2, lid_lift));
        const double dx = eye_half * t - gaze_x * lids.gaze_left, dy = gaze_y * lids.gaze_up;
        const double half = std::sqrt(std::max(0.0, iris * iris - dx * dx));
        iris_high.push_back(
            place(i, std::clamp(dy + half, bottom, std::max(bottom, top)), iris_lift));
        iris_low.push_back(
            place(i, std::clamp(dy - half, bottom, std::max(bottom, top)), iris_lift));
    }
    append_strip(out.whites, std::array{high, low});
    append_strip(out.dark, std::array{upper_edge, lower_edge});
    append_strip(out.dark, std::array{iris_high, iris_low});
}

void FaceShape::add_brow(const std::vector<std::array<Anchor, 2>>& brow,
                         const std::vector<float>& skin, FaceMeshes& out) const {
    std::array<Line, 2> lines;
    for (const auto& column : brow) {
        const Vec3 upper = on(column[0], model_.neutral), lower = on(column[1], model_.neutral);
        // Both edges by the same, so that a brow keeps its thickness.
        const Vec3 move =
            0.5 * brow_reach * (on(column[0], skin) - upper + on(column[1], skin) - lower) +
            Vec3{0, 0, brow_lift};
        lines[0].push_back(upper + move);
        lines[1].push_back(lower + move);
    }
    append_strip(out.dark, lines);
}

// Each lip moves as the skin at its outer edge does, so that they part where the skin is stretched.
void FaceShape::add_mouth(const std::vector<float>& skin, FaceMeshes& out) const {
    struct Edges {
        Line outer, inner;
    };
    const auto edges_of = [&](const Lip& lip) {
        Edges edges;
        for (std::size_t i = 0; i < lip.outer.size(); ++i) {
            const Vec3 rest = on(lip.outer[i], model_.neutral);
            Vec3 move = on(lip.outer[i], skin) - rest;
            move.y *= lip_reach;
            edges.outer.push_back(rest + move);
            edges.inner.push_back(on(lip.inner[i], model_.neutral) + move);
        }
        return edges;
    };
    Edges upper = edges_of(upper_), lower = edges_of(lower_);
    const std::size_t half = upper.inner.size() / 2;
    const double open = std::max(0.0, upper.inner[half].y - lower.inner[half].y);
    Line upper_middle, lower_middle, dark_high, dark_low;
    for (std::size_t i = 0; i < upper.inner.size(); ++i) {
        const double t = across(int(i), mouth_columns);
        const Vec3 fall{0, -corner_fall * open * t * t, 0};
        // Lips that are pressed onto each other do not pass through each other.
        const double missing =
            std::max(0.0, least_gap * (1 - t * t) - (upper.inner[i].y - lower.inner[i].y));
        const auto finish = [&](Edges& edges, double up, Line& middle) {
            Vec3 &outer = edges.outer[i], &inner = edges.inner[i];
            outer = outer + fall + Vec3{0, 0, lip_lift};
            inner = inner + fall + Vec3{0, up, lip_lift + 0.5};
            middle.push_back(0.5 * (outer + inner) + Vec3{0, 0, lip_dome * (1 - t * t)});
        };
        finish(upper, missing / 2, upper_middle);
        finish(lower, -missing / 2, lower_middle);
        dark_high.push_back(upper.inner[i] + Vec3{0, 0.4, mouth_lift - lip_lift});
        dark_low.push_back(lower.inner[i] + Vec3{0, -0.4, mouth_lift - lip_lift});
    }
    append_strip(out.lips, std::array{upper.outer, upper_middle, upper.inner});
    append_strip(out.lips, std::array{lower.inner, lower_middle, lower.outer});
    Line dark_middle;
    for (std::size_t i = 0; i < dark_high.size(); ++i)
        dark_middle.push_back(0.5 * (dark_high[i] + dark_low[i]) +
                              Vec3{0, 0, mouth_dome * (dark_high[i].y - dark_low[i].y)});
    append_strip(out.mouth, std::array{dark_high, dark_middle, dark_low});
}

FaceMeshes FaceShape::meshes(const Channels& channels) const {
    std::vector<float> skin(3 * model_.vertex_count());
    blend_shape(model_, {}, channels, skin);
    FaceMeshes out;
    add_skin(skin, out);
    const auto lids_of = [&](Channel blink, Channel squint, Channel wide, Channel up, Channel down,
                             double gaze_left) {
        Lids lids;
        lids.closed = channels[blink];
        lids.upper = std::max(
            0.1, 1.0 - 0.25 * channels[squint] + 0.4 * channels[wide] - 0.25 * channels[down]);
        lids.lower = std::max(0.1, 1.0 - 0.55 * channels[squint] + 0.15 * channels[wide]);
        lids.gaze_up = channels[up] - channels[down];
        lids.gaze_left = gaze_left;
        return lids;
    };
    add_eye(eyes_[0],
            lids_of(eye_blink_left, eye_squint_left, eye_wide_left, eye_look_up_left,
                    eye_look_down_left, channels[eye_look_out_left] - channels[eye_look_in_left]),
            out);
    add_eye(
        eyes_[1],
        lids_of(eye_blink_right, eye_squint_right, eye_wide_right, eye_look_up_right,
                eye_look_down_right, channels[eye_look_in_right] - channels[eye_look_out_right]),
        out);
    for (const auto& brow : brows_)
        add_brow(brow, skin, out);
    add_mouth(skin, out);
    return out;
}

}  // namespace theatron::room
