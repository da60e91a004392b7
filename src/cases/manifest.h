// SPDX-License-Identifier: Apache-2.0
// The manifest of a case, case.json, as text: docs/formats/case.md.
//
// Reading is safe for any bytes and strict: unknown keys, wrong types, names that leave the folder
// and newer versions are refused. Nothing throws.
#pragma once

#include <string>
#include <string_view>

#include "medical/case.h"

namespace theatron::cases {

inline constexpr const char* manifest_name = "case.json";
inline constexpr std::size_t max_manifest_bytes = std::size_t(1) << 20;
inline constexpr std::size_t max_parts = 256;
inline constexpr std::size_t max_series = 16;
inline constexpr std::size_t max_pictures = 64;
inline constexpr std::size_t max_name_characters = 64;
inline constexpr std::size_t max_credit_characters = 500;
// Manifests without pictures are written in version 1, which older programs read.
inline constexpr int manifest_version = 2, manifest_version_without_pictures = 1;

// A case understood, or what is wrong, as the end of a sentence that begins with the manifest's
// name ("lacks 'parts'").
struct ParsedManifest {
    medical::Case value;
    std::string problem;  // empty if `value` holds
};

ParsedManifest parse_manifest(std::string_view text);

// parse_manifest() of the result gives `value` again where its texts are clean and within bounds.
std::string manifest_text(const medical::Case& value);

// True if a manifest may name this file: letters, digits, '.', '_', '-' and blanks, not hidden. So
// the file lies in the case's folder.
bool is_plain_file_name(std::string_view name);

}  // namespace theatron::cases
