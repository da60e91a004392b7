// SPDX-License-Identifier: Apache-2.0
// The text of the files in src/render/shaders, compiled into the program.
#pragma once

#include <string_view>
#include <vector>

namespace theatron::render {

struct ShaderFile {
    std::string_view name;  // for example "splat.vert"
    std::string_view text;
};

const std::vector<ShaderFile>& embedded_shaders();

}  // namespace theatron::render
