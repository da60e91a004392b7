// SPDX-License-Identifier: Apache-2.0
// The header of an NRRD file: lines of text, each a field ("name: value") or a key
// ("name:=value"). Only for this module.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"

namespace theatron::cases::nrrd {

// Names of fields are in small letters; those of keys are as the file has them.
using Fields = std::map<std::string, std::string, std::less<>>;

struct Header {
    Fields fields;
    std::size_t content = 0;  // where it begins, which may be the file's end
    std::string repeated;     // a field that the file has twice, with two values; usually empty
};

// Nothing: no header, or no end of it.
std::optional<Header> read_header(ByteView file);

// Empty where there is none.
std::string field(const Fields& fields, std::string_view name);

// A whole number and nothing else.
std::optional<long> whole_number(std::string_view text);

// The end of a sentence: "has the field 'sizes' with '20x16', which is no " and `wanted`.
std::string bad_field(const Fields& fields, const std::string& name, const char* wanted);

}  // namespace theatron::cases::nrrd
