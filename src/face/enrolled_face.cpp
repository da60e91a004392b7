// SPDX-License-Identifier: Apache-2.0
#include "face/enrolled_face.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "face/face_picture.h"

namespace theatron::face {
namespace {

constexpr std::string_view enrolled_magic = "TFOWN";
constexpr std::uint8_t enrolled_version = 1;
constexpr float point_mm = 0.02F, offset_mm = 0.01F;
constexpr float place_size = 65535;

Channels channels_of(Move move) {
    Channels channels{};
    if (move <= Move::anger) {
        channels = face::channels_of(Emotion(std::size_t(move)));
        channels[eye_wide_left] = channels[eye_wide_right] = 0;
        return channels;
    }
    constexpr Channel single[] = {jaw_open, eye_blink_left, eye_blink_right, eye_wide_left,
                                  eye_wide_right};
    channels[single[std::size_t(move) - std::size_t(Move::jaw_open)]] = 1;
    return channels;
}

std::int16_t whole_steps(float value, float unit) {
    return std::int16_t(std::clamp(std::round(value / unit), -32767.F, 32767.F));
}

using Steps = std::array<std::int16_t, 3>;

Steps steps_of(const std::vector<float>& values, std::size_t vertex, float unit) {
    Steps steps{};
    for (std::size_t k = 0; k < 3; ++k)
        steps[k] = whole_steps(values[3 * vertex + k], unit);
    return steps;
}

void put_move(ByteWriter& out, const std::vector<float>& offsets) {
    std::vector<std::pair<std::uint16_t, Steps>> moved;
    for (std::size_t i = 0; i < offsets.size() / 3; ++i)
        if (const Steps steps = steps_of(offsets, i, offset_mm); steps != Steps{})
            moved.push_back({std::uint16_t(i), steps});
    out.put(std::uint16_t(moved.size()));
    for (const auto& one : moved) {
        out.put(one.first);
        for (const std::int16_t step : one.second)
            out.put(step);
    }
}

// False where vertices are not there, not in order or do not move.
bool get_move(ByteReader& in, std::size_t vertices, std::vector<float>& offsets) {
    offsets.assign(vertices * 3, 0);
    const auto moved = in.get<std::uint16_t>();
    int before = -1;
    for (std::size_t i = 0; i < moved; ++i) {
        const auto vertex = in.get<std::uint16_t>();
        if (int(vertex) <= before || vertex >= vertices)
            return false;
        before = vertex;
        bool moves = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto step = in.get<std::int16_t>();
            if (step == -32768)
                return false;
            moves = moves || step != 0;
            offsets[3 * std::size_t(vertex) + k] = float(step) * offset_mm;
        }
        if (!moves)
            return false;
    }
    return true;
}

// Points, places and triangles.
Status get_mesh(ByteReader& in, std::size_t vertices, std::size_t triangles, FaceMesh& mesh) {
    if (in.rest().size() < vertices * 10 + triangles * 6)
        return Status::truncated;
    for (std::size_t i = 0; i < 3 * vertices; ++i) {
        const auto step = in.get<std::int16_t>();
        if (step == -32768)
            return Status::malformed;
        mesh.points.push_back(float(step) * point_mm);
    }
    for (std::size_t i = 0; i < 2 * vertices; ++i)
        mesh.places.push_back(float(in.get<std::uint16_t>()) / place_size);
    for (std::size_t i = 0; i < triangles; ++i) {
        auto& corners = mesh.triangles.emplace_back();
        for (std::uint32_t& corner : corners)
            if ((corner = in.get<std::uint16_t>()) >= vertices)
                return Status::malformed;
    }
    return Status::ok;
}

}  // namespace

EnrolledFace enrolled_person(const MorphModel& model, std::span<const float> identity) {
    assert(model.vertex_count() <= max_enrolled_vertices);
    assert(model.triangles.size() <= max_enrolled_triangles);
    EnrolledFace face;
    face.rest = mesh_of(model, identity, Channels{});
    face.colors = usual_colors();
    std::vector<float> moved(face.rest.points.size());
    for (std::size_t i = 0; i < move_count; ++i) {
        blend_shape(model, identity, channels_of(Move(i)), moved);
        for (std::size_t k = 0; k < moved.size(); ++k)
            moved[k] -= face.rest.points[k];
        face.moves[i] = moved;
    }
    return face;
}

