// SPDX-License-Identifier: Apache-2.0
// The page of a host that may begin before its browser client is built.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include "host/page.h"

namespace theatron::host {

// Any thread.
class LatePage {
public:
    // Without a folder: there is no page, and none will come. Throws Error as Page does.
    explicit LatePage(std::filesystem::path folder);

    // Looks for the page as long as there is none. A page that was found stays as it is.
    std::shared_ptr<const Page> current();

private:
    const std::filesystem::path folder_;
    std::mutex mutex_;
    std::shared_ptr<const Page> page_;  // guarded by mutex_; never null
};

}  // namespace theatron::host
