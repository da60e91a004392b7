// SPDX-License-Identifier: Apache-2.0
#include <meshoptimizer.h>

#include "cases/glb_packed.h"

namespace theatron::cases::glb {
namespace {

constexpr std::size_t widest_vertex = 256;  // of the format
constexpr std::byte newer_vertices{0xa1};   // 0xa0: the first version

bool is_index(const MeshoptView& about) {
    return about.stride == 2 || about.stride == 4;
}

// The library trusts these numbers.
bool is_sound(const MeshoptView& about) {
    if (about.count == 0 || about.stride == 0 ||
        about.count > max_unpacked_view_bytes / about.stride)
        return false;
    const bool filtered = about.filter == "EXPONENTIAL";
    if (!filtered && !about.filter.empty() && about.filter != "NONE")
        return false;  // of directions and turns, which no corner is
    if (about.mode == "ATTRIBUTES")
        return about.stride % 4 == 0 && about.stride <= widest_vertex;
    if (about.mode == "TRIANGLES")
        return is_index(about) && !filtered && about.count % 3 == 0;
    return about.mode == "INDICES" && is_index(about) && !filtered;
}

}  // namespace

bool needs_newer_meshopt(ByteView packed, const MeshoptView& about) {
    return about.mode == "ATTRIBUTES" && !packed.empty() && packed[0] == newer_vertices;
}

std::optional<Bytes> unpack_meshopt(ByteView packed, const MeshoptView& about) {
    if (!is_sound(about))
        return std::nullopt;
    Bytes out(about.count * about.stride);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
    int result;
    if (about.mode == "ATTRIBUTES")
        result =
            meshopt_decodeVertexBuffer(out.data(), about.count, about.stride, bytes, packed.size());
    else if (about.mode == "TRIANGLES")
        result =
            meshopt_decodeIndexBuffer(out.data(), about.count, about.stride, bytes, packed.size());
    else
        result = meshopt_decodeIndexSequence(out.data(), about.count, about.stride, bytes,
                                             packed.size());
    if (result != 0)
        return std::nullopt;
    if (about.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(out.data(), about.count, about.stride);
    return out;
}

}  // namespace theatron::cases::glb
