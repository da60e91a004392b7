// SPDX-License-Identifier: Apache-2.0
// Numbers in the buffers of a glTF file. Safe for any bytes. Only for glb_reader.cpp.
#pragma once

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "cases/glb_packed.h"
#include "geometry/vec.h"

namespace theatron::cases::glb {

using Json = nlohmann::json;

inline constexpr const char* draco = "KHR_draco_mesh_compression";
inline constexpr const char* meshopt = "EXT_meshopt_compression";
// The same with a newer form of packed corners beside the first one.
inline constexpr const char* meshopt_successor = "KHR_meshopt_compression";

// Larger than all that can be there.
inline constexpr std::size_t no_index = std::numeric_limits<std::size_t>::max();

const Json& no_list();
// The list of this name; an empty one where there is none.
const Json& list_of(const Json& object, const char* name);
// A whole number, also as 12.0; no_index where it is anything else.
std::size_t whole_of(const Json& number);
// Nothing where the object has no such property.
std::optional<std::size_t> index_of(const Json& object, const char* name);
std::string text_of(const Json& object, const char* name);
bool has_extension(const Json& object, const char* name);
// The extension's object; an empty list where there is none.
const Json& extension_in(const Json& object, const char* name);
// The object of either extension that packs views; an empty list where there is none.
const Json& meshopt_in(const Json& view);

class Accessors {
public:
    // `buffer`: the one that the file itself has. `extension` names one that is needed to read
    // others, with Answer::extension, or a property, with Answer::property.
    Accessors(const Json& root, ByteView buffer, std::string& extension, UnpackDraco unpack_draco)
        : root_(root), buffer_(buffer), extension_(extension), unpack_draco_(unpack_draco) {}

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
    Answer find_bytes(const Json& place, ByteView& bytes) const;
    Answer unpack_view(std::size_t number, const Json& packed, ByteView& bytes,
                       std::size_t& stride);
    Answer read(std::size_t accessor, std::size_t components, std::vector<double>& out);
    Answer replace_sparse(const Json& accessor, const Numbers& about, std::vector<double>& values);

    const Json& root_;
    ByteView buffer_;
    std::string& extension_;
    UnpackDraco unpack_draco_;
    std::map<std::size_t, Bytes> unpacked_;  // views, by their numbers
    std::size_t unpacked_bytes_ = 0;
};

}  // namespace theatron::cases::glb
