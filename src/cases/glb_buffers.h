// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a glTF file's buffers are: in the file itself, within its text ("data:"), or
// in files beside it. Safe for any bytes. Only for glb_reader.cpp.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "cases/glb_json.h"

namespace theatron::cases::glb {

// The content of the file of this name beside the one that is read; nothing where there is none.
using FindBeside = std::function<std::optional<Bytes>(const std::string& name)>;

class Buffers {
public:
    // `own`: the buffer in a file of one piece; empty where it has none. `said` gets the name of
    // a file that is needed and is not there, with Answer::other_buffer, or "uri", with
    // Answer::property.
    Buffers(const Json& root, ByteView own, const FindBeside& find_beside, std::string& said)
        : root_(root), own_(own), find_beside_(find_beside), said_(said) {}

    // `out` stays valid as long as this object. Each buffer is found once.
    Answer find(std::size_t number, ByteView& out);

private:
    Answer load(const Json& buffer, Bytes& out);

    const Json& root_;
    ByteView own_;
    const FindBeside& find_beside_;
    std::string& said_;
    std::map<std::size_t, Bytes> loaded_;
};

// The bytes that a "data:" address in base64 stands for; nothing where it is none.
std::optional<Bytes> bytes_of_data_uri(std::string_view uri);

// A relative address as the name of a file: "%20" is a blank.
std::string name_of_uri(std::string_view uri);

}  // namespace theatron::cases::glb
