// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/error.h"
#include "base/outside_text.h"

namespace theatron::cases {

// A folder that becomes the case when it is whole, and vanishes otherwise.
class NewFolder {
public:
    explicit NewFolder(const std::filesystem::path& folder)
        : folder_(folder), making_(folder.string() + ".making") {
        std::error_code failed;
        if (std::filesystem::exists(folder, failed))
            throw Error("'" + clean_text(folder.string(), 300) +
                        "' is there already; name a folder that is not, or remove it.");
        std::filesystem::remove_all(making_, failed);
        if (!std::filesystem::create_directories(making_, failed))
            throw Error("Cannot make the folder '" + clean_text(making_.string(), 300) +
                        "': " + failed.message() + ".");
    }
    ~NewFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(making_, ignored);
    }
    NewFolder(const NewFolder&) = delete;

    const std::filesystem::path& path() const { return making_; }
    void keep() {
        std::error_code failed;
        std::filesystem::rename(making_, folder_, failed);
        if (failed)
            throw Error("Cannot make the folder '" + clean_text(folder_.string(), 300) +
                        "': " + failed.message() + ".");
    }

private:
    std::filesystem::path folder_, making_;
};

}  // namespace theatron::cases
