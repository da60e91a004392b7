// SPDX-License-Identifier: Apache-2.0
// Files that an import leaves out, and why: one remark for each reason.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace theatron::cases {

class LeftOut {
public:
    // `reason` as in "holds no triangles".
    void add(const std::filesystem::path& file, const std::string& reason);

    // Appends "'a.ply' is left out: it holds no triangles.", in the order in which reasons
    // occurred.
    void append_to(std::vector<std::string>& remarks) const;

private:
    struct Reason {
        std::string text;
        std::vector<std::filesystem::path> files;
    };
    std::vector<Reason> reasons_;
};

// "'a', 'b', 'c' and 4 more".
std::string first_names(const std::vector<std::filesystem::path>& files);

}  // namespace theatron::cases
