// SPDX-License-Identifier: Apache-2.0
// A certificate that a host shows, or that its proxy does: followed while its files change, and
// watched for its end.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "files/utc_text.h"
#include "net/certificate.h"
#include "net/certificate_files.h"

namespace theatron::host {

// Not thread safe.
class KeptCertificate {
public:
    // A certificate that expires is warned about for its last third, and at most for this long:
    // programs that renew one do so earlier.
    static constexpr files::UtcSeconds longest_notice = 21 * 24 * 3600;

    // The host's own one, which it made in this folder; it stays as it is.
    KeptCertificate(net::Certificate own, const std::filesystem::path& folder);
    // One in files, as for net::read_certificate(). Throws Error. Its dates keep no host from
    // starting: the clock may be wrong, and native participants compare only its fingerprint.
    explicit KeptCertificate(net::CertificateFiles files);

    const net::Certificate& current() const { return current_; }
    const net::Validity& validity() const { return validity_; }

    // Call it about twice a second. If the files hold another usable certificate, and `use` does
    // not throw Error for it, it is the current one. Otherwise the old one stays, and problem()
    // says why; so it does while the new one has expired or is not valid yet by the clock, which
    // may be wrong. True if the certificate is another one now.
    bool follow(const std::function<void(const net::Certificate&)>& use, files::UtcSeconds now);

    // A sentence on files that cannot be used, dates that are wrong, an end that is near, or a
    // certificate that is not one for `name`, the name in links (empty: any); empty if all is well.
    std::string problem(files::UtcSeconds now, const std::string& name) const;

private:
    std::string end_text(files::UtcSeconds now) const;
    std::string not_yet_text(const net::Validity& validity) const;

    std::optional<net::CertificateFiles> files_;
    net::Certificate current_;
    net::Validity validity_;
    std::optional<net::Certificate> waiting_;  // of changed files, while its dates are wrong
    std::string what_;                         // "The certificate 'or-3.pem'"
    std::string advice_;
    std::string unused_;  // why changed files are not used
};

}  // namespace theatron::host
