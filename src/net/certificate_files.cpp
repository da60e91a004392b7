// SPDX-License-Identifier: Apache-2.0
#include "net/certificate_files.h"

#include <sys/stat.h>

#include "base/error.h"

namespace theatron::net {

CertificateFiles::CertificateFiles(std::filesystem::path certificate, std::filesystem::path key)
    : certificate_(std::move(certificate)), key_(std::move(key)), read_(states()), seen_(read_) {}

CertificateFiles::States CertificateFiles::states() const {
    States states;
    // Links are followed: certbot changes only them.
    for (std::size_t i = 0; i < states.size(); ++i) {
        struct stat info {};
        if (stat((i == 0 ? certificate_ : key_).c_str(), &info) == 0)
            states[i] = {info.st_ino, info.st_size,
                         std::int64_t(info.st_ctim.tv_sec) * 1'000'000'000 + info.st_ctim.tv_nsec};
    }
    return states;
}

Certificate CertificateFiles::read() const {
    for (const std::filesystem::path& file : {certificate_, key_}) {
        std::error_code failed;
        const auto kind = std::filesystem::status(file, failed).type();
        if (kind != std::filesystem::file_type::regular &&
            kind != std::filesystem::file_type::not_found && !file.empty())
            throw Error("'" + file.string() +
                        "' is no file; --certificate and --key name files in PEM.");
    }
    return read_certificate(certificate_, key_);
}

std::optional<Certificate> CertificateFiles::changed() {
    const States now = states();
    const bool is_settled = now == seen_;
    seen_ = now;
    if (now == read_ || !is_settled)
        return std::nullopt;
    read_ = now;
    return read();
}

}  // namespace theatron::net
