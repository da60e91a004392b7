// SPDX-License-Identifier: Apache-2.0
// The reasons for which a recording lacks something, as its recorder knew at the end: noted in the
// file (lacks_tag).
#pragma once

#include <set>
#include <string>

namespace theatron::record {

// The letters of docs/formats/recording.md.
enum class Lack : char {
    camera_failed = 'a',
    cut = 'c',
    end = 'e',
    files = 'f',
    host_gone = 'h',
    index = 'i',
    pictures = 'p',
    refused = 'r',
    voices = 'v',
};
using Lacks = std::set<Lack>;

std::string letters_of(const Lacks& lacks);
// Letters of a newer program are left out.
Lacks lacks_of_letters(const std::string& letters);
// A sentence without full stop, for people.
std::string text_of(Lack lack);

}  // namespace theatron::record
