// SPDX-License-Identifier: Apache-2.0
// The file of a process that reads foreign files. Only for this module.
#pragma once

#include <unistd.h>

#include <algorithm>

#include "base/bytes.h"
#include "sandbox/inside.h"

namespace theatron::cases {

// The bytes of the file, `most` of them at most.
inline Bytes bytes_of(const sandbox::Inside& inside, std::size_t most) {
    const off_t size = lseek(inside.input(), 0, SEEK_END);
    Bytes file(std::min(std::size_t(std::max<off_t>(size, 0)), most));
    std::size_t done = 0;
    while (done < file.size()) {
        const ssize_t count =
            pread(inside.input(), file.data() + done, file.size() - done, off_t(done));
        if (count <= 0)
            break;
        done += std::size_t(count);
    }
    file.resize(done);
    return file;
}

}  // namespace theatron::cases
