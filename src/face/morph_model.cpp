// SPDX-License-Identifier: Apache-2.0
#include "face/morph_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

constexpr std::string_view model_magic = "TFHEAD";
constexpr std::uint8_t model_version = 1;
constexpr float max_offset_mm = 1000;

void add_offsets(std::span<float> out, const std::vector<float>& offsets, float size) {
    if (size == 0)
        return;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += size * offsets[i];
}

// Appends `count` coordinates that are in range.
bool read_offsets(ByteReader& in, std::size_t count, std::vector<float>& out) {
    // Before memory is taken for them: the bytes must be there.
    if (in.rest().size() / sizeof(float) < count)
        return false;
    out.resize(count);
    for (float& value : out) {
        value = get_f32(in);
        if (!std::isfinite(value) || std::fabs(value) > max_offset_mm)
            return false;
    }
    return true;
}

}  // namespace

void blend_shape(const MorphModel& model, std::span<const float> identity, const Channels& channels,
                 std::span<float> out) {
    assert(out.size() == model.neutral.size());
    std::copy(model.neutral.begin(), model.neutral.end(), out.begin());
    for (std::size_t i = 0; i < std::min(identity.size(), model.identities.size()); ++i)
        add_offsets(out, model.identities[i], identity[i]);
    for (const auto& expression : model.expressions)
        add_offsets(out, expression.offsets, channels[expression.channel]);
}

Vec3 blended_vertex(const MorphModel& model, std::span<const float> identity,
                    const Channels& channels, std::uint32_t vertex) {
    const auto at = [&](const std::vector<float>& from) {
        const float* p = from.data() + std::size_t(vertex) * 3;
        return Vec3{p[0], p[1], p[2]};
    };
    Vec3 point = at(model.neutral);
    for (std::size_t i = 0; i < std::min(identity.size(), model.identities.size()); ++i)
        point = point + double(identity[i]) * at(model.identities[i]);
    for (const auto& expression : model.expressions)
        point = point + double(channels[expression.channel]) * at(expression.offsets);
    return point;
}

Bytes model_bytes(const MorphModel& model) {
    const ByteView magic_bytes = as_bytes(model_magic);
    Bytes bytes(magic_bytes.begin(), magic_bytes.end());
    ByteWriter out(bytes);
    const auto put_all = [&](const std::vector<float>& values) {
        for (const float value : values)
            put_f32(out, value);
    };
    out.put(model_version);
    out.put(std::uint32_t(model.vertex_count()));
    out.put(std::uint32_t(model.triangles.size()));
    out.put(std::uint32_t(model.identities.size()));
    out.put(std::uint32_t(model.expressions.size()));
    for (const std::uint32_t vertex : model.landmarks)
        out.put(vertex);
    put_all(model.neutral);
    for (const auto& triangle : model.triangles)
        for (const std::uint32_t vertex : triangle)
            out.put(vertex);
    for (const auto& identity : model.identities)
        put_all(identity);
    for (const auto& expression : model.expressions) {
        out.put(std::uint8_t(expression.channel));
        put_all(expression.offsets);
    }
    return bytes;
}

Result<MorphModel> parse_model(ByteView bytes) {
    ByteReader in(bytes);
    const ByteView start = in.get_bytes(model_magic.size());
    const ByteView expected = as_bytes(model_magic);
    if (!std::equal(start.begin(), start.end(), expected.begin(), expected.end()))
        return Status::malformed;
    const auto version = in.get<std::uint8_t>();
    const auto vertices = in.get<std::uint32_t>(), triangles = in.get<std::uint32_t>(),
               identities = in.get<std::uint32_t>(), expressions = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (version > model_version)
        return Status::unsupported_version;
    if (vertices > max_vertices || triangles > max_triangles || identities > max_shapes ||
        expressions > max_shapes)
        return Status::too_large;
    if (version == 0 || vertices == 0)
        return Status::malformed;
    const std::size_t numbers = std::size_t(vertices) * 3;
    MorphModel model;
    for (std::uint32_t& vertex : model.landmarks)
        if ((vertex = in.get<std::uint32_t>()) >= vertices)
            return in.ok() ? Status::malformed : Status::truncated;
    const auto refusal = [&] {
        return in.rest().size() / sizeof(float) < numbers ? Status::truncated : Status::malformed;
    };
    if (!read_offsets(in, numbers, model.neutral))
        return refusal();
    if (in.rest().size() / 12 < triangles)
        return Status::truncated;
    model.triangles.resize(triangles);
    for (auto& triangle : model.triangles)
        for (std::uint32_t& vertex : triangle)
            if ((vertex = in.get<std::uint32_t>()) >= vertices)
                return Status::malformed;
    for (std::uint32_t i = 0; i < identities; ++i)
        if (!read_offsets(in, numbers, model.identities.emplace_back()))
            return refusal();
    for (std::uint32_t i = 0; i < expressions; ++i) {
        const auto channel = in.get<std::uint8_t>();
        if (in.ok() && channel >= channel_count)
            return Status::malformed;
        auto& expression = model.expressions.emplace_back();
        expression.channel = Channel(channel);
        if (!read_offsets(in, numbers, expression.offsets))
            return refusal();
    }
    if (!in.ok())
        return Status::truncated;
    return in.rest().empty() ? Result<MorphModel>(std::move(model))
                             : Result<MorphModel>(Status::trailing_bytes);
}

}  // namespace theatron::face
