// SPDX-License-Identifier: Apache-2.0
#include "face/morph_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

constexpr std::string_view model_magic = "TFHEAD";
constexpr std::uint8_t model_version = 2;
constexpr float max_offset_mm = 1000;

void add_offsets(std::span<float> out, const std::vector<float>& offsets, float size) {
    if (size == 0)
        return;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += size * offsets[i];
}

// Reads `count` numbers of at most `most` either way.
bool read_numbers(ByteReader& in, std::size_t count, std::vector<float>& out,
                  float most = max_offset_mm) {
    // Before memory is taken for them: the bytes must be there.
    if (in.rest().size() / sizeof(float) < count)
        return false;
    out.resize(count);
    for (float& value : out) {
        value = get_f32(in);
        if (!std::isfinite(value) || std::fabs(value) > most)
            return false;
    }
    return true;
}

// Where the vertices of a head without a texture are on a cylinder round it.
std::vector<float> cylinder_places(const std::vector<float>& neutral) {
    float low = neutral[1], high = neutral[1];
    for (std::size_t i = 1; i < neutral.size(); i += 3) {
        low = std::min(low, neutral[i]);
        high = std::max(high, neutral[i]);
    }
    std::vector<float> places;
    for (std::size_t i = 0; i < neutral.size(); i += 3) {
        const float turn = std::atan2(neutral[i], neutral[i + 2]);
        places.push_back(0.5F + turn / (2 * std::numbers::pi_v<float>));
        places.push_back((high - neutral[i + 1]) / std::max(high - low, 1e-3F));
    }
    return places;
}

bool is_within(const std::vector<float>& places) {
    return std::all_of(places.begin(), places.end(),
                       [](float value) { return value >= 0 && value <= 1; });
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
    for (const std::uint32_t size : model.part_sizes)
        out.put(size);
    for (const std::uint32_t vertex : model.landmarks)
        out.put(vertex);
    put_all(model.neutral);
    put_all(model.places);
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
    model.part_sizes[0] = triangles;
    if (version > 1) {
        std::uint64_t sum = 0;
        for (std::uint32_t& size : model.part_sizes)
            sum += size = in.get<std::uint32_t>();
        if (!in.ok())
            return Status::truncated;
        if (sum != triangles)
            return Status::malformed;
    }
    for (std::uint32_t& vertex : model.landmarks)
        if ((vertex = in.get<std::uint32_t>()) >= vertices)
            return in.ok() ? Status::malformed : Status::truncated;
    const auto refusal = [&] {
        return in.rest().size() / sizeof(float) < numbers ? Status::truncated : Status::malformed;
    };
    if (!read_numbers(in, numbers, model.neutral))
        return refusal();
    if (version == 1)
        model.places = cylinder_places(model.neutral);
    else if (in.rest().size() / sizeof(float) < std::size_t(vertices) * 2)
        return Status::truncated;
    else if (!read_numbers(in, std::size_t(vertices) * 2, model.places, 1) ||
             !is_within(model.places))
        return Status::malformed;
    if (in.rest().size() / 12 < triangles)
        return Status::truncated;
    model.triangles.resize(triangles);
    for (auto& triangle : model.triangles)
        for (std::uint32_t& vertex : triangle)
            if ((vertex = in.get<std::uint32_t>()) >= vertices)
                return Status::malformed;
    for (std::uint32_t i = 0; i < identities; ++i)
        if (!read_numbers(in, numbers, model.identities.emplace_back()))
            return refusal();
    for (std::uint32_t i = 0; i < expressions; ++i) {
        const auto channel = in.get<std::uint8_t>();
        if (in.ok() && channel >= channel_count)
            return Status::malformed;
        auto& expression = model.expressions.emplace_back();
        expression.channel = Channel(channel);
        if (!read_numbers(in, numbers, expression.offsets))
            return refusal();
    }
    if (!in.ok())
        return Status::truncated;
    return in.rest().empty() ? Result<MorphModel>(std::move(model))
                             : Result<MorphModel>(Status::trailing_bytes);
}

}  // namespace theatron::face
