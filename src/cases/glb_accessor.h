// SPDX-License-Identifier: Apache-2.0
// Numbers in the buffers of a glTF file. Safe for any bytes. Only for glb_reader.cpp.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "cases/glb_buffers.h"
#include "cases/glb_json.h"
#include "cases/glb_packed.h"
#include "geometry/vec.h"

namespace theatron::cases::glb {

inline constexpr const char* draco = "KHR_draco_mesh_compression";
inline constexpr const char* meshopt = "EXT_meshopt_compression";
// The same with a newer form of packed corners beside the first one.
inline constexpr const char* meshopt_successor = "KHR_meshopt_compression";

// The object of either extension that packs views; an empty list where there is none.
const Json& meshopt_in(const Json& view);

class Accessors {
public:
    // `extension` names one that is needed to read others, with Answer::extension, or a property,
    // with Answer::property.
    Accessors(const Json& root, Buffers& buffers, std::string& extension, UnpackDraco unpack_draco)
        : root_(root), buffers_(buffers), extension_(extension), unpack_draco_(unpack_draco) {}

    bool has_bytes(std::size_t accessor) const;
    // The triangles that `packed`, an object of KHR_draco_mesh_compression, stands for; the
    // accessor of the corners says whether its numbers are parts of the largest one.
    Answer read_draco(const Json& packed, std::size_t position, RawMesh& out);
    Answer read_positions(std::size_t accessor, std::vector<Vec3>& out);
    Answer read_indices(std::size_t accessor, std::vector<std::uint32_t>& out);

private:
    struct Numbers;
    Answer find(std::size_t accessor, std::size_t components, Numbers& out);
    Answer find_view(const Json& holder, std::size_t needed, ByteView& bytes, std::size_t& stride);
    Answer find_bytes(const Json& place, ByteView& bytes);
    Answer unpack_view(std::size_t number, const Json& packed, ByteView& bytes,
                       std::size_t& stride);
    Answer read(std::size_t accessor, std::size_t components, std::vector<double>& out);
    Answer replace_sparse(const Json& accessor, const Numbers& about, std::vector<double>& values);

    const Json& root_;
    Buffers& buffers_;
    std::string& extension_;
    UnpackDraco unpack_draco_;
    std::map<std::size_t, Bytes> unpacked_;  // views, by their numbers
    std::size_t unpacked_bytes_ = 0;
};

}  // namespace theatron::cases::glb
