// SPDX-License-Identifier: Apache-2.0
#include "temporary_folder.h"

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace theatron::bench {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "theatron_bench_XXXXXX").string();
    if (!mkdtemp(name.data()))
        throw Error("Cannot make a folder for temporary files in " +
                    std::filesystem::temp_directory_path().string() + ".");
    path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

}  // namespace theatron::bench
