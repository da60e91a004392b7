// SPDX-License-Identifier: Apache-2.0
#include <draco/compression/decode.h>

#include <array>

#include "cases/glb_packed.h"

namespace theatron::cases::glb {
namespace {

template <class Number>
std::optional<Vec3> corner_of(const draco::PointAttribute& attribute, draco::PointIndex point) {
    std::array<Number, 3> numbers;
    if (!attribute.ConvertValue<Number, 3>(attribute.mapped_index(point), numbers.data()))
        return std::nullopt;
    return Vec3{double(numbers[0]), double(numbers[1]), double(numbers[2])};
}

}  // namespace

std::optional<RawMesh> unpack_draco(ByteView packed, std::uint32_t position) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return std::nullopt;
    const draco::Mesh& mesh = *decoded.value();
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(position);
    if (!attribute || attribute->num_components() != 3)
        return std::nullopt;
    const bool floating = attribute->data_type() == draco::DT_FLOAT32;
    RawMesh out;
    out.corners.reserve(mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::PointIndex point(i);
        const std::optional<Vec3> corner = floating ? corner_of<float>(*attribute, point)
                                                    : corner_of<std::int64_t>(*attribute, point);
        if (!corner)
            return std::nullopt;
        out.corners.push_back(*corner);
    }
    out.indices.reserve(3 * std::size_t(mesh.num_faces()));
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(i)))
            out.indices.push_back(point.value());
    return out;
}

}  // namespace theatron::cases::glb
