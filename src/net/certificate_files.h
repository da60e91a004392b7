// SPDX-License-Identifier: Apache-2.0
// Follows the files of a certificate, which certbot and its like replace while a host runs.
#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "net/certificate.h"

namespace theatron::net {

// Not thread safe.
class CertificateFiles {
public:
    // As for read_certificate(). Reads nothing yet but their times.
    CertificateFiles(std::filesystem::path certificate, std::filesystem::path key);

    const std::filesystem::path& certificate() const { return certificate_; }
    // Throws Error, also for what is no regular file: reading a pipe could wait without end.
    Certificate read() const;

    // Call it about twice a second. After a change, and when a file was not changed again until
    // the next call (certificate and key are replaced one after the other): what the files hold.
    // nullopt: nothing new. Throws Error, once for each change, if they hold nothing usable.
    std::optional<Certificate> changed();

private:
    struct State {  // of a file; zeros: it is missing
        ino_t inode = 0;
        off_t size = 0;
        std::int64_t changed_ns = 0;  // also when only its permissions did
        bool operator==(const State&) const = default;
    };
    using States = std::array<State, 2>;

    States states() const;

    const std::filesystem::path certificate_, key_;
    States read_, seen_;
};

}  // namespace theatron::net
