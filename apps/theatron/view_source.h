// SPDX-License-Identifier: Apache-2.0
// The source of `theatron view`: a camera, a recording, a folder of pictures, or a case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace theatron::app {

struct ViewSource {
    std::vector<std::string> cameras;   // specifications, as of theatron host --camera
    std::filesystem::path case_folder;  // empty: no case
    std::string name;                   // for the window's title and lines
};

// `text` is the path of a file or folder, or a specification as of theatron host --camera. Throws
// Error with one sentence that says what it is not.
ViewSource view_source(const std::string& text);

}  // namespace theatron::app
