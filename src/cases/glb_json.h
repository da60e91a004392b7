// SPDX-License-Identifier: Apache-2.0
// Properties of the JSON of a glTF file, whatever they hold. Safe for any bytes. Only for the
// readers of glTF.
#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace theatron::cases::glb {

using Json = nlohmann::json;

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

}  // namespace theatron::cases::glb
