// SPDX-License-Identifier: Apache-2.0
// Numbers in the buffers of a glTF file. Safe for any bytes. Only for glb_reader.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "geometry/vec.h"

namespace theatron::cases::glb {

using Json = nlohmann::json;

const Json& no_list();
// The list of this name; an empty one where there is none.
const Json& list_of(const Json& object, const char* name);
std::optional<std::size_t> index_of(const Json& object, const char* name);
std::string text_of(const Json& object, const char* name);
bool has_extension(const Json& object, const char* name);

class Accessors {
public:
    // `buffer`: the one that the file itself has. `extension` names one that is needed to read
    // others, with Answer::extension.
    Accessors(const Json& root, ByteView buffer, std::string& extension)
        : root_(root), buffer_(buffer), extension_(extension) {}

    bool has_bytes(std::size_t accessor) const;
    Answer read_positions(std::size_t accessor, std::vector<Vec3>& out);
    Answer read_indices(std::size_t accessor, std::vector<std::uint32_t>& out);

private:
    struct Numbers;
    Answer find(std::size_t accessor, std::size_t components, Numbers& out);
    Answer find_view(const Json& holder, std::size_t needed, ByteView& bytes, std::size_t& stride);
    Answer read(std::size_t accessor, std::size_t components, std::vector<double>& out);
    Answer replace_sparse(const Json& accessor, const Numbers& about, std::vector<double>& values);

    const Json& root_;
    ByteView buffer_;
    std::string& extension_;
};

}  // namespace theatron::cases::glb