void blend_face(const EnrolledFace& face, const Emotions& weights, const DirectChannels& direct,
                std::span<float> out) {
    assert(out.size() == face.rest.points.size());
    std::copy(face.rest.points.begin(), face.rest.points.end(), out.begin());
    const auto add = [&](Move move, float size) {
        if (!(size > 0))
            return;
        const std::vector<float>& offsets = face.moves[std::size_t(move)];
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += size * offsets[i];
    };
    const Emotions limited = limited_weights(weights);
    for (std::size_t i = 0; i <= std::size_t(Move::anger); ++i)
        add(Move(i), limited[i]);
    const Channels channels = blend_expressions(weights, direct);
    add(Move::jaw_open, channels[jaw_open]);
    add(Move::blink_left, channels[eye_blink_left]);
    add(Move::blink_right, channels[eye_blink_right]);
    add(Move::wide_left, channels[eye_wide_left]);
    add(Move::wide_right, channels[eye_wide_right]);
}

Bytes enrolled_bytes(const EnrolledFace& face) {
    const FaceMesh& rest = face.rest;
    const std::size_t vertices = rest.vertex_count();
    assert(vertices <= max_enrolled_vertices && rest.triangles.size() <= max_enrolled_triangles);
    const ByteView magic = as_bytes(enrolled_magic);
    Bytes bytes(magic.begin(), magic.end());
    ByteWriter out(bytes);
    out.put(enrolled_version);
    out.put(std::uint16_t(vertices));
    for (const std::uint32_t size : rest.part_sizes)
        out.put(size);
    for (const Rgb color : face.colors)
        for (const std::uint8_t value : {color.r, color.g, color.b})
            out.put(value);
    for (const float value : rest.points)
        out.put(whole_steps(value, point_mm));
    for (const float value : rest.places)
        out.put(std::uint16_t(std::round(std::clamp(value, 0.F, 1.F) * place_size)));
    for (const auto& corners : rest.triangles)
        for (const std::uint32_t corner : corners)
            out.put(std::uint16_t(corner));
    for (const auto& offsets : face.moves)
        put_move(out, offsets);
    for (const Bytes& texture : face.textures) {
        assert(texture.size() <= max_texture_bytes);
        out.put(std::uint32_t(texture.size()));
        out.put_bytes(texture);
    }
    return bytes;
}

Result<EnrolledFace> parse_enrolled(ByteView bytes) {
    if (bytes.size() > max_enrolled_bytes)
        return Status::too_large;
    ByteReader in(bytes);
    const ByteView start = in.get_bytes(enrolled_magic.size()), magic = as_bytes(enrolled_magic);
    if (!std::equal(start.begin(), start.end(), magic.begin(), magic.end()))
        return Status::malformed;
    const auto version = in.get<std::uint8_t>();
    const std::size_t vertices = in.get<std::uint16_t>();
    if (!in.ok())
        return Status::truncated;
    if (version > enrolled_version)
        return Status::unsupported_version;
    if (version == 0 || vertices == 0)
        return Status::malformed;
    EnrolledFace face;
    std::uint64_t triangles = 0;
    for (std::uint32_t& size : face.rest.part_sizes)
        triangles += size = in.get<std::uint32_t>();
    if (triangles > max_enrolled_triangles)
        return Status::too_large;
    for (Rgb& color : face.colors)
        for (std::uint8_t* value : {&color.r, &color.g, &color.b})
            *value = in.get<std::uint8_t>();
    if (const Status read = get_mesh(in, vertices, std::size_t(triangles), face.rest);
        read != Status::ok)
        return read;
    for (auto& offsets : face.moves)
        if (!get_move(in, vertices, offsets))
            return in.ok() ? Status::malformed : Status::truncated;
    for (Bytes& texture : face.textures) {
        const auto size = in.get<std::uint32_t>();
        if (size > max_texture_bytes)
            return Status::too_large;
        const ByteView picture = in.get_bytes(size);
        texture.assign(picture.begin(), picture.end());
    }
    if (!in.ok())
        return Status::truncated;
    if (face.textures[std::size_t(Emotion::neutral)].empty())
        return Status::malformed;
    return in.rest().empty() ? Result<EnrolledFace>(std::move(face))
                             : Result<EnrolledFace>(Status::trailing_bytes);
}

}  // namespace theatron::face
